//! Linear responses in closed form: the harvester without contact, under sinusoids and under noise.
//!
//! With a force `Re(F e^{i w t})` on a point the response is `x = T (i w I - A)^-1 T^-1 b F`, exact
//! at any frequency. Sign convention `e^{+i w t}`.

mod bandwidth;
mod coupling;
mod covariance;
mod frf;
mod level_crossing;
mod noise;
mod optimum;
mod quadrature;
mod random;
mod random_response;

pub use bandwidth::{noise_bandwidth_hz, statistical_bandwidth_hz};
pub use coupling::{Coupling, couplings};
pub use covariance::{covariance, product};
pub use frf::{Frf, FrfInput, FrfOutput, frf, frf_until};
pub use level_crossing::LevelCrossing;
pub use noise::{
    NoiseInput, density, noise_powers_between_w, spectral_moment, white_noise_powers_w,
};
pub use optimum::{Optimum, optimal_resistance, steady_power_w};
pub use random::{Random, RandomError};
pub use random_response::{
    Density, RandomLoad, RandomPatch, RandomPoint, RandomResponse, RandomStop,
};
