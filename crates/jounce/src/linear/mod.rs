//! Linear answers in closed form: what the harvester does when it never strikes its stop, under sinusoids and under noise.
//!
//! With a force `Re(F e^{i w t})` on a point the response is `x = T (i w I - A)^-1 T^-1 b F`, exact at any frequency. Sign
//! convention `e^{+i w t}`.

mod coupling;
mod frf;
mod noise;
mod optimum;
mod quadrature;

pub use coupling::{Coupling, couplings};
pub use frf::{Frf, Input, Response, frf};
pub use noise::{noise_powers_between_w, white_noise_powers_w};
pub use optimum::{Optimum, optimal_resistance, steady_power_w};
