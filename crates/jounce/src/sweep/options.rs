//! Options of a sweep.

use crate::options::defaults;
use serde::{Deserialize, Serialize};

/// Order of the points of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepOrder {
    /// From the first value to the last, each starting from the state of the one before.
    Up,
    /// From the last value to the first, each starting from the state of the one before.
    Down,
    /// Up, then down from the last state.
    Both,
    /// Each point from the start of the spec, in parallel.
    Independent,
}

/// Options of [`crate::Harvester::sweep`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SweepOptions {
    /// The key and its values: KEY=FROM:TO:STEP, KEY=FROM:TO:Nx, KEY=FROM:TO:Nlog or KEY=A,B,C.
    #[arg(long, value_name = "KEY=RANGE")]
    pub over: String,
    /// Order of the points; those over reduction.modes are always independent.
    #[arg(long, value_enum, default_value = "up")]
    pub direction: SweepOrder,
    /// Runs every point for run.duration and averages over run.average_over, instead of until
    /// steady state: the average may contain a transient, also where the point has settled at its
    /// end. This also holds for drives without a common period, which restart at each point.
    #[arg(long)]
    pub fixed_duration: bool,
    /// Required relative error of the response; overrides run.tolerance.
    #[arg(long)]
    pub tolerance: Option<f64>,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for SweepOptions {
    fn default() -> Self {
        defaults()
    }
}

impl From<SweepOrder> for jounce_analysis::SweepOrder {
    fn from(order: SweepOrder) -> Self {
        match order {
            SweepOrder::Up => Self::Up,
            SweepOrder::Down => Self::Down,
            SweepOrder::Both => Self::Both,
            SweepOrder::Independent => Self::Independent,
        }
    }
}
