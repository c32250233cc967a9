//! Power of a signal: its mean with an interval, and its spectra averaged over blocks.
mod batches;
mod density;
mod density_peaks;
mod long_run_variance;
mod mean_power;
mod segments;
mod spectra;
mod spectrogram;

pub use density::{Density, density_unit};
pub use density_peaks::DensityPeak;
pub use mean_power::{MeanPower, mean_power, mean_power_if_long};
pub use segments::{MIN_SEGMENT_SAMPLES, Segments};
pub use spectra::{Spectra, SpectraSettings, spectra, spectra_watched};
pub use spectrogram::{Spectrogram, spectrogram, spectrogram_watched};
