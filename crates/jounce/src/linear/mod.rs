//! Linear answers in closed form: what the harvester does when it never strikes its stop.
//!
//! With a force `Re(F e^{i w t})` on a point the response is `x = T (i w I - A)^-1 T^-1 b F`, exact at any frequency. Sign
//! convention `e^{+i w t}`.

mod coupling;
mod frf;
mod optimum;

pub use coupling::{Coupling, couplings};
pub use frf::{Frf, Response, frf};
pub use optimum::{Optimum, optimal_resistance, steady_power_w};
