//! Recognition of the attractor that an integration reaches.
//!
//! A start belongs to a periodic orbit when its motion has entered a ball around it (see
//! [`AttractingOrbit`]) and contracts there as the bound requires. The derivative of the orbit
//! proves attraction in this ball. Orbits are found from the return times of the motion: Newton's
//! method starts from the last state, over the period after which the motion returns nearest. A
//! motion that reaches no orbit is a torus if its averages converge and its largest exponent is
//! zero. It is chaos if that exponent is positive after all permitted cycles, and undecided
//! otherwise.

mod adapted_norm;
mod attracting_orbit;
mod attractor_kind;
mod chaotic_transient;
mod lyapunov;
mod orbit_search;
mod recognizer;
mod return_times;
mod settled_orbit;
mod steady_state;
mod transient;
mod weighted_average;

pub use attracting_orbit::AttractingOrbit;
pub use attractor_kind::AttractorKind;
pub use chaotic_transient::MIN_TRANSIENT_CYCLES;
pub use lyapunov::{Lyapunov, largest_exponent};
pub use recognizer::{Recognition, Recognizer};
pub use settled_orbit::{settled_orbit, settled_orbits};
pub use steady_state::{Aperiodic, ReachedOrbit, SteadyState};
