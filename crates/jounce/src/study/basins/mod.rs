//! Attractors, how likely each is from a cloud of starts, and the power to be expected.

mod basin;
mod cloud;
mod lyapunov;
mod share;

pub use basin::{Attractor, Basins, BasinsAnswer, Fate};
pub use cloud::Cloud;
pub use lyapunov::{Lyapunov, Wandering, largest_exponent};
pub use share::{Share, wilson};
