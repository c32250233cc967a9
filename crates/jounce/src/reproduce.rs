//! Reproduction of the 2019 paper.

use crate::error::Error;
use crate::options::{defaults, on_threads};
use impact_harvester_2019::experiment::chapters;
use impact_harvester_2019::{Claim, Reproduction, folders};
use jounce_control::Control;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Options of [`reproduce`].
#[derive(Debug, Clone, PartialEq, Eq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ReproduceOptions {
    /// Folder for the report, its tables and its pictures.
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for ReproduceOptions {
    fn default() -> Self {
        defaults()
    }
}

/// Files and claims of a reproduction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReproduceResult {
    /// The report, one self-contained HTML file.
    pub report: PathBuf,
    /// Tables, as CSV and JSON.
    pub tables: Vec<PathBuf>,
    /// Figures, as SVG, PNG and PDF.
    pub figures: Vec<PathBuf>,
    /// Claims of the paper, each with its verdict.
    pub claims: Vec<Claim>,
}

/// Computes the tables, figures and claims of the paper "Experimental validation of an impact
/// off-resonance energy harvester" (2019) and writes them into a folder; `stage` receives the name
/// of each stage.
///
/// # Errors
/// [`Error::Reproduce`] where the folder cannot be written or the control stops the computation.
///
/// ```no_run
/// let options = jounce::ReproduceOptions::default();
/// let control = jounce::Control::default();
/// let result = jounce::reproduce(&options, &control, &|stage| eprintln!("{stage}"))?;
/// println!("{}", result.report.display());
/// # Ok::<(), jounce::Error>(())
/// ```
pub fn reproduce(
    options: &ReproduceOptions,
    control: &Control,
    stage: &(dyn Fn(&str) + Sync),
) -> Result<ReproduceResult, Error> {
    on_threads(options.threads, || computed(options, control, stage))
}

fn computed(
    options: &ReproduceOptions,
    control: &Control,
    stage: &dyn Fn(&str),
) -> Result<ReproduceResult, Error> {
    folders(&options.out)?;
    let simulated = impact_harvester_2019::reproduce(control, stage)?;
    stage(
        "Table 2 measured and figures 10 to 13, from the virtual rig; the model updated to Table 2",
    );
    let chapters = chapters(&simulated, control)?;
    let reproduction = chapters.into_iter().fold(simulated, Reproduction::with);
    let files = reproduction.write(&options.out)?;
    Ok(ReproduceResult {
        report: files.report,
        tables: files.tables,
        figures: files.figures,
        claims: reproduction.claims,
    })
}
