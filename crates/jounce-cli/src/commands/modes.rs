//! `jounce modes SPEC`

use super::frf::missing_input;
use super::measured_modes::{self, BandArguments};
use crate::decay_arguments::DecayArguments;
use crate::failure::Failure;
use crate::hammer_arguments::HammerArguments;
use crate::output::{self, line, print};
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce_core::linear::couplings;
use jounce_core::picture::{ModeShape, ShapePatch, mode_shapes};
use jounce_core::spec::Spec;
use jounce_core::structure;
use jounce_core::table::{Column, Table};
use std::f64::consts::TAU;

/// Help text of `--input` in this command, which applies no force to a spec.
const INPUT: &str = "Channel of the input, which need not be a force: acceleration, velocity or displacement of the base, or a voltage; by default the \
                     first channel in newtons";

/// Arguments of `modes`.
#[derive(Debug, Args)]
#[command(mut_arg("spec", |spec| spec.required(false).required_unless_present("measured")))]
#[command(mut_arg("input", |input| input.requires("measured").help(INPUT)))]
pub struct Modes {
    #[command(flatten)]
    spec: Option<SpecArguments>,
    #[command(flatten)]
    hammer: HammerArguments,
    #[command(flatten)]
    decay: DecayArguments,
    #[command(flatten)]
    band: BandArguments,
    /// Fixes a body of the spec, by name, as in table; can be given several times; by default no
    /// body.
    #[arg(long, value_name = "BODY")]
    hold: Vec<String>,
    /// Fixes every mass of the spec, so that the beams are clamped; by default no mass.
    #[arg(long)]
    fixed_table: bool,
    #[command(flatten)]
    pub output: OutputArguments,
}

/// Returns the names of the fixed bodies.
pub fn fixed_bodies(hold: &[String], fixed_table: bool, spec: &Spec) -> Vec<String> {
    let masses = spec.mass.keys().filter(|_| fixed_table);
    hold.iter().chain(masses).cloned().collect()
}

impl Modes {
    /// Prints modes and couplings.
    pub fn run(&self) -> Result<(), Failure> {
        if !self.hammer.measured.is_empty() {
            return measured_modes::run(&self.hammer, &self.decay, &self.band, &self.output);
        }
        let arguments = self.spec.as_ref().ok_or_else(missing_input)?;
        let spec = arguments.spec()?;
        let held_bodies = fixed_bodies(&self.hold, self.fixed_table, &spec);
        let modes = structure::modes_holding(&spec, &held_bodies)?;
        let frequency_hz: Vec<f64> = modes.frequency_rad_s.iter().map(|w| w / TAU).collect();
        let couplings = couplings(&modes);
        if let Some(folder) = &self.output.out {
            let table = Table::new(vec![
                Column::new(
                    "frequency_hz",
                    "Hz",
                    "undamped short-circuit frequency",
                    frequency_hz.clone(),
                ),
                Column::new(
                    "damping_ratio",
                    "",
                    "damping ratio",
                    modes.damping_ratio.clone(),
                ),
                Column::new(
                    "discretisation_error",
                    "",
                    "estimated relative error of the frequency",
                    modes.discretisation_error.clone(),
                ),
            ])?;
            output::table(folder, "modes", &table, &arguments.manifest(&spec, "modes"))?;
            self.draw(folder, &spec, &held_bodies, &frequency_hz)?;
        }
        if self.output.json {
            let list: Vec<_> = (0..modes.len())
                .map(|i| {
                    serde_json::json!({
                        "frequency_hz": frequency_hz[i],
                        "damping_ratio": modes.damping_ratio[i],
                        "discretisation_error": modes.discretisation_error[i],
                    })
                })
                .collect();
            print(
                &serde_json::json!({ "modes": list, "couplings": couplings, "held": held_bodies }),
            );
            return Ok(());
        }
        line("mode  frequency_hz  damping_ratio");
        for (i, frequency) in frequency_hz.iter().enumerate() {
            line(format!(
                "{:>4}  {frequency:>12.5}  {:>13.5}",
                i + 1,
                modes.damping_ratio[i]
            ));
        }
        for c in couplings {
            line(format!(
                "patch {}, mode {}: open circuit {:.5} Hz, coupling squared {:.4e}",
                c.patch,
                c.mode + 1,
                c.open_circuit_hz,
                c.coupling_squared
            ));
        }
        Ok(())
    }

    fn draw(
        &self,
        folder: &std::path::Path,
        spec: &Spec,
        held_bodies: &[String],
        frequency_hz: &[f64],
    ) -> Result<(), Failure> {
        for (name, beam_shapes) in structure::shapes_along_beams(spec, held_bodies, 200)? {
            let shapes: Vec<ModeShape> = (0..frequency_hz.len().min(5))
                .filter_map(|mode| {
                    Some(ModeShape {
                        label: format!("{}: {:.2} Hz", mode + 1, frequency_hz[mode]),
                        displacement: beam_shapes.mode(mode)?,
                    })
                })
                .collect();
            let patches: Vec<ShapePatch> = (spec.patch.iter())
                .filter(|(_, patch)| patch.on == name)
                .map(|(label, patch)| ShapePatch {
                    label: label.clone(),
                    start_m: patch.start_m,
                    end_m: patch.start_m + patch.length_m,
                })
                .collect();
            let figure = mode_shapes(
                &format!("Mode shapes of {name}"),
                &beam_shapes.place_m,
                &shapes,
                &patches,
            );
            output::figure(folder, &format!("modes-{name}"), &figure)?;
        }
        Ok(())
    }
}
