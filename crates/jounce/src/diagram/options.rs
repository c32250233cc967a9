//! Options of bifurcation diagrams.

use crate::basins::cloud;
use crate::continuation_options;
use crate::error::Error;
use crate::options::defaults;
use jounce_analysis::DiagramOrder;
use serde::{Deserialize, Serialize};

/// Number of starts at each value, seed and size of their cloud, where not given.
const STARTS: usize = 20;
const SEED: u64 = 1;
const SPREAD: f64 = 10.0;
/// Longest period of a continued branch, drive cycles, where not given.
const LONGEST_PERIOD: u32 = 4;
/// Largest number of recorded drive cycles.
const MAX_CYCLES: u32 = 100_000;
/// Number of values at which integrations search for the branches.
pub(super) const SEEDS: usize = 4;

/// Order of the values of a diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DiagramDirection {
    /// From the first value to the last, each starting from the state of the one before.
    Up,
    /// From the last value to the first, each starting from the state of the one before.
    Down,
    /// Up, then down from the last state.
    Both,
    /// At each value from every start of a cloud; attractors are matched between values.
    Starts,
}

/// Options of [`crate::Harvester::diagram`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DiagramOptions {
    /// The key and its values: KEY=FROM:TO:STEP, KEY=FROM:TO:Nx, KEY=FROM:TO:Nlog or KEY=A,B,C.
    #[arg(long, value_name = "KEY=RANGE")]
    pub over: String,
    /// Order of the values.
    #[arg(long, value_enum, default_value = "both")]
    pub direction: DiagramDirection,
    /// Number of starts at each value, with direction starts; 20 by default.
    #[arg(long)]
    pub starts: Option<usize>,
    /// Seed of the random numbers that draw their cloud; another seed draws other starts; 1 by default.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Size of the cloud at the stop, in gaps (or in steady amplitudes, if larger); 10 by default.
    #[arg(long)]
    pub spread: Option<f64>,
    /// Number of drive cycles shown of a motion without a period.
    #[arg(long, default_value_t = 64)]
    pub cycles: u32,
    /// Relative tolerance of the integration.
    #[arg(long, default_value = "1e-8")]
    pub tolerance: f64,
    /// Omits the continued branches.
    #[arg(long = "no-branches", action = clap::ArgAction::SetFalse)]
    pub branches: bool,
    /// Longest period of a continued branch, in drive cycles; 4 by default.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    pub longest_period: Option<u32>,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for DiagramOptions {
    fn default() -> Self {
        defaults()
    }
}

impl DiagramOptions {
    /// Checks the values that need no spec and returns the longest period of a continued branch.
    pub(super) fn longest_period(&self) -> Result<u32, Error> {
        if let Some(longest_period) = self.longest_period.filter(|_| !self.branches) {
            let expected = "it applies to continued branches; omit it, or continue the branches";
            return Err(Error::option("longest_period", longest_period, expected));
        }
        if !(1..=MAX_CYCLES).contains(&self.cycles) {
            let expected = format!("it must be from 1 to {MAX_CYCLES}");
            return Err(Error::option("cycles", self.cycles, expected));
        }
        let longest_period = self.longest_period.unwrap_or(LONGEST_PERIOD);
        continuation_options::check_search(self.tolerance, SEEDS, longest_period)?;
        Ok(longest_period)
    }

    /// Returns the seed of the cloud of starts.
    pub fn cloud_seed(&self) -> u64 {
        self.seed.unwrap_or(SEED)
    }

    /// Returns the order of the runs.
    pub(super) fn order(&self) -> Result<DiagramOrder, Error> {
        let order = match self.direction {
            DiagramDirection::Up => DiagramOrder::Up,
            DiagramDirection::Down => DiagramOrder::Down,
            DiagramDirection::Both => DiagramOrder::Both,
            DiagramDirection::Starts => {
                let starts = self.starts.unwrap_or(STARTS);
                let spread = self.spread.unwrap_or(SPREAD);
                return Ok(DiagramOrder::Starts(cloud(
                    starts,
                    self.cloud_seed(),
                    spread,
                )?));
            }
        };
        let given = [
            ("starts", self.starts.map(|value| value.to_string())),
            ("seed", self.seed.map(|value| value.to_string())),
            ("spread", self.spread.map(|value| value.to_string())),
        ];
        match given
            .into_iter()
            .find_map(|(option, value)| Some((option, value?)))
        {
            None => Ok(order),
            Some((option, value)) => {
                let expected =
                    "it applies to a cloud of starts; choose starts as `direction`, or omit it";
                Err(Error::option(option, value, expected))
            }
        }
    }
}
