//! `jounce sensitivity SPEC`

use crate::failure::Failure;
use crate::interruption;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::{Control, SensitivityOptions, SensitivityResult};

/// Arguments of `sensitivity`.
#[derive(Debug, Args)]
pub struct Sensitivity {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: SensitivityOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Sensitivity {
    /// Computes the derivatives and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        interruption::install(&control);
        let work = || harvester.sensitivity(&self.options);
        let result = progress::with_progress(&control, work);
        let result = result.map_err(|error| self.spec.failure(error))?;
        for failed in &result.failed {
            output::note(format!(
                "{} has no derivative: {}",
                failed.key, failed.reason
            ));
        }
        if let Some(folder) = &self.output.out {
            let manifest = self
                .spec
                .manifest(&harvester, "sensitivity", &self.options)?;
            output::table(folder, "sensitivity", &result.table()?, &manifest)?;
            output::figure(folder, "sensitivity", &result.figure())?;
        }
        match self.output.json {
            true => print(&output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }
}

/// Prints the relative derivatives of the mean power.
fn print_lines(result: &SensitivityResult) {
    line(format!(
        "orbit {}, period {}, mean power {:.6e} W",
        result.at, result.period_cycles, result.mean_power_w
    ));
    line("1 % more of a key changes the mean power by");
    for one in &result.keys {
        let power = &one.derivatives[0];
        line(format!(
            "{:>10.4} %  (+- {:.0e})  {} = {:.6e} {}",
            power.relative, power.relative_error, one.key, one.value, one.unit
        ));
    }
    let mut quantities = result.quantities.iter();
    let Some(index) = quantities.position(|one| one.name == "nearest_fold") else {
        return;
    };
    line(format!(
        "nearest fold {:.6} Hz; 1 % more of a key moves it by",
        result.quantities[index].value
    ));
    for one in &result.keys {
        let moved = &one.derivatives[index];
        line(format!(
            "{:>10.4} %  (+- {:.0e})  {}",
            moved.relative, moved.relative_error, one.key
        ));
    }
}
