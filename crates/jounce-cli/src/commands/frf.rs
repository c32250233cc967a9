//! `jounce frf SPEC`

use super::measured_frf;
use super::modes::fixed_bodies;
use crate::failure::Failure;
use crate::hammer_arguments::HammerArguments;
use crate::output::{self, line, print};
use crate::spec_arguments::{OutputArguments, SpecArguments, frequency_hz};
use clap::Args;
use jounce_core::linear::{self, FrfInput, FrfResponse};
use jounce_core::picture::{self, Scale};
use jounce_core::plant::{Plant, System};
use jounce_core::spec::{DriveKind, Gravity};
use jounce_core::structure;
use jounce_core::table::{Column, Manifest, Table};
use std::path::Path;

/// Arguments of `frf`.
#[derive(Debug, Args)]
#[command(mut_arg("spec", |spec| spec.required(false).required_unless_present("measured")))]
pub struct Frf {
    #[command(flatten)]
    spec: Option<SpecArguments>,
    #[command(flatten)]
    hammer: HammerArguments,
    /// Lowest frequency, as in 1Hz.
    #[arg(long, default_value = "1Hz")]
    from: String,
    /// Highest frequency, as in 1000Hz.
    #[arg(long, default_value = "1000Hz")]
    to: String,
    /// Number of frequencies, logarithmically spaced.
    #[arg(long, default_value_t = 2000)]
    points: usize,
    /// Excites the base instead of a point; displacements are then relative to the base.
    #[arg(long, conflicts_with = "input")]
    base: bool,
    /// Fixes a body, by name; can be given several times.
    #[arg(long, value_name = "BODY")]
    hold: Vec<String>,
    /// Fixes every mass.
    #[arg(long)]
    fixed_table: bool,
    /// Omits the circuit of every patch.
    #[arg(long)]
    open_circuit: bool,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Frf {
    /// Prints the acceleration of every point and the voltage of every patch and circuit, per newton or per m/s^2 of the base.
    pub fn run(&self) -> Result<(), Failure> {
        if !self.hammer.measured.is_empty() {
            return measured_frf::run(&self.hammer, &self.output);
        }
        let arguments = self.spec.as_ref().ok_or_else(missing_input)?;
        let mut spec = arguments.spec()?;
        let frequency_hz = self.frequencies()?;
        let held_bodies = fixed_bodies(&self.hold, self.fixed_table, &spec);
        let forced = spec
            .drive
            .values()
            .find(|drive| drive.kind == DriveKind::Force);
        let input = match (&self.hammer.input, forced) {
            _ if self.base => FrfInput::BaseAcceleration,
            (Some(point), _) => FrfInput::Force(point.clone()),
            (None, Some(drive)) => FrfInput::Force(drive.at.clone()),
            (None, None) => {
                let reason = "this spec has no force: name the excitation point with --input POINT, or excite the base with --base";
                return Err(Failure::usage(reason.into()));
            }
        };
        if self.base
            && let Some((name, _)) = spec
                .modal
                .iter()
                .find(|(_, modal)| modal.participation_sqrt_kg.is_empty())
        {
            let reason = "is missing: it gives the excitation of this structure by the base";
            return Err(Failure::Input(format!(
                "modal.{name}.participation_sqrt_kg {reason}"
            )));
        }
        if self.open_circuit {
            spec.open_circuits();
        }
        spec.take_drives_away();
        spec.gravity = Gravity::default();
        spec.stop.clear();
        let modes = structure::modes_holding(&spec, &held_bodies)?;
        let motion = if self.base {
            FrfResponse::Displacement
        } else {
            FrfResponse::Acceleration
        };
        let points = modes.shape.keys().map(|point| motion(point.clone()));
        let patches = modes
            .patch
            .keys()
            .map(|patch| FrfResponse::Voltage(patch.clone()));
        let loads = spec
            .circuit
            .keys()
            .map(|load| FrfResponse::LoadVoltage(load.clone()));
        let responses: Vec<FrfResponse> = points.chain(patches).chain(loads).collect();
        let plant = Plant::new(System::assemble(&spec, modes)?)?;
        let functions = linear::frf(&plant, &input, &responses, &frequency_hz)?;
        if let Some(folder) = &self.output.out {
            write(
                folder,
                &arguments.manifest(&spec, "frf"),
                &frequency_hz,
                &functions,
                &input,
            )?;
        }
        self.print_result(&input, &held_bodies, &frequency_hz, &functions);
        Ok(())
    }

    fn print_result(
        &self,
        input: &FrfInput,
        held_bodies: &[String],
        frequency_hz: &[f64],
        functions: &[linear::Frf],
    ) {
        if self.output.json {
            let response_map: serde_json::Map<String, serde_json::Value> = (functions.iter())
                .map(|frf| {
                    let re: Vec<f64> = frf.value.iter().map(|v| v.re).collect();
                    let im: Vec<f64> = frf.value.iter().map(|v| v.im).collect();
                    (
                        frf.response.name(),
                        serde_json::json!({ "re": re, "im": im, "unit": frf.response.unit(input) }),
                    )
                })
                .collect();
            print(
                &serde_json::json!({ "input": input_name(input), "held": held_bodies, "frequency_hz": frequency_hz, "responses": response_map }),
            );
            return;
        }
        for frf in functions {
            let highest = frf
                .value
                .iter()
                .map(|v| v.norm())
                .enumerate()
                .max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((index, size)) = highest {
                line(format!(
                    "{}: highest {size:.5e} {} at {:.4} Hz",
                    frf.response.name(),
                    frf.response.unit(input),
                    frequency_hz[index]
                ));
            }
        }
    }

    fn frequencies(&self) -> Result<Vec<f64>, Failure> {
        let (from, to) = (
            frequency_hz("from", &self.from)?,
            frequency_hz("to", &self.to)?,
        );
        if from >= to || !(2..=1_000_000).contains(&self.points) {
            return Err(Failure::usage(
                "frf needs --from below --to, and 2 to 1000000 --points".into(),
            ));
        }
        let ratio = (to / from).ln() / (self.points - 1) as f64;
        Ok((0..self.points)
            .map(|k| {
                if k + 1 == self.points {
                    to
                } else {
                    from * (ratio * k as f64).exp()
                }
            })
            .collect())
    }
}

fn write(
    folder: &Path,
    manifest: &Manifest,
    frequency_hz: &[f64],
    functions: &[linear::Frf],
    input: &FrfInput,
) -> Result<(), Failure> {
    let mut table = Table::new(vec![Column::new(
        "frequency_hz",
        "Hz",
        "frequency",
        frequency_hz.to_vec(),
    )])?;
    for frf in functions {
        let (name, unit) = (frf.response.name(), frf.response.unit(input));
        let (re, im): (Vec<f64>, Vec<f64>) = frf.value.iter().map(|v| (v.re, v.im)).unzip();
        table.push(Column::new(
            &format!("{name}.re"),
            unit,
            "real part",
            re.clone(),
        ))?;
        table.push(Column::new(
            &format!("{name}.im"),
            unit,
            "imaginary part",
            im.clone(),
        ))?;
        let response = picture::ResponseLine {
            label: name.clone(),
            re,
            im,
        };
        let figure =
            picture::frequency_responses(&name, &name, unit, Scale::Log, frequency_hz, &[response]);
        output::figure(folder, &format!("frf-{name}"), &figure)?;
    }
    output::table(folder, "frf", &table, manifest)
}

/// Returns the failure where neither a spec nor recordings are given.
pub fn missing_input() -> Failure {
    Failure::usage("give a SPEC, or recordings of a hammer test with --measured FILE...".to_owned())
}

fn input_name(input: &FrfInput) -> &str {
    match input {
        FrfInput::Force(point) => point,
        FrfInput::BaseAcceleration => "base",
    }
}
