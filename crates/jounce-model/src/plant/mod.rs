//! The coupled electromechanical system between its ports: linear, in real block-diagonal form,
//! with rows as outputs.
//!
//! This level does not depend on beams: a [`System`] is modes, loads, stops and drives; a [`Plant`]
//! is
//!
//! ```text
//! y' = A y + sum_ports b_p f_p(t),   x(t) = T y(t) + Re(X e^{i w t}),   x = (q, q', V, i)
//! ```
//!
//! with `A` made of 2 x 2 and 1 x 1 blocks, `y` the part of the state that the sinusoidal drives do
//! not force, and `X` the steady state under these drives without contact. Between contacts the
//! flow of `y` is therefore known exactly. Other drives are [`Signal`]s, linear in time between
//! breakpoints, whose response is also exact ([`Forcing`]).

mod assemble;
mod circuit;
mod coordinates;
mod coupled_plant;
mod derivative;
mod diagonal;
mod energy;
mod error;
mod forcing;
mod system;

pub use assemble::driven;
pub use circuit::bridge::{Bridge, BridgeState, Conduction, RectifierScheme, Storage};
pub use circuit::electrical::{
    Across, BridgeNodes, Conductance, Electrical, ElectricalNode, Inductor,
};
pub use circuit::event_function::{BridgeChange, EnergyOutlet, EventFunction, PowerOutput};
pub use circuit::leak::Leak;
pub use circuit::regulator::{DevicePhase, Regulator, VoltageBand};
pub use coupled_plant::{Plant, Port};
pub use coupled_plant::{dot, product};
pub use derivative::{
    Coefficients, LoadDerivative, PlantDerivative, PortDerivative, ToneDerivative,
};
pub use diagonal::Diagonal;
pub use diagonal::block_diagonal::BlockDiagonal;
pub use diagonal::block_pair::BlockPair;
pub use energy::lyapunov::{LyapunovSide, lyapunov};
pub use energy::quadratic::Quadratics;
pub use energy::signal_meter::{SignalIntegrals, SignalMeter};
pub use energy::{EnergyMeter, Meters};
pub use error::PlantError;
pub use forcing::signal::Signal;
pub use forcing::tone::Tone;
pub use forcing::{Forcing, LOCAL_TERMS, NEGLIGIBLE_TERM, SignalSample, local_limit_s};
pub use system::{Connection, Dashpot, Drive, Load, Stop, System};
