//! `jounce run SPEC`

use super::run_lines::print_lines;
use crate::failure::Failure;
use crate::interruption;
use crate::output::{self, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::Warning;
use jounce::{Control, Error, Harvester, RunOptions, RunResult, StartState};
use std::path::{Path, PathBuf};

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct Run {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: RunOptions,
    /// Starts from the state that another run saved with --save-state, or from `rest` or `linear` as
    /// run.start; overrides run.start, by default rest.
    #[arg(long, value_name = "FILE")]
    start: Option<PathBuf>,
    /// Saves the last state, from which another run can continue.
    #[arg(long, value_name = "FILE")]
    save_state: Option<PathBuf>,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Run {
    /// Refuses to replace the spec by the last state.
    fn check_save_state(&self) -> Result<(), Failure> {
        let file = |path: &Path| path.canonicalize().ok();
        let state = self.save_state.as_deref().and_then(file);
        if state.is_none() || state != file(&self.spec.spec) {
            return Ok(());
        }
        let text = format!(
            "--save-state is {}, the spec of this run; choose another name",
            self.spec.spec.display()
        );
        Err(Failure::Usage(text))
    }

    /// Refuses to record the end of the run for no output.
    fn check_record(&self) -> Result<(), Failure> {
        let record_s = self.options.record_s;
        if record_s == 0.0 || self.output.json || self.output.out.is_some() {
            return Ok(());
        }
        let text = format!(
            "--record is {record_s} s; the stored end goes to --out DIR or --json: give one of them, or omit --record"
        );
        Err(Failure::Usage(text))
    }

    /// Returns the failure of the run; a state that does not fit gets the name of its file.
    fn failure(&self, error: Error) -> Failure {
        match &self.start {
            Some(path) if error.is_of_start() => {
                Failure::Input(format!("--start is {}; {error}", path.display()))
            }
            _ => self.spec.failure(error),
        }
    }

    /// Integrates and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let control = Control::default();
        let mut harvester = self.spec.harvester()?.with_control(&control);
        self.check_save_state()?;
        self.check_record()?;
        let mut options = self.options.clone();
        match self.start.as_deref().map(|path| (path, path.to_str())) {
            Some((_, Some(name @ ("rest" | "linear")))) => harvester.set("run.start", name)?,
            Some((path, _)) => options.start = Some(StartState::read(path).map_err(Error::from)?),
            None => {}
        }
        if self.output.out.is_some() {
            options = options.with_record(harvester.spec());
        }
        output::warn(&options.warnings(harvester.spec()));
        interruption::install(&control);
        let work = || harvester.run(&options);
        let result = progress::with_percent("% of the run", &control, work);
        let result = result.map_err(|error| self.failure(error))?;
        if let Some(path) = &self.save_state {
            result.end.write(path).map_err(Error::from)?;
        }
        if let Some(folder) = &self.output.out {
            self.write(folder, &harvester, &options, &result)?;
        }
        for warning in &result.warnings {
            // Issues of recordings are printed when the spec is read.
            if !matches!(warning, Warning::Recording { .. }) {
                output::note(format!("warning: {warning}"));
            }
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }

    fn write(
        &self,
        folder: &Path,
        harvester: &Harvester,
        options: &RunOptions,
        result: &RunResult,
    ) -> Result<(), Failure> {
        if let Some(table) = result.table()? {
            let manifest = self.spec.manifest(harvester, "run", options)?;
            let manifest = manifest.with("tolerance", result.tolerance);
            output::table(folder, "run", &table, &manifest)?;
        }
        for (name, figure) in result.figures()? {
            output::figure(folder, name, &figure)?;
        }
        Ok(())
    }
}
