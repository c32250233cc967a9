//! Options of modes.

use crate::options::defaults;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Harvester::modes`].
#[derive(Debug, Clone, PartialEq, Eq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ModesOptions {
    /// Fixes a mass of the spec, by name, as in table; can be given several times; by default no
    /// mass.
    #[arg(long, value_name = "MASS")]
    pub hold: Vec<String>,
    /// Fixes every mass of the spec, so that the beams are clamped; by default no mass.
    #[arg(long)]
    pub fixed_table: bool,
}

impl Default for ModesOptions {
    fn default() -> Self {
        defaults()
    }
}
