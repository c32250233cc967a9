//! `jounce design DESIGN.toml`

use crate::cache;
use crate::failure::{Failure, of_file};
use crate::interruption;
use crate::output::{self, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, print_recording_issues};
use clap::Args;
use jounce::parts::{Manifest, SearchEnd};
use jounce::{Control, DesignOptions, DesignResult, Error};
use std::path::{Path, PathBuf};

/// Format of a design file; no line is wider than a terminal.
const FORMAT: &str = r#"DESIGN.toml, a small one:

  spec = "harvester.toml"
  evaluations = 1000                         # at most; also seed, seconds, draws

  [free]                                     # keys and their ranges
  "stop.tip.gap" = "0.2mm:3mm"
  "circuit.load.resistance" = "10kohm:3Mohm:log"

  [goal]
  maximise = "expected-power"                # or stable-power, bandwidth, mean-power (of one run
  starts = 100                               # from run.start, by default rest), time-on,
                                             # power-margin, or a list of several for a front

  [limits]
  "patch.mfc.strain" = "600 ppm"
  basin_fraction = 0.9

  [tolerance]                                # uniform, or "0.05 mm normal"
  "stop.tip.gap" = "0.05 mm"

All keys, with an example of each, are in the book, "Design" (book/src/howto/design.md)."#;

/// Arguments of `design`.
#[derive(Debug, Args)]
#[command(after_help = FORMAT)]
pub struct Design {
    /// Design file (TOML, described below): a spec, the free keys, the goal, the limits.
    design: PathBuf,
    #[command(flatten)]
    options: DesignOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Design {
    /// Searches and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let control = Control::default();
        let failure = |error| of_file(&self.design, error);
        let design = jounce::Design::read(&self.design).map_err(failure)?;
        let design = design.with_control(&control);
        print_recording_issues(design.spec());
        let journal = design.journal(&self.options, cache::folder());
        let journal = journal.map_err(failure)?;
        if !journal.found().is_empty() {
            output::note(format!(
                "continuing after {} finished evaluations",
                journal.found().len()
            ));
        }
        interruption::install(&control);
        let work = || design.run_with_journal(&self.options, &journal);
        let result = progress::with_parts("designs at most", &control, work);
        let result = result.map_err(failure)?;
        if let Some(folder) = &self.output.out {
            self.write(folder, &design, &result)?;
        }
        output::warn(&result.warnings());
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => line(result.text()),
        }
        if result.outcome.ended_by == SearchEnd::Stopped {
            let text = "stopped; this is the best design so far; the same command continues";
            return Err(Failure::Partial(text.to_owned()));
        }
        cache::finish(journal)?;
        match result.outcome.feasible {
            true => Ok(()),
            false => Err(Failure::Incomplete(result.violation_text())),
        }
    }

    fn write(
        &self,
        folder: &Path,
        design: &jounce::Design,
        result: &DesignResult,
    ) -> Result<(), Failure> {
        let manifest = Manifest::new(&design.spec().hash_hex())
            .with("command", "design")
            .with("design_sha256", design.hash_hex())
            .with_options(&self.options)
            .map_err(Error::from)?;
        for (name, table) in result.tables()? {
            output::table(folder, name, &table, &manifest)?;
        }
        output::figure(folder, "design", &result.figure())?;
        Ok(result.write_best(folder.join("best.toml"))?)
    }
}
