//! `jounce modes SPEC`

use crate::commands::recordings::measured_modes;
use crate::failure::Failure;
use crate::hammer_arguments::HammerArguments;
use crate::model_or_measured::ModelOrMeasured;
use crate::output::{self, line};
use crate::spec_arguments::{ModelArguments, OutputArguments};
use clap::Args;
use jounce::{MeasuredModesOptions, ModesOptions, ModesResult};

/// Arguments of `modes`.
#[derive(Debug, Args)]
pub struct Modes {
    #[command(flatten)]
    arguments: ModelOrMeasured<ModelArguments<ModesOptions>, MeasuredArguments>,
    #[command(flatten)]
    pub output: OutputArguments,
}

/// Arguments of the modes of recordings.
#[derive(Debug, Args)]
struct MeasuredArguments {
    #[command(flatten)]
    hammer: HammerArguments,
    #[command(flatten)]
    identification: MeasuredModesOptions,
}

impl Modes {
    /// Prints modes and couplings.
    pub fn run(&self) -> Result<(), Failure> {
        let ModelOrMeasured { model, measured } = &self.arguments;
        let MeasuredArguments {
            hammer,
            identification,
        } = measured;
        if !hammer.measured.is_empty() {
            return measured_modes::run(hammer, identification, &self.output);
        }
        let spec = model.spec()?;
        let harvester = spec.harvester()?;
        let result = harvester
            .modes(&model.options)
            .map_err(|error| spec.failure(error))?;
        if let Some(folder) = &self.output.out {
            let manifest = spec.manifest(&harvester, "modes", &model.options)?;
            output::table(folder, "modes", &result.table()?, &manifest)?;
            for (name, figure) in result.figures() {
                output::figure(folder, &name, &figure)?;
            }
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
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
    for patch in &result.patches {
        let (name, capacitance_f) = (&patch.name, patch.capacitance_f);
        line(format!(
            "patch {name}: capacitance {capacitance_f:.4e} F; its optimal resistances are for the patch alone"
        ));
    }
    for coupling in &result.couplings {
        line(format!(
            "patch {}, mode {}: open circuit {:.5} Hz, coupling squared {:.4e}, optimal {:.4e} ohm, 1/(w C) {:.4e} ohm",
            coupling.patch,
            coupling.mode + 1,
            coupling.open_circuit_hz,
            coupling.coupling_squared,
            coupling.optimal_resistance_ohm,
            coupling.matched_resistance_ohm
        ));
    }
}
