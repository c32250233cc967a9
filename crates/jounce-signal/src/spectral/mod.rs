//! Powers, spectra and frequency responses of sampled signals.
//!
//! Transforms are `X(f) = sum x_n exp(-2 pi j f n / r)`, so that the response of a linear system to
//! `exp(+j w t)` is `H(w) exp(+j w t)`, `H = Y / X`. The phase of a displacement per force falls
//! from 0 through -90 degrees at a resonance. Cross spectra are `S_xy = conj(X) Y`. Densities are
//! one-sided, per hertz.
//!
//! Source: J. Bendat, A. Piersol, Random Data, 4th ed. (2010), chapters 9 and 11; P. Welch, IEEE
//! Trans. Audio Electroacoust. 15 (1967) 70.
mod error;
mod frequency_response;
mod power;
mod signal;
mod student;

pub use error::SpectralError;
pub use frequency_response::{
    Estimator, FrequencyResponse, Hit, HitSearch, HitWarning, ImpactHit, ImpactRecord,
    ImpactResponses, ImpactSettings, LeaveOneOutResponse, SpectrumAverages, WindowBias,
    exponential_window, force_window, hits, impact, is_continuous,
};
pub use power::{
    Density, DensityPeak, MIN_SEGMENT_SAMPLES, MeanPower, Segments, Spectra, SpectraSettings,
    Spectrogram, density_unit, mean_power, mean_power_if_long, spectra, spectra_watched,
    spectrogram, spectrogram_watched,
};
pub use signal::{first_varying, signal};
pub use student::student_95;
