//! Uniformly sampled signals: mean, rms, peak, amplitude spectrum, order lines.
//!
//! For samples `x_n`, `n = 0 .. N-1`, at the rate `f_s` (Hz), and a window `w_n` (1):
//!
//! ```text
//! A_k = (c_k / sum_n w_n) |sum_n w_n x_n exp(-2 pi j k n / N)|,   f_k = k f_s / N,   k = 0 .. N/2
//! c_k = 2, but 1 at k = 0 and (N even) at k = N/2
//! ```
//!
//! so a sine of peak amplitude `A` on a bin gives `A_k = A`: single-sided, **zero to peak**,
//! corrected for the window's coherent gain `sum w / N`. With the rectangular window (Parseval)
//! `mean(x^2) = A_0^2 + sum A_k^2 / 2`; the term `k = N/2` is not halved. Divide by sqrt 2 for rms
//! lines; this is an amplitude spectrum, not a density.
//!
//! Order lines are amplitudes at multiples `r` of a known drive frequency `f`, including half
//! orders, from one least-squares fit
//!
//! ```text
//! x(t) = m + sum_r (a_r cos 2 pi r f t + b_r sin 2 pi r f t),   A_r = sqrt(a_r^2 + b_r^2)
//! ```
//!
//! It is exact for such a signal, even if the record is not an integer number of periods and no
//! line falls on a bin.
//!
//! Source: G. Heinzel, A. Rüdiger, R. Schilling, Spectrum and spectral density estimation by the
//! DFT (2002).
mod density;
mod error;
mod normal;
mod orders;
mod random;
mod samples;
pub mod spectral;
mod spectrum;
mod window;

pub use error::SignalError;
pub use normal::{NORMAL_95, NORMAL_QUARTILE};
pub use orders::{OrderLine, Orders};
pub use random::RandomStream;
pub use samples::Samples;
pub use spectrum::Spectrum;
pub use window::Window;
