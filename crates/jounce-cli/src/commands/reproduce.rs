//! `jounce reproduce`

use crate::failure::Failure;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `reproduce`.
#[derive(Debug, Args)]
pub struct Reproduce {
    /// Folder for the report, its tables and its pictures.
    #[arg(long, value_name = "DIR", default_value = "report")]
    out: PathBuf,
    /// Prints tables, figures and claims as one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl Reproduce {
    /// Computes and writes everything.
    pub fn run(&self) -> Result<(), Failure> {
        let _ = &self.out;
        Err(Failure::Input("not merged".into()))
    }
}
