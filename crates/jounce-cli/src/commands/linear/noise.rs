//! `jounce noise SPEC`

use crate::failure::Failure;
use crate::output::{self, line, power};
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::RandomStop;
use jounce::{NoiseOptions, NoiseResult};

/// Arguments of `noise`.
#[derive(Debug, Args)]
pub struct Noise {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: NoiseOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Noise {
    /// Prints means and mean squares, and writes densities.
    pub fn run(&self) -> Result<(), Failure> {
        let harvester = self.spec.harvester()?;
        let result = harvester
            .noise(&self.options)
            .map_err(|error| self.spec.failure(error))?;
        if let Some(folder) = &self.output.out {
            let manifest = self.spec.manifest(&harvester, "noise", &self.options)?;
            output::figure(folder, "noise", &result.figure())?;
            output::table(folder, "noise", &result.table()?, &manifest)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }
}

/// Prints the result as lines of text.
fn print_lines(result: &NoiseResult) {
    line(format!(
        "mean power         {} W",
        power(result.mean_power_w)
    ));
    for load in &result.loads {
        line(format!(
            "load {:<12}  {:.6} V rms, {} W by the Lyapunov equation",
            load.name,
            load.voltage_rms_v,
            power(load.mean_power_w)
        ));
        let (spectral_w, difference) = (load.spectral_power_w, load.difference_relative);
        line(format!(
            "  by quadrature    {} W, relative difference {difference:.1e}",
            power(spectral_w)
        ));
        for (drive, bandwidth_hz) in result.drives.iter().zip(&load.noise_bandwidth_hz) {
            line(format!(
                "  noise bandwidth  {bandwidth_hz:.6e} Hz per unit of drive {drive}"
            ));
        }
        line(format!(
            "  bandwidth of V   {:.6e} Hz (statistical)",
            load.statistical_bandwidth_hz
        ));
    }
    for patch in &result.patches {
        line(format!(
            "patch {:<12} {:.6} V rms",
            patch.name, patch.voltage_rms_v
        ));
    }
    for point in &result.points {
        line(format!(
            "point {:<12} {:.6e} m rms, {:.6e} m/s rms",
            point.name, point.displacement_rms_m, point.velocity_rms_m_s
        ));
    }
    for name in &result.left_out {
        line(format!(
            "LEFT OUT           drive {name}: not a stationary noise"
        ));
    }
    result.stops.iter().for_each(print_stop);
}

/// Prints how often a stop would be reached without contact.
fn print_stop(stop: &RandomStop) {
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
