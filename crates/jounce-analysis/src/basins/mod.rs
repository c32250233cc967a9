//! Attractors, the probability of each from a cloud of starts, and the expected power.

mod attractor;
mod basin;
mod basin_fraction;
mod cloud;
mod expected;
mod grid;
mod grid_text;
mod letters;
mod mirror;
mod starts;

pub use attractor::{Attractor, BasinsResult};
pub use basin::Basins;
pub use basin_fraction::{BasinFraction, wilson};
pub use cloud::Cloud;
pub use grid::{Grid, GridAxis, GridSide};
pub use grid_text::GridError;
pub(super) use letters::letters;
pub use starts::InitialStates;
