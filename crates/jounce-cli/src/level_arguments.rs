//! Levels of quantities of an orbit, as the command line gives them.

use crate::failure::Failure;
use clap::Args;
use jounce::analysis::QuantityLevel;
use jounce::plant::Plant;

/// Levels that are labelled on branches and followed over two keys.
#[derive(Debug, Args)]
pub struct LevelArguments {
    /// Level to find on the branches, in quotes, as in --level "mean_power=50 uW", "voltage.PATCH=5 V", "strain.PATCH=3e-4" or
    /// "contact_force.STOP=2 N"; can be given several times.
    #[arg(long = "level", value_name = "QUANTITY=VALUE")]
    levels: Vec<String>,
}

impl LevelArguments {
    /// The levels, for a plant.
    pub fn read(&self, plant: &Plant) -> Result<Vec<QuantityLevel>, Failure> {
        let levels = self
            .levels
            .iter()
            .map(|text| QuantityLevel::parse(text, plant));
        levels
            .collect::<Result<_, _>>()
            .map_err(|why| Failure::usage(format!("--level {why}")))
    }
}
