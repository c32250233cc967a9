//! Attractors, how likely each is from a cloud of starts, and the power to be expected.

mod basin;
mod cloud;
mod expected;
mod fate;
mod grid;
mod grid_text;
mod lyapunov;
mod share;
mod signature;
mod starts;

pub use basin::{Attractor, Basins, BasinsAnswer};
pub use cloud::Cloud;
pub use fate::Fate;
pub use grid::{Grid, GridAxis, GridSide};
pub use grid_text::GridError;
pub use lyapunov::{Lyapunov, Wandering, largest_exponent};
pub use share::{Share, wilson};
pub(super) use signature::{Signature, letters};
pub use starts::Starts;
