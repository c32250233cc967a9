//! A periodic orbit: its stability, its turning points and the quantities that a user may specify.

mod decoupled_blocks;
pub(crate) mod multipliers;
pub(crate) mod periodic;
pub(crate) mod quantity;
pub(crate) mod sampled_motion;
pub(crate) mod turning_points;
