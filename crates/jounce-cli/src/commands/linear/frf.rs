//! `jounce frf SPEC`

use crate::commands::recordings::measured_frf;
use crate::failure::Failure;
use crate::hammer_arguments::HammerArguments;
use crate::model_or_measured::ModelOrMeasured;
use crate::output::{self, line};
use crate::spec_arguments::{ModelArguments, OutputArguments};
use clap::Args;
use jounce::{FrfOptions, FrfResult};

/// Help text of `--input` in this command, which also applies a force to a spec.
const INPUT: &str = "With --measured: channel of the input, which need not be a force (acceleration, velocity or displacement of the base, or a voltage). \
                     Without it: point of the spec that the force acts on. By default the first channel in newtons, or the point of the first force";

/// Arguments of `frf`.
#[derive(Debug, Args)]
#[command(mut_arg("input", |input| input.help(INPUT)))]
pub struct Frf {
    #[command(flatten)]
    arguments: ModelOrMeasured<ModelArguments<FrfOptions>, HammerArguments>,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Frf {
    /// Prints the acceleration of every point and the voltage of every patch and circuit, per newton or per m/s^2 of the base.
    pub fn run(&self) -> Result<(), Failure> {
        let ModelOrMeasured {
            model,
            measured: hammer,
        } = &self.arguments;
        if !hammer.measured.is_empty() {
            return measured_frf::run(hammer, &self.output);
        }
        let spec = model.spec()?;
        let harvester = spec.harvester()?;
        let result = harvester
            .frf(&model.options)
            .map_err(|error| spec.failure(error))?;
        if let Some(folder) = &self.output.out {
            for (name, figure) in result.figures() {
                output::figure(folder, &name, &figure)?;
            }
            let manifest = spec.manifest(&harvester, "frf", &model.options)?;
            output::table(folder, "frf", &result.table()?, &manifest)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }
}

/// Prints the highest magnitude of each response.
fn print_lines(result: &FrfResult) {
    for response in &result.responses {
        let (name, unit) = (&response.name, response.unit);
        match response.highest() {
            Some(_) if response.is_zero() => line(format!("{name}: 0 at every frequency")),
            Some((index, size)) => {
                let hz = result.frequency_hz[index];
                line(format!("{name}: highest {size:.5e} {unit} at {hz:.4} Hz"));
            }
            None => {}
        }
    }
}
