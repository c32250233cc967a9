//! `jounce import PATH`

use crate::failure::Failure;
use crate::output::{self, line, text, warn};
use clap::Args;
use jounce::{ImportOptions, import_matrices};
use std::path::PathBuf;

/// Arguments of `import`.
#[derive(Debug, Args)]
pub struct Import {
    /// Folder with mass.mtx, stiffness.mtx and names.csv, or a universal file with modes (data set 55).
    path: PathBuf,
    #[command(flatten)]
    options: ImportOptions,
    /// Prints one JSON object on stdout; by default the part of a spec.
    #[arg(long)]
    pub json: bool,
}

impl Import {
    /// Prints the structure as part of a spec.
    pub fn run(&self) -> Result<(), Failure> {
        let result = import_matrices(&self.path, &self.options)?;
        warn(&result.warnings);
        match self.json {
            true => line(output::to_json(&result)?),
            false => text(&result.spec),
        }
        Ok(())
    }
}
