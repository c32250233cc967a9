//! Options of a study.

use crate::options::defaults;
use jounce_analysis::study::Shard;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Study::run`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StudyOptions {
    /// Share of one of several processes: I/N, I from 1 to N.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE)]
    pub shard: Shard,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for StudyOptions {
    fn default() -> Self {
        defaults()
    }
}
