//! Attractors, how likely each is from a cloud of starts, and the power to be expected.

mod attractor;
mod basin;
mod cloud;
mod expected;
mod grid;
mod grid_text;
mod letters;
mod mirror;
mod share;
mod starts;

pub use attractor::{Attractor, BasinsAnswer};
pub use basin::Basins;
pub use cloud::Cloud;
pub use grid::{Grid, GridAxis, GridSide};
pub use grid_text::GridError;
pub(super) use letters::letters;
pub use share::{Share, wilson};
pub use starts::Starts;
