//! Options of frequency responses.

use crate::error::Error;
use crate::options::{check_band, defaults, frequency_hz};
use serde::{Deserialize, Serialize};

/// Options of [`crate::Harvester::frf`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FrfOptions {
    /// A frequency, as in 12.5Hz, instead of a band; can be given several times.
    #[arg(long = "frequency", value_name = "FREQUENCY", value_parser = frequency_hz, conflicts_with_all = ["low_hz", "high_hz", "points"])]
    pub frequency_hz: Vec<f64>,
    /// Lowest frequency of the band.
    #[arg(long = "low", value_name = "FREQUENCY", value_parser = frequency_hz, default_value = "1 Hz")]
    pub low_hz: f64,
    /// Highest frequency of the band.
    #[arg(long = "high", value_name = "FREQUENCY", value_parser = frequency_hz, default_value = "1000 Hz")]
    pub high_hz: f64,
    /// Number of frequencies of the band, logarithmically spaced.
    #[arg(long, default_value_t = 2000)]
    pub points: usize,
    /// Point of the spec that the force acts on; by default the point of the first force.
    #[arg(long, value_name = "POINT")]
    pub input: Option<String>,
    /// Excites the base instead of a point; displacements are then relative to the base.
    #[arg(long)]
    pub base: bool,
    /// Fixes a mass of the spec, by name; can be given several times; by default no mass.
    #[arg(long, value_name = "MASS")]
    pub hold: Vec<String>,
    /// Fixes every mass of the spec; by default no mass.
    #[arg(long)]
    pub fixed_table: bool,
    /// Omits the circuit of every patch.
    #[arg(long)]
    pub open_circuit: bool,
}

impl Default for FrfOptions {
    fn default() -> Self {
        defaults()
    }
}

impl FrfOptions {
    /// Returns the frequencies, Hz.
    pub(super) fn frequencies_hz(&self) -> Result<Vec<f64>, Error> {
        if self.frequency_hz.is_empty() {
            return self.band_hz();
        }
        let default = Self::default();
        let is_default = [self.low_hz, self.high_hz] == [default.low_hz, default.high_hz]
            && self.points == default.points;
        if !is_default {
            let expected =
                "`low`, `high` and `points` apply to a band; omit them, or omit `frequency`";
            let value = format!("{} Hz", self.frequency_hz[0]);
            return Err(Error::option("frequency", value, expected));
        }
        let is_valid = |hz: &&f64| **hz > 0.0 && hz.is_finite();
        match self.frequency_hz.iter().find(|hz| !is_valid(hz)) {
            None => Ok(self.frequency_hz.clone()),
            Some(hz) => Err(Error::option(
                "frequency",
                format!("{hz} Hz"),
                "it must be above 0 Hz and finite",
            )),
        }
    }

    fn band_hz(&self) -> Result<Vec<f64>, Error> {
        let (low_hz, high_hz, last) = (self.low_hz, self.high_hz, self.points.saturating_sub(1));
        check_band([low_hz, high_hz], self.points)?;
        let ratio = (high_hz / low_hz).ln() / last as f64;
        let frequency_hz = |k: usize| low_hz * (ratio * k as f64).exp();
        let inner = (0..last).map(frequency_hz);
        Ok(inner.chain([high_hz]).collect())
    }
}
