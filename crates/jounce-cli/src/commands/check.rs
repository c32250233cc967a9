//! `jounce check SPEC`

use crate::failure::{Failure, fault_line};
use crate::output::{line, print};
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce_core::analysis::Model;
use jounce_measure::recording::Issue;

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Check {
    /// Reads the spec and builds its plant, which finds further faults.
    pub fn run(&self) -> Result<(), Failure> {
        let spec = match self.spec.spec() {
            Err(Failure::Faults(path, faults)) if self.output.json => {
                faults
                    .iter()
                    .for_each(|fault| eprintln!("{}", fault_line(&path, fault)));
                print(&serde_json::json!({ "valid": false, "faults": faults }));
                // The faults are printed; only the exit code remains.
                std::process::exit(4);
            }
            result => result?,
        };
        let finding_json = |(drive, finding): (&str, &Issue)| serde_json::json!({ "drive": drive, "finding": finding });
        let findings: Vec<_> = spec.findings().map(finding_json).collect();
        Model::new(spec)?;
        if self.output.json {
            print(&serde_json::json!({ "valid": true, "faults": [], "findings": findings }));
        } else {
            line(format!("{}: valid", self.spec.spec.display()));
        }
        Ok(())
    }
}
