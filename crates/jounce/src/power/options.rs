//! Options of the mean power of recorded voltages.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, frequency_hz, resistance_ohm};
use crate::recording::{ChannelList, ChosenChannel, UsesChannels};
use jounce_data::recording::Quantity;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Recording::power`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PowerOptions {
    /// Resistance of the load, as in 100kohm: one for all recordings, or one for each in the same
    /// order.
    #[arg(long = "resistance", value_name = "RESISTANCE", value_parser = resistance_ohm)]
    pub resistance_ohm: Vec<f64>,
    /// Channel of the voltage over the load; by default the first one in volts.
    #[arg(long, value_name = "CHANNEL")]
    pub voltage: Option<String>,
    /// Channel of the base acceleration: power is also reported per mean square of it.
    #[arg(long, value_name = "CHANNEL")]
    pub base: Option<String>,
    /// Frequency of the drive, as in 13Hz: amplitudes at its multiples are also reported.
    #[arg(long = "drive", value_name = "FREQUENCY", value_parser = frequency_hz)]
    pub drive_hz: Option<f64>,
    /// Subtracts the mean of the voltage first, where it is an amplifier offset and not power.
    #[arg(long)]
    pub remove_mean: bool,
    /// Also computes the spectra of the voltages.
    #[arg(skip)]
    #[serde(skip)]
    pub spectra: bool,
}

impl Default for PowerOptions {
    fn default() -> Self {
        defaults()
    }
}

impl UsesChannels for PowerOptions {
    fn channels(&self, list: &ChannelList) -> Result<Vec<ChosenChannel>, Error> {
        let voltage = list.choose("voltage", self.voltage.as_deref(), Quantity::Voltage)?;
        let base = self.base.as_deref();
        let base = base.map(|name| list.choose("base", Some(name), Quantity::Acceleration));
        Ok([voltage].into_iter().chain(base.transpose()?).collect())
    }
}

impl PowerOptions {
    /// Returns the resistance of each recording.
    pub(super) fn resistances(&self, recordings: usize) -> Result<Vec<f64>, Error> {
        for resistance_ohm in &self.resistance_ohm {
            check_above_zero("resistance", *resistance_ohm, "ohm")?;
        }
        if let Some(drive_hz) = self.drive_hz {
            check_above_zero("drive", drive_hz, "Hz")?;
        }
        match self.resistance_ohm[..] {
            [] => Err(Error::option(
                "resistance",
                "missing",
                "give the resistance of the load, as in 100kohm",
            )),
            [one] => Ok(vec![one; recordings]),
            ref all if all.len() == recordings => Ok(all.to_vec()),
            ref all => {
                let given = format!("a list of {} values", all.len());
                let expected =
                    format!("there are {recordings} recordings: give one for all, or one for each");
                Err(Error::option("resistance", given, expected))
            }
        }
    }
}
