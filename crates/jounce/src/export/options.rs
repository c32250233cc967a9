//! Options of an export.

use crate::options::defaults;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Options of [`crate::Harvester::export`].
#[derive(Debug, Clone, PartialEq, Eq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ExportOptions {
    /// Folder for mass, stiffness, damping, coupling and capacitance in modal coordinates, in the
    /// Matrix Market format, with a table of names; by default none.
    #[arg(long, value_name = "DIR")]
    pub matrices: Option<PathBuf>,
    /// File for the equivalent circuit of modes, drives, stops and loads, as a netlist of SPICE; by
    /// default none.
    #[arg(long, value_name = "FILE")]
    pub spice: Option<PathBuf>,
}

impl Default for ExportOptions {
    fn default() -> Self {
        defaults()
    }
}
