//! Marching: integration in time with exact flow between contacts and collocation inside them.
mod answers;
mod basis;
mod certificate;
mod contact;
mod contact_step;
mod energies;
mod flight;
mod flight_table;
mod flow;
mod kernel;
mod layout;
mod marcher;
mod peak;
mod response;
mod rigid;
mod state;
mod table;
mod tone;
mod totals;
mod trajectory;
mod variation;

pub use energies::Energies;
pub use kernel::{Kernel, Shape};
pub use marcher::{MarchError, Marcher};
pub use totals::{ContactIntegrals, ContactStatistics, WorkCount};
pub use trajectory::{Instant, Segment, Trajectory};
pub use variation::{Drift, Variation, VariationError};
