//! `jounce basins SPEC --starts N --seed S`

use crate::failure::Failure;
use crate::interruption;
use crate::output::{self, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::{BasinsOptions, BasinsResult, Control, Harvester};
use std::path::Path;

/// Arguments of `basins`.
#[derive(Debug, Args)]
pub struct Basins {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: BasinsOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Basins {
    /// Integrates the starts and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        interruption::install(&control);
        let work = || harvester.basins(&self.options);
        let result = progress::with_parts("starts", &control, work);
        let result = result.map_err(|error| self.spec.failure(error))?;
        if let Some(first_failure) = result.failed.first() {
            let (failed, finished) = (result.failed.len(), result.finished);
            if failed == finished {
                let text = format!("every run failed; the first: {}", first_failure.reason);
                return Err(Failure::NotConverged(text));
            }
            let (start, reason) = (first_failure.start, &first_failure.reason);
            output::note(format!(
                "{failed} of {finished} runs failed; start {start}: {reason}"
            ));
        }
        output::warn(&result.warnings());
        if let Some(folder) = &self.output.out {
            self.write(folder, &harvester, &result)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => self.print_result(&result)?,
        }
        interruption::end(&control, || {
            format!("{} of {} starts", result.finished, result.starts)
        })
    }

    fn write(
        &self,
        folder: &Path,
        harvester: &Harvester,
        result: &BasinsResult,
    ) -> Result<(), Failure> {
        let manifest = self.spec.manifest(harvester, "basins", &self.options)?;
        output::table(folder, "attractors", &result.table()?, &manifest)?;
        output::table(folder, "starts", &result.starts_table()?, &manifest)?;
        output::figure(folder, "basins", &result.figure())
    }

    /// Prints the table of the attractors, the expected power and how the starts are drawn.
    fn print_result(&self, result: &BasinsResult) -> Result<(), Failure> {
        output::print_table(&result.table()?);
        line(format!(
            "expected power {} W ({:.3e} to {:.3e})",
            output::power(result.expected_power_w),
            result.expected_power_low_w,
            result.expected_power_high_w
        ));
        line(self.options.starts_text());
        Ok(())
    }
}
