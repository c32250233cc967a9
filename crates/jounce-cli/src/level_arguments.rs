//! Levels of quantities of an orbit on the command line.

use crate::failure::Failure;
use clap::Args;
use jounce_core::analysis::QuantityLevel;
use jounce_core::plant::Plant;

/// Levels that are marked on branches and continued in two keys.
#[derive(Debug, Args)]
pub struct LevelArguments {
    /// Level to find on the branches, in quotes, as in --level "mean_power=50 uW", "voltage.PATCH=5
    /// V", "strain.PATCH=3e-4" or "contact_force.STOP=2 N"; can be given several times.
    #[arg(long = "level", value_name = "QUANTITY=VALUE")]
    levels: Vec<String>,
}

impl LevelArguments {
    /// Returns the levels for a plant.
    pub fn read(&self, plant: &Plant) -> Result<Vec<QuantityLevel>, Failure> {
        let levels = self
            .levels
            .iter()
            .map(|text| QuantityLevel::parse(text, plant));
        levels
            .collect::<Result<_, _>>()
            .map_err(|reason| Failure::usage(format!("--level {reason}")))
    }
}
