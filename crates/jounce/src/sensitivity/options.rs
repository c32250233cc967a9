//! Options of sensitivities.

use crate::options::defaults;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Harvester::sensitivity`].
#[derive(Debug, Clone, PartialEq, Eq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SensitivityOptions {
    /// Key, or list of keys such as damping.ratios; can be given several times; by default all
    /// numbers of the spec other than 0.
    #[arg(long, value_name = "KEY")]
    pub key: Vec<String>,
    /// Orbit, by its id in `basins` for the same starts and seed; by default the one that most starts
    /// reach.
    #[arg(long, value_name = "ID")]
    pub at: Option<String>,
    /// Also the nearest fold of the branch of the orbit over the frequency of the drive.
    #[arg(long)]
    pub fold: bool,
    /// Also the nearest peak of the mean power on this branch: its frequency and its power.
    #[arg(long)]
    pub peak: bool,
    /// Number of starts of the cloud.
    #[arg(long, default_value_t = 50)]
    pub starts: usize,
    /// Seed of the random numbers that draw the cloud; another seed draws other starts.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for SensitivityOptions {
    fn default() -> Self {
        defaults()
    }
}
