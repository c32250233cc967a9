//! Figures of measurements, from plain numbers.
mod fitted;
mod loads;
mod pulses;
mod responses;
mod segments;
mod spectrogram;

pub use fitted::fitted;
pub use loads::{LoadPoint, power_over_load};
pub use pulses::{PulseFigure, pulses};
pub use responses::{measured_responses, modal_fit, stabilisation};
pub use segments::{segment_section, segment_spectra, segments};
pub use spectrogram::{densities_of, spectrogram_of};
