//! `jounce sweep SPEC --over KEY=RANGE`

use crate::cache;
use crate::failure::Failure;
use crate::interruption;
use crate::option_names::on_command_line;
use crate::output::{self, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::{Control, Harvester, SweepOptions, SweepResult};
use std::path::Path;

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: SweepOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Sweep {
    /// Sweeps and reports.
    pub fn run(&self) -> Result<(), Failure> {
        self.spec.refuse_set(&self.options.over)?;
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        let failure = |error| self.spec.failure(error);
        let journal = harvester.sweep_journal(&self.options, cache::folder());
        let journal = journal.map_err(failure)?;
        if !journal.found().is_empty() {
            output::note(format!(
                "continuing after {} finished points",
                journal.found().len()
            ));
        }
        interruption::install(&control);
        let work = || harvester.sweep_with_journal(&self.options, &journal);
        let result = progress::with_parts("points", &control, work).map_err(failure)?;
        let (finished, expected) = (result.points.len(), result.expected);
        if finished < expected {
            let text = format!(
                "stopped after {finished} of {expected} points; the same command continues from there"
            );
            return Err(Failure::Interrupted(text));
        }
        if let Some(text) = result.unsettled() {
            output::note(text);
        }
        output::warn(&result.warnings());
        if let Some(folder) = &self.output.out {
            self.write(folder, &harvester, &result)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        cache::finish(journal)
    }

    fn write(
        &self,
        folder: &Path,
        harvester: &Harvester,
        result: &SweepResult,
    ) -> Result<(), Failure> {
        let manifest = self.spec.manifest(harvester, "sweep", &self.options)?;
        output::table(folder, "sweep", &result.table()?, &manifest)?;
        output::figure(folder, "sweep", &result.figure())
    }
}

/// Prints the result as lines of text.
fn print_lines(result: &SweepResult) {
    let heading = output::key_heading(&result.key, &result.unit);
    let width = heading.len();
    line(format!(
        "{heading}  direction    mean_power_w   voltage_rms_v  settled"
    ));
    for point in &result.points {
        line(format!(
            "{:>width$}  {:<11}  {}  {:>13.6}  {}",
            output::key_value(point.parameter),
            point.direction.name(),
            output::power(point.mean_power_w),
            point.voltage_rms_v,
            point.settled
        ));
    }
    if let Some(text) = result.carried_over() {
        line(on_command_line(text));
    }
}
