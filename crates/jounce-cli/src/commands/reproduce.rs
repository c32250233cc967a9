//! `jounce reproduce`

use crate::failure::Failure;
use crate::output::{line, print};
use clap::Args;
use jounce_core::integrate::Control;
use jounce_core::reproduce::{Reproduction, folders};
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
        let control = Control::default();
        folders(&self.out)?;
        let simulated = jounce_core::reproduce::reproduce(&control, &|stage| eprintln!("{stage}"))?;
        eprintln!(
            "Table 2 measured and figures 10 to 13, from the virtual rig; the model updated to Table 2"
        );
        let chapters = jounce_measure::experiment::chapters(&simulated, &control)?;
        let reproduction = chapters.into_iter().fold(simulated, Reproduction::with);
        let files = reproduction.write(&self.out)?;
        let names = |paths: &[PathBuf]| {
            paths
                .iter()
                .map(|path| path.display().to_string())
                .collect::<Vec<_>>()
        };
        let claims: Vec<_> = (reproduction.claims.iter())
            .map(|claim| serde_json::json!({ "claim": claim.claim, "holds": claim.holds, "evidence": claim.evidence }))
            .collect();
        if self.json {
            print(&serde_json::json!({
                "report": files.report.display().to_string(),
                "tables": names(&files.tables),
                "figures": names(&files.figures),
                "claims": claims,
            }));
            return Ok(());
        }
        for claim in &reproduction.claims {
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
        line(format!("report: {}", files.report.display()));
        Ok(())
    }
}
