//! Options of the response to noise.

use crate::options::{defaults, frequency_hz};
use serde::{Deserialize, Serialize};

/// Options of [`crate::Harvester::noise`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NoiseOptions {
    /// Lowest frequency of the densities, as in 1Hz; by default the lowest of the noise.
    #[arg(long = "low", value_name = "FREQUENCY", value_parser = frequency_hz)]
    pub low_hz: Option<f64>,
    /// Highest frequency of the densities; by default the highest of the noise.
    #[arg(long = "high", value_name = "FREQUENCY", value_parser = frequency_hz)]
    pub high_hz: Option<f64>,
    /// Number of frequencies, evenly spaced; further ones are added around each resonance.
    #[arg(long, default_value_t = 1000)]
    pub points: usize,
}

impl Default for NoiseOptions {
    fn default() -> Self {
        defaults()
    }
}
