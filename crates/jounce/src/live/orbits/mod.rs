//! Orbits of points of a response and of attractors, with the motion of stops and beams.

mod aperiodic_motion;
mod attractor_place;
mod branch_place;
mod branch_point;
mod force_curve;
mod limits;
mod motion;
mod operating_point;
mod orbit;
mod orbit_identity;
mod orbit_stop;
mod stability;

pub use aperiodic_motion::AperiodicMotion;
pub use attractor_place::{AttractorPlace, StoredAttractors};
pub use branch_place::BranchPlace;
pub(super) use branch_place::point_at;
pub use branch_point::SoughtOrbit;
pub use force_curve::ForceCurves;
pub use limits::ReachedLimit;
pub use motion::{BeamMotion, PlateMotion};
pub use operating_point::{AttractorPeaks, LimitShares, OperatingPoint};
pub use orbit::{OrbitPlace, OrbitResult};
pub use orbit_identity::OrbitIdentity;
pub use orbit_stop::OrbitStop;
