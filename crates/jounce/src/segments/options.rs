//! Options of the segmentation of a recording.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, frequency_hz, refuse_changed, resistance_ohm};
use crate::recording::{ChannelList, ChosenChannel, UsesChannels};
use jounce_data::recording::Quantity;
use jounce_experiment::solution::SolutionSearch;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Recording::segments`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SegmentsOptions {
    /// Frequency of the drive, as in 13Hz; always needed. Periods of up to 12 of its cycles are
    /// found.
    #[arg(long = "drive", value_name = "FREQUENCY", value_parser = frequency_hz)]
    pub drive_hz: Option<f64>,
    /// Channel to segment; by default the first one in volts.
    #[arg(long, value_name = "CHANNEL")]
    pub channel: Option<String>,
    /// Resistance of the load, where the channel is its voltage: the power of each segment is
    /// reported.
    #[arg(long = "resistance", value_name = "RESISTANCE", value_parser = resistance_ohm)]
    pub resistance_ohm: Option<f64>,
    /// Number of random starts that find the solutions of the model.
    #[arg(long, default_value_t = 40)]
    pub starts: usize,
    /// Seed of the starts.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Circuit of the model whose voltage was recorded; by default the first.
    #[arg(long, value_name = "CIRCUIT")]
    pub load: Option<String>,
    /// Largest distance of the waveforms, relative to the waveform of the record, at which a
    /// solution matches.
    #[arg(long, default_value_t = 0.2)]
    pub within: f64,
}

impl Default for SegmentsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl SegmentsOptions {
    /// Checks the options and returns the frequency of the drive, Hz.
    pub(super) fn check(&self, has_model: bool) -> Result<f64, Error> {
        if let Some(ohm) = self.resistance_ohm {
            check_above_zero("resistance", ohm, "ohm")?;
        }
        if !has_model {
            let of_model = ["starts", "seed", "load", "within"];
            refuse_changed(
                self,
                &of_model,
                "it applies to a model: give one as `model`, or omit it",
            )?;
        }
        if self.starts == 0 {
            return Err(Error::option("starts", 0, "it must be above 0"));
        }
        if !(self.within > 0.0 && self.within <= 1.0) {
            let expected = "it must be above 0 and at most 1";
            return Err(Error::option("within", self.within, expected));
        }
        match self.drive_hz {
            Some(drive_hz) => check_above_zero("drive", drive_hz, "Hz"),
            None => {
                let expected = "give the frequency of the drive, as in 13 Hz";
                Err(Error::option("drive", "missing", expected))
            }
        }
    }

    /// Returns the search for the solutions of the model.
    pub(super) fn search(&self) -> SolutionSearch {
        SolutionSearch {
            starts: self.starts,
            seed: self.seed,
            load: self.load.clone(),
            ..SolutionSearch::default()
        }
    }
}

impl UsesChannels for SegmentsOptions {
    fn channels(&self, list: &ChannelList) -> Result<Vec<ChosenChannel>, Error> {
        let chosen = match self.channel.as_deref() {
            // Any quantity can be segmented; only a voltage has a power.
            Some(name) if self.resistance_ohm.is_none() => list.find(name)?,
            name => list.choose("channel", name, Quantity::Voltage)?,
        };
        Ok(vec![chosen])
    }
}
