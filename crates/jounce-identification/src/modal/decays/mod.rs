//! Modes of decays, from their one-sided spectra.
mod half_spectrum;
mod identify_decays;
mod jackknife;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
mod warp;

pub use identify_decays::identify_decays;
