//! Orbit of one point of a response, with the motion of stops and beams.

mod force_curve;
mod limits;
mod motion;
mod orbit;
mod orbit_stop;

pub use force_curve::ForceCurves;
pub use motion::{BeamMotion, PlateMotion};
pub(super) use orbit::point_at;
pub use orbit::{BranchPlace, OrbitResult};
pub use orbit_stop::OrbitStop;
