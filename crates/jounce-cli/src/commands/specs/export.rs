//! `jounce export SPEC`

use crate::failure::Failure;
use crate::output::{self, line};
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce::ExportOptions;

/// Arguments of `export`.
#[derive(Debug, Args)]
pub struct Export {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: ExportOptions,
    /// Prints one JSON object on stdout; by default the names of the files.
    #[arg(long)]
    pub json: bool,
}

impl Export {
    /// Writes the files and prints their names.
    pub fn run(&self) -> Result<(), Failure> {
        let harvester = self.spec.harvester()?;
        let result = harvester
            .export(&self.options)
            .map_err(|error| self.spec.failure(error))?;
        match self.json {
            true => line(output::to_json(&result)?),
            false => result.files.iter().for_each(|path| line(path.display())),
        }
        Ok(())
    }
}
