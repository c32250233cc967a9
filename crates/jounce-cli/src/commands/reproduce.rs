//! `jounce reproduce`

use crate::failure::Failure;
use crate::output::{self, line};
use clap::Args;
use jounce::{Control, ReproduceOptions, reproduce};

/// Arguments of `reproduce`.
#[derive(Debug, Args)]
pub struct Reproduce {
    #[command(flatten)]
    options: ReproduceOptions,
    /// Prints tables, figures and claims as one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl Reproduce {
    /// Computes and writes everything.
    pub fn run(&self) -> Result<(), Failure> {
        let stage = |stage: &str| output::note(stage);
        let result = reproduce(&self.options, &Control::default(), &stage)?;
        if self.json {
            line(output::to_json(&result)?);
            return Ok(());
        }
        for claim in &result.claims {
            line(format!(
                "{}  {}\n     {}",
                if claim.holds {
                    "holds         "
                } else {
                    "does not hold "
                },
                claim.claim,
                claim.evidence
            ));
        }
        line(format!("report: {}", result.report.display()));
        Ok(())
    }
}
