//! `jounce ensemble SPEC`

use crate::failure::Failure;
use crate::interruption;
use crate::limit_warnings;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use crate::threads::ThreadsArgument;
use clap::Args;
use jounce_core::analysis::{
    Ensemble as Study, EnsembleResult, Estimate, IntervalOver, Member, Model, StopEstimates,
    VoltageSpectrum,
};
use jounce_core::picture::{self, DensityLine};
use jounce_core::run::{ExceededLimit, RunPlan, Warning};
use jounce_core::table::{Column, Table};
use std::path::Path;

/// Maximum number of rounds of members; then the interval is reported even if it is wider than
/// required.
const MAX_ROUNDS: usize = 100;

/// Arguments of `ensemble`.
#[derive(Debug, Args)]
pub struct Ensemble {
    #[command(flatten)]
    spec: SpecArguments,
    /// Number of realisations; with --relative-width, number per round.
    #[arg(long, default_value_t = 16)]
    members: usize,
    /// Seed of the realisations.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Adds rounds of members until the half width of the 95 % interval is at most this share of
    /// the mean power.
    #[arg(long, value_name = "WIDTH")]
    relative_width: Option<f64>,
    /// Estimates the power spectral density of every voltage and its bandwidth; slower, and needs
    /// at least two members.
    #[arg(long)]
    spectrum: bool,
    #[command(flatten)]
    threads: ThreadsArgument,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Ensemble {
    /// Integrates the members and reports.
    pub fn run(&self) -> Result<(), Failure> {
        if self.members == 0
            || self
                .relative_width
                .is_some_and(|width| !(width > 0.0 && width < 1.0))
        {
            return Err(Failure::usage(
                "--members must be greater than 0, --relative-width between 0 and 1".to_owned(),
            ));
        }
        if self.spectrum && self.members < 2 {
            return Err(Failure::usage(
                "--spectrum needs at least two --members to estimate the scatter of the density"
                    .to_owned(),
            ));
        }
        let base = Model::new(self.spec.spec()?)?;
        let study = Study {
            start: base.start(&self.spec.folder())?,
            base: &base,
            members: self.members,
            seed: self.seed,
            relative_width: self.relative_width,
            most_rounds: if self.relative_width.is_some() {
                MAX_ROUNDS
            } else {
                1
            },
            with_spectrum: self.spectrum,
        };
        interruption::install(&base.kernel.control);
        let bar = progress::counting_bar(self.members, "members");
        let advance = |member: &Member| {
            bar.set_length((member.index / self.members + 1) as u64 * self.members as u64);
            bar.inc(1);
        };
        let result = self.threads.run(|| study.run(&advance))??;
        bar.finish_and_clear();
        if result.members.is_empty() {
            return Err(Failure::Interrupted(
                "stopped before the first member was finished".to_owned(),
            ));
        }
        for warning in Warning::of_recordings(&base.spec, &RunPlan::of(&base.spec.run, 0.0)) {
            eprintln!("warning: {warning}");
        }
        let exceeded: Vec<&[ExceededLimit]> = result
            .members
            .iter()
            .map(|member| member.exceeded.as_slice())
            .collect();
        limit_warnings::warn(&exceeded, "members", |index| {
            format!("member {}", result.members[index].index)
        });
        if let Some(folder) = &self.output.out {
            self.write(folder, &base, &result)?;
        }
        self.print_result(&result);
        interruption::end(&base.kernel.control, || {
            format!("the {} finished members", result.members.len())
        })
    }

    fn print_result(&self, result: &EnsembleResult) {
        let power = &result.power_w;
        let max_residual = result.members.iter().fold(0.0_f64, |max, member| {
            max.max(member.energy_residual_relative.abs())
        });
        if self.output.json {
            print(&serde_json::json!({
                "mean_power_w": power.mean,
                "mean_power_half_width_w": finite(power.half_width),
                "relative_width": finite(power.relative_width()),
                "interval_over": power.interval,
                "reached": result.reached,
                "contact_rate_hz": result.contact_rate_hz.mean,
                "contact_rate_half_width_hz": finite(result.contact_rate_hz.half_width),
                "mean_impact_velocity_m_s": result.mean_impact_velocity_m_s,
                "max_impact_velocity_m_s": result.max_impact_velocity_m_s,
                "mean_contact_duration_s": result.mean_contact_duration_s,
                "stops": result.stops.iter().map(stop_json).collect::<Vec<_>>(),
                "bandwidths_hz": result.spectra.iter().map(bandwidth_json).collect::<serde_json::Map<_, _>>(),
                "energy_residual_relative": max_residual,
                "members": result.members,
                "seed": self.seed,
            }));
            return;
        }
        let interval_text = if power.interval == IntervalOver::Members {
            "over members"
        } else {
            "over batches of the members"
        };
        line(format!(
            "mean power         {:.6e} W +- {:.1e} W (95 %, {interval_text})",
            power.mean, power.half_width
        ));
        line(format!(
            "members            {}, seed {}",
            result.members.len(),
            self.seed
        ));
        if !result.reached {
            line(format!(
                "NOT reached        the relative width is {:.3}; give more --members",
                power.relative_width()
            ));
        }
        let rate = &result.contact_rate_hz;
        if rate.mean > 0.0 {
            line(format!(
                "contacts           {:.4} per second +- {:.2}",
                rate.mean, rate.half_width
            ));
            line(format!(
                "impacts            {:.4e} m/s in the mean, {:.4e} m/s at most, {:.4e} s each",
                result.mean_impact_velocity_m_s,
                result.max_impact_velocity_m_s,
                result.mean_contact_duration_s
            ));
        }
        for stop in &result.stops {
            print_stop(stop);
        }
        for spectrum in &result.spectra {
            let (mean, width) = (spectrum.bandwidth_hz.mean, spectrum.bandwidth_hz.half_width);
            line(format!(
                "bandwidth of V     {mean:.4e} Hz +- {width:.1e} Hz (statistical, patch {})",
                spectrum.patch
            ));
        }
        line(format!(
            "energy residual    {max_residual:.1e} of the largest energy"
        ));
    }

    fn write(&self, folder: &Path, base: &Model, result: &EnsembleResult) -> Result<(), Failure> {
        let manifest = self
            .spec
            .manifest(&base.spec, "ensemble")
            .with("seed", self.seed)
            .with("members", result.members.len());
        output::table(folder, "ensemble", &table(&result.members)?, &manifest)?;
        self.write_spectra(folder, base, result)?;
        let powers: Vec<f64> = result
            .members
            .iter()
            .map(|member| member.mean_power_w)
            .collect();
        let (low, high) = (
            result.power_w.mean - result.power_w.half_width,
            result.power_w.mean + result.power_w.half_width,
        );
        output::figure(
            folder,
            "ensemble",
            &picture::ensemble("Mean power of realisations", &powers, low, high),
        )
    }
}

impl Ensemble {
    fn write_spectra(
        &self,
        folder: &Path,
        base: &Model,
        result: &EnsembleResult,
    ) -> Result<(), Failure> {
        let Some(first) = result.spectra.first() else {
            return Ok(());
        };
        let mut table = Table::new(vec![Column::new(
            "frequency_hz",
            "Hz",
            "middle of the bin",
            first.frequency_hz.clone(),
        )])?;
        let mut lines = Vec::new();
        for spectrum in &result.spectra {
            let column = |value: fn(&Estimate) -> f64| {
                spectrum.density.iter().map(value).collect::<Vec<f64>>()
            };
            let (mean, width) = (
                column(|estimate| estimate.mean),
                column(|estimate| estimate.half_width),
            );
            let name = |what: &str| format!("{}.{what}", spectrum.patch);
            table.push(Column::new(
                &name("voltage.psd"),
                "V^2/Hz",
                "power spectral density, one-sided",
                mean.clone(),
            ))?;
            table.push(Column::new(
                &name("voltage.psd_half_width"),
                "V^2/Hz",
                "half width of its 95 % interval",
                width,
            ))?;
            let bounds = [
                column(|estimate| estimate.mean - estimate.half_width),
                column(|estimate| estimate.mean + estimate.half_width),
            ];
            lines.push(DensityLine {
                quantity: name("voltage"),
                unit: "V^2/Hz".to_owned(),
                density: mean,
                interval: bounds,
            });
        }
        let manifest = self
            .spec
            .manifest(&base.spec, "ensemble")
            .with("seed", self.seed)
            .with("members", result.members.len());
        output::figure(
            folder,
            "ensemble-spectrum",
            &picture::densities("Spectra of realisations", &first.frequency_hz, &lines),
        )?;
        output::table(folder, "ensemble-spectrum", &table, &manifest)
    }
}

/// Formats a mean with its interval.
fn with_interval(estimate: &Estimate, unit: &str) -> String {
    match finite(estimate.half_width) {
        Some(half_width) => format!("{:.4e} +- {half_width:.1e} {unit}", estimate.mean),
        None => format!("{:.4e} {unit}, too few for an interval", estimate.mean),
    }
}

fn print_stop(stop: &StopEstimates) {
    if stop.contact_rate_hz.mean == 0.0 {
        return line(format!("stop {:<12}  no contacts", stop.name));
    }
    line(format!(
        "stop {:<12}  {}",
        stop.name,
        with_interval(&stop.contact_rate_hz, "contacts per second")
    ));
    line(format!(
        "  impact velocity  {}, {:.4e} m/s at most",
        with_interval(&stop.mean_impact_velocity_m_s, "m/s"),
        stop.max_impact_velocity_m_s
    ));
    line(format!(
        "  contact duration {}, {:.4e} s at most",
        with_interval(&stop.mean_contact_duration_s, "s"),
        stop.max_contact_duration_s
    ));
    line(format!(
        "  duty             {}, force {:.4e} N at most",
        with_interval(&stop.contact_duty, "of the time"),
        stop.max_contact_force_n
    ));
}

fn estimate_json(estimate: &Estimate) -> serde_json::Value {
    serde_json::json!({ "mean": finite(estimate.mean), "half_width": finite(estimate.half_width), "interval": estimate.interval })
}

fn stop_json(stop: &StopEstimates) -> serde_json::Value {
    serde_json::json!({
        "name": stop.name,
        "contact_rate_hz": estimate_json(&stop.contact_rate_hz),
        "mean_impact_velocity_m_s": estimate_json(&stop.mean_impact_velocity_m_s),
        "max_impact_velocity_m_s": stop.max_impact_velocity_m_s,
        "mean_contact_duration_s": estimate_json(&stop.mean_contact_duration_s),
        "max_contact_duration_s": stop.max_contact_duration_s,
        "contact_duty": estimate_json(&stop.contact_duty),
        "max_contact_force_n": stop.max_contact_force_n,
        "max_penetration_m": stop.max_penetration_m,
    })
}

fn bandwidth_json(spectrum: &VoltageSpectrum) -> (String, serde_json::Value) {
    (
        spectrum.patch.clone(),
        estimate_json(&spectrum.bandwidth_hz),
    )
}

fn table(members: &[Member]) -> Result<Table, Failure> {
    let number = |name: &str, unit: &str, about: &str, value: fn(&Member) -> f64| {
        Column::new(
            name,
            unit,
            about,
            members.iter().map(value).collect::<Vec<f64>>(),
        )
    };
    let integer = |name: &str, about: &str, value: fn(&Member) -> u64| {
        Column::new(
            name,
            "",
            about,
            members.iter().map(value).collect::<Vec<u64>>(),
        )
    };
    Ok(Table::new(vec![
        integer("member", "number of the realisation under its seed", |m| {
            m.index as u64
        }),
        number("mean_power_w", "W", "mean power of all loads", |m| {
            m.mean_power_w
        }),
        integer("contacts", "contacts that began", |m| m.contacts),
        number("contact_rate_hz", "Hz", "contacts per second", |m| {
            m.contact_rate_hz
        }),
        number(
            "mean_impact_velocity_m_s",
            "m/s",
            "mean impact velocity",
            |m| m.mean_impact_velocity_m_s,
        ),
        number(
            "max_impact_velocity_m_s",
            "m/s",
            "largest impact velocity",
            |m| m.max_impact_velocity_m_s,
        ),
        number(
            "mean_contact_duration_s",
            "s",
            "mean contact duration",
            |m| m.mean_contact_duration_s,
        ),
        number("max_penetration_m", "m", "largest penetration", |m| {
            m.max_penetration_m
        }),
        number(
            "energy_residual_relative",
            "",
            "energy residual relative to the largest energy",
            |m| m.energy_residual_relative,
        ),
    ])?)
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
