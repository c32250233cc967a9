//! Options of a design.

use crate::options::defaults;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Design::run`].
#[derive(Debug, Clone, PartialEq, Eq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DesignOptions {
    /// Seed of the search, of the cloud of starts and of the draws; by default that of the file.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Largest number of evaluated designs; by default that of the file.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    pub evaluations: Option<u32>,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for DesignOptions {
    fn default() -> Self {
        defaults()
    }
}
