//! `jounce noise SPEC`

use crate::failure::Failure;
use crate::output::{self, line, print};
use crate::spec_arguments::{OutputArguments, SpecArguments, frequency_hz};
use clap::Args;
use jounce_core::linear::{Density, Random, RandomResponse};
use jounce_core::picture::{self, DensityLine};
use jounce_core::spec::Spec;
use jounce_core::table::{Column, Table};
use std::path::Path;

/// Arguments of `noise`.
#[derive(Debug, Args)]
pub struct Noise {
    #[command(flatten)]
    spec: SpecArguments,
    /// Lowest frequency of the densities, as in 1Hz; by default the lowest of the noise.
    #[arg(long, value_name = "FREQUENCY")]
    from: Option<String>,
    /// Highest frequency of the densities; by default the highest of the noise.
    #[arg(long, value_name = "FREQUENCY")]
    to: Option<String>,
    /// Number of frequencies, evenly spaced; further ones are added around each resonance.
    #[arg(long, default_value_t = 1000)]
    points: usize,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Noise {
    /// Prints means and mean squares, and writes densities.
    pub fn run(&self) -> Result<(), Failure> {
        let spec = self.spec.spec()?;
        let random = Random::new(&spec)?;
        let frequency_hz = self.frequencies(&random)?;
        let response = random.response()?;
        if let Some(folder) = &self.output.out {
            self.write(
                folder,
                &spec,
                &frequency_hz,
                &random.densities(&frequency_hz)?,
            )?;
        }
        if self.output.json {
            print(
                &serde_json::to_value(&response)
                    .map_err(|error| Failure::Input(error.to_string()))?,
            );
        } else {
            print_response(&response);
        }
        Ok(())
    }

    fn frequencies(&self, random: &Random) -> Result<Vec<f64>, Failure> {
        let [low, high] = random.usual_band_hz();
        let frequency = |option: &str, text: &Option<String>, default: f64| {
            text.as_ref()
                .map_or(Ok(default), |text| frequency_hz(option, text))
        };
        let (from, to) = (
            frequency("from", &self.from, low)?,
            frequency("to", &self.to, high)?,
        );
        if from >= to || !(2..=1_000_000).contains(&self.points) {
            return Err(Failure::usage(
                "noise needs --from below --to, and 2 to 1000000 --points".into(),
            ));
        }
        Ok(random.frequencies_hz(from, to, self.points))
    }

    fn write(
        &self,
        folder: &Path,
        spec: &Spec,
        frequency_hz: &[f64],
        densities: &[Density],
    ) -> Result<(), Failure> {
        let mut table = Table::new(vec![Column::new(
            "frequency_hz",
            "Hz",
            "frequency",
            frequency_hz.to_vec(),
        )])?;
        let mut lines = Vec::new();
        for density in densities {
            let about = "power spectral density, one-sided, without contact";
            table.push(Column::new(
                &format!("{}.psd", density.name),
                density.unit,
                about,
                density.value.clone(),
            ))?;
            lines.push(DensityLine {
                quantity: density.name.clone(),
                unit: density.unit.to_owned(),
                density: density.value.clone(),
                interval: [Vec::new(), Vec::new()],
            });
        }
        output::figure(
            folder,
            "noise",
            &picture::densities("Power spectral densities, no contact", frequency_hz, &lines),
        )?;
        output::table(folder, "noise", &table, &self.spec.manifest(spec, "noise"))
    }
}

fn print_response(response: &RandomResponse) {
    line(format!(
        "mean power         {:.6e} W",
        response.mean_power_w
    ));
    for load in &response.loads {
        line(format!(
            "load {:<12}  {:.6} V rms, {:.9e} W by the Lyapunov equation",
            load.name, load.voltage_rms_v, load.mean_power_w
        ));
        let (spectral_w, difference) = (load.spectral_power_w, load.difference_relative);
        line(format!(
            "  by quadrature    {spectral_w:.9e} W, relative difference {difference:.1e}"
        ));
        for (drive, bandwidth_hz) in response.drives.iter().zip(&load.noise_bandwidth_hz) {
            line(format!(
                "  noise bandwidth  {bandwidth_hz:.6e} Hz per unit of drive {drive}"
            ));
        }
        line(format!(
            "  bandwidth of V   {:.6e} Hz (statistical)",
            load.statistical_bandwidth_hz
        ));
    }
    for patch in &response.patches {
        line(format!(
            "patch {:<12} {:.6} V rms",
            patch.name, patch.voltage_rms_v
        ));
    }
    for point in &response.points {
        line(format!(
            "point {:<12} {:.6e} m rms, {:.6e} m/s rms",
            point.name, point.displacement_rms_m, point.velocity_rms_m_s
        ));
    }
    for name in &response.left_out {
        line(format!(
            "LEFT OUT           drive {name}: not a stationary noise"
        ));
    }
    for stop in &response.stops {
        let (name, gap_m) = (&stop.name, stop.gap_m);
        let reason = match stop.reached_hz.zip(stop.share_beyond) {
            Some((reached_hz, share)) => {
                format!(
                    "without contact its gap of {gap_m:.4e} m is reached {reached_hz:.4e} times per second and exceeded {:.3} % of the time",
                    100.0 * share
                )
            }
            None => {
                let drive = stop.carried_by.as_deref().unwrap_or_default();
                format!(
                    "drive {drive} moves only one side of its gap of {gap_m:.4e} m with growing variance, so there is no crossing rate; use `jounce ensemble`"
                )
            }
        };
        line(format!("LEFT OUT           stop {name}: {reason}"));
    }
}
