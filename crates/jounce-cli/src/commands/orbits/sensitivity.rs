//! `jounce sensitivity SPEC`

use crate::failure::Failure;
use crate::interruption;
use crate::output::{self, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::OrbitResult;
use jounce::{Control, SensitivityOptions, SensitivityResult};

/// Results along the branch: name, title, and what a key does to it.
const ALONG_BRANCH: [(&str, &str, &str); 3] = [
    ("nearest_fold", "nearest fold", "moves"),
    ("nearest_peak", "nearest peak", "moves"),
    ("peak_power", "mean power at this peak", "changes"),
];

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
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }
}

/// Prints the relative derivatives of the mean power.
fn print_lines(result: &SensitivityResult) {
    line(format!(
        "orbit {}, period {}, mean power {} W",
        result.at,
        result.period_cycles,
        output::power(result.mean_power_w)
    ));
    if let Some(text) = result.grazing_text() {
        line(text);
    }
    line("1 % more of a key changes the mean power by");
    for one in &result.keys {
        let power = &one.derivatives[0];
        line(format!(
            "{:>10.4} %  (+- {:.0e})  {} = {:.6e} {}",
            power.relative, power.relative_error, one.key, one.value, one.unit
        ));
    }
    for (name, title, changes) in ALONG_BRANCH {
        let mut quantities = result.quantities.iter();
        let Some(index) = quantities.position(|one| one.name == name) else {
            continue;
        };
        let OrbitResult { value, unit, .. } = &result.quantities[index];
        let value = output::key_value(*value);
        line(format!(
            "{title} {value} {unit}; 1 % more of a key {changes} it by"
        ));
        for one in &result.keys {
            let change = &one.derivatives[index];
            line(format!(
                "{:>10.4} %  (+- {:.0e})  {}",
                change.relative, change.relative_error, one.key
            ));
        }
    }
}
