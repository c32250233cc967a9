//! Figures of what was measured, from plain numbers.
mod fitted;
mod loads;
mod pulses;
mod responses;
mod spectrogram;
mod stretches;

pub use fitted::fitted;
pub use loads::{LoadPoint, power_over_load};
pub use pulses::{Pulse, pulses};
pub use responses::{measured_responses, modal_fit, stabilisation};
pub use spectrogram::{densities_of, spectrogram_of};
pub use stretches::{stretch_section, stretch_spectra, stretches};
