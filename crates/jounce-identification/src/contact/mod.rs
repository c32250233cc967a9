//! Identification of a contact from force pulses: contact time, exponent, stiffness and
//! restitution.
//!
//! A hammer of mass `m` strikes a stationary body. With the approach `d` and the law of Hunt and
//! Crossley,
//!
//! ```text
//! m d'' = -F,   F = k d^n (1 + c d'),   d(0) = 0,  d'(0) = v
//! ```
//!
//! In units of the pulse (`x = d / (v T0)`, `t / T0`, `T0` such that `k (v T0)^n = m v / T0`) the
//! pulse is `F = (m v / T0) f(t / T0; n, e)`: its shape depends on the exponent and on the
//! restitution `e` only. Restitution appears as asymmetry. Because the approach returns to zero,
//! the impulse centre `t_c` of a pulse of length `T` gives `e = t_c / (T - t_c)` for any law. The
//! mass then gives the stiffness: `k = m^n F0^(1-n) T0^(-2n)`, `F0 = m v / T0`.
//!
//! Source: K. Hunt, F. Crossley, J. Appl. Mech. 42 (1975) 440; W. Goldsmith, Impact (1960), chapter
//! 4.
mod contact_fit;
mod error;
mod law;
mod loading;
mod problem;
mod pulse;
mod shape;

pub use contact_fit::{AllowedLaws, ContactFit, PulseUnits};
pub use error::ContactError;
pub use law::FixedExponentLaw;
pub use loading::{LoadingCurve, loading_curve};
pub use pulse::fit;
pub use shape::PulseShape;
