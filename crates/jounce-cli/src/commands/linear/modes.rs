//! `jounce modes SPEC`

use super::frf::missing_input;
use crate::commands::recordings::measured_modes;
use crate::failure::Failure;
use crate::hammer_arguments::{HammerArguments, of_test};
use crate::output::{self, line, print};
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::{MeasuredModesOptions, ModesOptions, ModesResult};

/// Arguments of `modes`.
#[derive(Debug, Args)]
#[command(mut_arg("spec", |spec| spec.required(false).required_unless_present("measured")))]
#[command(mut_arg("input", |input| input.requires("measured")))]
#[command(mut_args(of_test::<MeasuredModesOptions>))]
pub struct Modes {
    #[command(flatten)]
    spec: Option<SpecArguments>,
    #[command(flatten)]
    hammer: HammerArguments,
    #[command(flatten)]
    identification: MeasuredModesOptions,
    #[command(flatten)]
    options: ModesOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Modes {
    /// Prints modes and couplings.
    pub fn run(&self) -> Result<(), Failure> {
        if !self.hammer.measured.is_empty() {
            return measured_modes::run(&self.hammer, &self.identification, &self.output);
        }
        let spec = self.spec.as_ref().ok_or_else(missing_input)?;
        let harvester = spec.harvester()?;
        let result = harvester
            .modes(&self.options)
            .map_err(|error| spec.failure(error))?;
        if let Some(folder) = &self.output.out {
            let manifest = spec.manifest(harvester.spec(), "modes");
            output::table(folder, "modes", &result.table()?, &manifest)?;
            for (name, figure) in result.figures() {
                output::figure(folder, &name, &figure)?;
            }
        }
        match self.output.json {
            true => print(&output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }
}

/// Prints the result as lines of text.
fn print_lines(result: &ModesResult) {
    line("mode  frequency_hz  damping_ratio");
    for (index, mode) in result.modes.iter().enumerate() {
        let (number, frequency_hz, damping_ratio) =
            (index + 1, mode.frequency_hz, mode.damping_ratio);
        line(format!(
            "{number:>4}  {frequency_hz:>12.5}  {damping_ratio:>13.5}"
        ));
    }
    for coupling in &result.couplings {
        line(format!(
            "patch {}, mode {}: open circuit {:.5} Hz, coupling squared {:.4e}",
            coupling.patch,
            coupling.mode + 1,
            coupling.open_circuit_hz,
            coupling.coupling_squared
        ));
    }
}
