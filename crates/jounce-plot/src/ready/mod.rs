//! Ready-made figures: plain data in, a [`super::Figure`] out, in the style of figures 4 to 9 of
//! the harvester paper (2019).
mod bifurcations;
mod branches;
mod density;
mod diagram;
mod ensemble;
mod frequency_response;
mod mode_shapes;
mod plate_shapes;
mod resistance;
mod spectrogram;
mod spectrum;
mod sweep;
mod time_history;

pub use bifurcations::{BifurcationLine, bifurcations};
pub use branches::{BranchLine, BranchMark, branches, event_marker};
pub use density::{DensityLine, densities};
pub use diagram::{DiagramDots, DiagramView, diagram};
pub use ensemble::ensemble;
pub use frequency_response::{ResponseLine, frequency_responses};
pub use mode_shapes::{ModeShape, ShapePatch, mode_shapes};
pub use plate_shapes::{PlateShape, plate_motion, plate_shapes};
pub use resistance::power_against_resistance;
pub use spectrogram::{TimeSpectrum, spectrogram};
pub use spectrum::{SpectrumLine, spectra};
pub use sweep::{DOWN_WORDS, LineDirection, SweepLine, SweepLook, UP_WORDS, sweep};
pub use time_history::{Trace, time_histories};
