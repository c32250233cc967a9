//! Bifurcations followed through two parameters.
//!
//! ```text
//! R(u, p, p2) = 0,   g(u, p, p2) = 0
//! ```
//!
//! `R` is that of shooting, `g` is zero at the bifurcation: a multiplier +1 (fold) or -1 (doubling), or a turning point on the surface
//! of the stop (grazing). Unknown are `u` and `p`; `p2` is the parameter of the curve, which continuation follows through its own folds.

mod condition;
mod critical;
mod plane;
mod touching;
mod tracked;

pub use condition::Condition;
pub use plane::Plane;
pub use tracked::{Tracked, Tracking};
