//! `jounce check SPEC`

use crate::failure::{Failure, fault_lines};
use crate::output::{self, line};
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce::CheckResult;

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    spec: SpecArguments,
    /// Prints one JSON object on stdout; by default one line of text.
    #[arg(long)]
    pub json: bool,
}

impl Check {
    /// Reads the spec and builds its plant, which finds further faults.
    pub fn run(&self) -> Result<(), Failure> {
        let harvester = match self.spec.harvester() {
            Err(Failure::Faults(path, faults)) if self.json => {
                let text = fault_lines(&path, &faults);
                line(output::to_json(&CheckResult::invalid(faults))?);
                return Err(Failure::InvalidSpec(text));
            }
            result => result?,
        };
        let result = harvester
            .check()
            .map_err(|error| self.spec.failure(error))?;
        let warnings: Vec<String> = result.warnings.iter().map(ToString::to_string).collect();
        output::warn(&warnings);
        match self.json {
            true => line(output::to_json(&result)?),
            false => line(format!("{}: valid", self.spec.spec.display())),
        }
        Ok(())
    }
}
