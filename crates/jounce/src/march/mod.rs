//! Marching: integration in time with exact flow between contacts and collocation inside them.
mod certificate;
mod collocation;
mod contact_step;
mod duhamel;
mod energies;
mod flight;
mod flight_table;
mod kernel;
mod lane;
mod marcher;
mod peak;
mod rigid;
mod state;
mod table;
mod tone;
mod totals;
mod trajectory;
mod variation;

pub use energies::Energies;
pub use kernel::Kernel;
pub use marcher::{MarchError, Marcher};
pub use totals::{ContactIntegrals, ContactStatistics, WorkCount};
pub use trajectory::{Instant, Segment, Trajectory};
pub use variation::{Drift, Variation, VariationError};
