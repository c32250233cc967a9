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
    /// Speed of the hammer before the contact, as in 0.5m/s, for the table of force over
    /// penetration, which also needs the mass. By default that of the fitted law.
    #[arg(long = "speed", value_name = "SPEED", value_parser = si(Unit::Speed))]
    pub speed_m_s: Option<f64>,
}

impl Default for ContactOptions {
    fn default() -> Self {
        defaults()
    }
}

impl ContactOptions {
    pub(super) fn check(&self) -> Result<(), Error> {
        if let Some(mass_kg) = self.mass_kg {
            check_above_zero("mass", mass_kg, "kg")?;
        }
        match (self.speed_m_s, self.mass_kg) {
            (Some(speed_m_s), None) => Err(Error::option(
                "speed",
                format!("{speed_m_s} m/s"),
                "give the mass of the hammer, `mass`, too, or omit it",
            )),
            (Some(speed_m_s), Some(_)) => check_above_zero("speed", speed_m_s, "m/s").map(|_| ()),
            (None, _) => Ok(()),
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
