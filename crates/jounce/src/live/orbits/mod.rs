//! Orbits of points of a response and of attractors, with the motion of stops and beams.

mod force_curve;
mod limits;
mod motion;
mod operating_point;
mod orbit;
mod orbit_stop;

pub use force_curve::ForceCurves;
pub use motion::{BeamMotion, PlateMotion};
pub use operating_point::{AttractorPeaks, OperatingPoint};
pub(super) use orbit::point_at;
pub use orbit::{BranchPlace, OrbitResult};
pub use orbit_stop::OrbitStop;
