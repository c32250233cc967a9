//! Powers, spectra and frequency responses of sampled signals.
//!
//! Transforms are `X(f) = sum x_n exp(-2 pi j f n / r)`, so that a linear system answers `exp(+j w t)` with `H(w) exp(+j w t)`,
//! `H = Y / X`: the phase of a displacement per force falls from 0 through -90 degrees at a resonance. Cross spectra are
//! `S_xy = conj(X) Y`. Densities are one-sided, per hertz.
//!
//! Source: J. Bendat, A. Piersol, Random Data, 4th ed. (2010), chapters 9 and 11; P. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70.
mod density;
mod error;
mod hits;
mod impact;
mod lobes;
mod long_run;
mod mean_power;
mod quiet;
mod response;
mod segments;
mod shaken;
mod sight;
mod signal;
mod spectra;
mod spectrogram;
mod student;
mod taper;

pub use density::{Density, density_unit};
pub use error::SpectralError;
pub use hits::{Hit, HitSearch, HitWarning, hits};
pub use impact::{ImpactAnswer, ImpactHit, ImpactRecord, ImpactSettings, impact};
pub use lobes::DensityPeak;
pub use mean_power::{MeanPower, mean_power, mean_power_if_long};
pub use response::{Averages, Estimator, FrequencyResponse, Without};
pub use segments::Segments;
pub(crate) use shaken::goes_on;
pub use sight::Sight;
pub use signal::{first_live, signal};
pub use spectra::{Spectra, SpectraSettings, spectra, spectra_watched};
pub use spectrogram::{Spectrogram, spectrogram, spectrogram_watched};
pub(crate) use student::student_95;
pub use taper::{exponential_window, force_window};
