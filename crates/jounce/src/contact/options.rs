//! Options of the fit of contact laws.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, si};
use crate::recording::{ChannelList, ChosenChannel, UsesChannels};
use jounce_data::recording::Quantity;
use jounce_spec::Quantity as Unit;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Recording::contact`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ContactOptions {
    /// Channel of the force; by default the first one in newtons.
    #[arg(long, value_name = "CHANNEL")]
    pub force: Option<String>,
    /// Mass of the hammer, as in 0.1kg. With it the command reports the speed and the stiffness:
    /// for the fitted exponent, and for the linear spring and Hertz's law where the pulse allows
    /// them. By default no speed and no stiffness.
    #[arg(long = "mass", value_name = "MASS", value_parser = si(Unit::Mass))]
    pub mass_kg: Option<f64>,
}

impl Default for ContactOptions {
    fn default() -> Self {
        defaults()
    }
}

impl ContactOptions {
    pub(super) fn check(&self) -> Result<(), Error> {
        match self.mass_kg {
            Some(mass_kg) => check_above_zero("mass", mass_kg, "kg").map(|_| ()),
            None => Ok(()),
        }
    }
}

impl UsesChannels for ContactOptions {
    fn channels(&self, list: &ChannelList) -> Result<Vec<ChosenChannel>, Error> {
        Ok(vec![list.choose(
            "force",
            self.force.as_deref(),
            Quantity::Force,
        )?])
    }
}
