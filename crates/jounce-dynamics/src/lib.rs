//! Integration in time: exact flow between contacts, collocation inside them.
mod contact;
mod error;
mod excitation;
mod flight;
mod flow;
mod force_response;
mod impact;
mod integrator;
mod kernel;
mod multi_port;
mod ports;
mod record;
mod rectifier;
mod sensitivity;
mod tables;

pub use error::IntegrationError;
pub use integrator::Integrator;
pub use kernel::{ForceBasis, Kernel};
pub use record::energies::Energies;
pub use record::statistics::{ContactIntegrals, ContactStatistics, WorkCount};
pub use record::trajectory::{
    ConductionChange, Impact, PortForce, SampledRows, Trajectory, TrajectorySegment,
    TrajectoryState,
};
pub use rectifier::energies::RectifiedEnergies;
pub use rectifier::regulation::DeviceStatistics;
pub use sensitivity::{
    FlowSensitivity, OutputDerivatives, ParameterRequest, ParameterSensitivity, SensitivityError,
    StateDerivative,
};
