//! Periodic orbits, stable or unstable, of a harvester under drives with a common period. That
//! period is the drive cycle.
//!
//! Two methods share only the plant and the contact law. [`Shooting`] uses the exact flow and its
//! exact derivative, for any number of drive cycles and every law. [`HarmonicBalance`] works at the
//! ports. Stability always follows from the exact flow.

mod block_equations;
mod border;
mod charges;
mod compliance;
mod error;
mod estimate;
mod harmonic_balance;
mod lu_factors;
mod method;
mod multipliers;
mod null_vector;
mod parametric_model;
mod periodic;
mod quantity;
mod shooting;
mod shooting_evaluation;
mod sticking_orbit;
mod tracking;
mod turning_points;

pub use error::OrbitError;
pub use harmonic_balance::{BalanceEvaluation, HarmonicBalance};
pub use method::OrbitMethod;
pub use multipliers::{Eigenbasis, EigenvalueDisc, discs, multipliers};
pub use null_vector::null_vector;
pub use parametric_model::{ModelInstance, ParameterDerivatives, ParametricModel};
pub use periodic::{Orbit, determinant_at, nearest_pair_to_circle, pairs_outside};
pub use quantity::OrbitQuantity;
pub use shooting::Shooting;
pub use shooting_evaluation::ShootingEvaluation;
pub use tracking::{
    Condition, ExtendedEvaluation, ExtendedProblem, Gradient, GrazingPoint, TwoParameterProblem,
};
pub use turning_points::{
    TurningPoint, displacement_peak_m, nearest_extremum_m, nearest_turn, turns,
};
