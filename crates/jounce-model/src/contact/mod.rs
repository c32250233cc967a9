//! Contact laws: each has one implementation, which every method calls.
//!
//! With `delta` the penetration (m, positive when the point is past the stop) and `delta'` its rate
//! (m/s), a law gives the compressive force `F(delta, delta')` (N), both slopes and the stored
//! energy. Stops never pull, `F >= 0`, except the cubic spring.

mod cubic;
mod hertz;
mod hunt_crossley;
mod kelvin_voigt;
mod law;
mod restitution;
mod rigid;
mod table;

pub use cubic::Cubic;
pub use hertz::Hertz;
pub use hunt_crossley::HuntCrossley;
pub use kelvin_voigt::KelvinVoigt;
pub use law::{ContactLaw, Law, Slopes};
pub use restitution::PlasticCollision;
pub use rigid::Rigid;
pub use table::Table;
