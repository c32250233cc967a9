//! Periodic orbits of a harvester under drives that repeat themselves together, stable or not. Their common period is a drive cycle.
//!
//! Two methods that share nothing but the plant and the contact law: [`Shooting`] on the exact flow with its exact derivative, for
//! orbits of any number of drive cycles and for every law, and [`HarmonicBalance`] at the ports. Stability always comes from the exact flow.

mod balance;
mod block_equations;
mod border;
mod charges;
mod compliance;
mod error;
mod estimate;
mod factors;
mod harvester;
mod method;
mod multipliers;
mod null_vector;
mod periodic;
mod quantity;
mod rested;
mod shooting;
mod shot;
mod tracking;
mod turning_points;

pub use balance::{Balance, HarmonicBalance};
pub use error::OrbitError;
pub use harvester::{Change, Harvester, Setting};
pub use method::OrbitMethod;
pub use multipliers::{Disc, Eigenbasis, discs, multipliers};
pub use null_vector::null_vector;
pub use periodic::{Orbit, determinant_at, nearest_pair_to_circle, pairs_outside};
pub use quantity::OrbitQuantity;
pub use shooting::Shooting;
pub use shot::Shot;
pub use tracking::{Condition, Gradient, Plane, Touch, Tracked, Tracking};
pub use turning_points::{Turn, displacement_peak_m, nearest_extremum_m, nearest_turn, turns};
