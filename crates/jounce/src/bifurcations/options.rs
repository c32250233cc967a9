//! Options of bifurcation curves.

use crate::options::defaults;
use jounce_analysis::BifurcationSearch;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Harvester::bifurcations`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BifurcationsOptions {
    /// First key and its range, along which bifurcations are found:
    /// drive.shaker.frequency=4Hz:20Hz.
    #[arg(long, value_name = "KEY=FROM:TO")]
    pub over: String,
    /// Second key and its range, in which they are continued: stop.tip.gap=0.5mm:2mm.
    #[arg(long, value_name = "KEY=FROM:TO")]
    pub against: String,
    /// Relative tolerance of the integration that computes the orbits.
    #[arg(long, default_value = "1e-9")]
    pub tolerance: f64,
    /// Number of values of the key inside a range, at equal distances, at which integrations search for
    /// orbits; they find isolated branches. 0: only branches that cross an end of a range.
    #[arg(long, default_value_t = BifurcationSearch::DEFAULT_SEEDS)]
    pub seeds: usize,
    /// Longest period of a branch, in drive cycles; longer ones are omitted.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..))]
    pub longest_period: u32,
    /// Omits the curves of maximum mean power along the first key.
    #[arg(long = "no-peaks", action = clap::ArgAction::SetFalse)]
    pub peaks: bool,
    /// Level to continue as a curve, in quotes, as in --level "mean_power=50 uW", "voltage.PATCH=5
    /// V", "strain.PATCH=3e-4" or "contact_force.STOP=2 N"; can be given several times.
    #[arg(long = "level", value_name = "QUANTITY=VALUE")]
    pub levels: Vec<String>,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for BifurcationsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl BifurcationsOptions {
    /// Returns the note on the curves that the search may miss.
    pub(super) fn note(&self) -> String {
        let branches = match self.seeds {
            0 => "on which no run at an end of their range settles".to_owned(),
            seeds => format!("that none of {seeds} seeds converges to"),
        };
        format!(
            "the search misses curves that pass neither an edge of the two ranges nor the second key's value in the spec, and curves of branches {branches} or of a period above {} cycles; other ranges, more `seeds` and a larger `longest_period` find more",
            self.longest_period
        )
    }
}
