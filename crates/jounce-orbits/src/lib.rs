//! Periodic orbits, stable or unstable, of a harvester under drives with a common period. That
//! period is the drive cycle.
//!
//! Two methods share only the plant and the contact law. [`Shooting`] uses the exact flow and its
//! exact derivative, for any number of drive cycles and every law. [`HarmonicBalance`] works at the
//! ports. Stability always follows from the exact flow.

mod bordered;
mod error;
mod harmonic_balance;
mod method;
mod orbit;
mod parametric_model;
mod shooting;
mod tracking;

pub use bordered::null_vector::null_vector;
pub use error::OrbitError;
pub use harmonic_balance::{BalanceEvaluation, HarmonicBalance};
pub use method::OrbitMethod;
pub use orbit::multipliers::{Eigenbasis, EigenvalueDisc, discs, multipliers};
pub use orbit::periodic::{Orbit, determinant_at, nearest_pair_to_circle, outside_count};
pub use orbit::quantity::{OrbitPeak, OrbitQuantity};
pub use orbit::turning_points::{
    TurningPoint, displacement_peak_m, nearest_extremum_m, nearest_turn, turns,
};
pub use parametric_model::{ModelInstance, ParameterDerivatives, ParametricModel};
pub use shooting::evaluation::ShootingEvaluation;
pub use shooting::{
    FINER_TOLERANCE, InstantSensitivity, OrbitInstant, OrbitSensitivity, Shooting, cycle_s,
};
pub use tracking::{
    Condition, ExtendedEvaluation, ExtendedProblem, Gradient, GrazingPoint, TwoParameterProblem,
};
