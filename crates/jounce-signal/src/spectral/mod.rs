//! Powers, spectra and frequency responses of sampled signals.
//!
//! Transforms are `X(f) = sum x_n exp(-2 pi j f n / r)`, so that the response of a linear system to
//! `exp(+j w t)` is `H(w) exp(+j w t)`, `H = Y / X`. The phase of a displacement per force falls
//! from 0 through -90 degrees at a resonance. Cross spectra are `S_xy = conj(X) Y`. Densities are
//! one-sided, per hertz.
//!
//! Source: J. Bendat, A. Piersol, Random Data, 4th ed. (2010), chapters 9 and 11; P. Welch, IEEE
//! Trans. Audio Electroacoust. 15 (1967) 70.
mod density;
mod density_peaks;
mod error;
mod hits;
mod impact;
mod long_run_variance;
mod mean_power;
mod pre_trigger_check;
mod response;
mod segments;
mod shaker;
mod signal;
mod spectra;
mod spectrogram;
mod student;
mod taper;
mod window_bias;

pub use density::{Density, density_unit};
pub use density_peaks::DensityPeak;
pub use error::SpectralError;
pub use hits::{Hit, HitSearch, HitWarning, hits};
pub use impact::{ImpactHit, ImpactRecord, ImpactResponses, ImpactSettings, impact};
pub use mean_power::{MeanPower, mean_power, mean_power_if_long};
pub use response::{Estimator, FrequencyResponse, LeaveOneOutResponse, SpectrumAverages};
pub use segments::Segments;
pub use shaker::is_continuous;
pub use signal::{first_varying, signal};
pub use spectra::{Spectra, SpectraSettings, spectra, spectra_watched};
pub use spectrogram::{Spectrogram, spectrogram, spectrogram_watched};
pub use student::student_95;
pub use taper::{exponential_window, force_window};
pub use window_bias::WindowBias;
