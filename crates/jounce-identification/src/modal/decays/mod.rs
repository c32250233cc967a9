//! Modes of decays, from their one-sided spectra.
mod half_spectrum;
mod jackknife;
mod warp;

pub use half_spectrum::identify_decays;
