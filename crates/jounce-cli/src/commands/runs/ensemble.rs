//! `jounce ensemble SPEC`

use crate::failure::Failure;
use crate::interruption;
use crate::output::{self, counted, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::{EnsembleDevice, EnsembleStop, IntervalOver};
use jounce::{Control, EnsembleOptions, EnsembleResult, Harvester};
use std::path::Path;

/// Arguments of `ensemble`.
#[derive(Debug, Args)]
pub struct Ensemble {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: EnsembleOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Ensemble {
    /// Integrates the members and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        interruption::install(&control);
        let work = || harvester.ensemble(&self.options);
        let result = progress::with_parts("members", &control, work);
        let result = result.map_err(|error| self.spec.failure(error))?;
        output::warn(&result.warnings());
        if let Some(folder) = &self.output.out {
            self.write(folder, &harvester, &result)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        interruption::end(&control, || {
            format!("the {} finished members", result.members.len())
        })
    }

    fn write(
        &self,
        folder: &Path,
        harvester: &Harvester,
        result: &EnsembleResult,
    ) -> Result<(), Failure> {
        let manifest = self.spec.manifest(harvester, "ensemble", &self.options)?;
        output::table(folder, "ensemble", &result.table()?, &manifest)?;
        output::figure(folder, "ensemble", &result.figure())?;
        if let Some(table) = result.spectrum_table()? {
            output::table(folder, "ensemble-spectrum", &table, &manifest)?;
        }
        match result.spectrum_figure() {
            Some(figure) => output::figure(folder, "ensemble-spectrum", &figure),
            None => Ok(()),
        }
    }
}

/// Prints the result as lines of text.
fn print_lines(result: &EnsembleResult) {
    let interval = match result.interval_over {
        IntervalOver::Members => "over members",
        IntervalOver::Batches => "over batches of the members",
    };
    let width = |half_width: Option<f64>| half_width.unwrap_or(f64::INFINITY);
    line(format!(
        "mean power         {} W +- {:.1e} W (95 %, {interval})",
        output::power(result.mean_power_w),
        width(result.mean_power_half_width_w)
    ));
    line(format!(
        "members            {}, seed {}",
        result.members.len(),
        result.seed
    ));
    if !result.reached {
        line(format!(
            "NOT reached        the relative width is {:.3}; give more --members",
            width(result.relative_width)
        ));
    }
    if result.contact_rate_hz > 0.0 {
        line(format!(
            "contacts           {:.4} per second +- {:.2}",
            result.contact_rate_hz,
            width(result.contact_rate_half_width_hz)
        ));
        line(format!(
            "impacts            {:.4e} m/s in the mean, {:.4e} m/s at most, {:.4e} s each",
            result.mean_impact_velocity_m_s,
            result.max_impact_velocity_m_s,
            result.mean_contact_duration_s
        ));
    }
    result.stops.iter().for_each(print_stop);
    result.devices.iter().for_each(print_device);
    for patch in &result.patches {
        line(format!(
            "bandwidth of V     {:.4e} Hz +- {:.1e} Hz (statistical, patch {})",
            patch.bandwidth_hz,
            width(patch.bandwidth_half_width_hz),
            patch.name
        ));
    }
    line(format!(
        "energy residual    {:.1e} of the largest energy",
        result.energy_residual_relative
    ));
}

/// Formats a mean with its interval.
fn with_interval(mean: f64, half_width: Option<f64>, unit: &str) -> String {
    match half_width {
        Some(half_width) => format!("{mean:.4e} +- {half_width:.1e} {unit}"),
        None => format!("{mean:.4e} {unit}, too few for an interval"),
    }
}

fn print_device(device: &EnsembleDevice) {
    let half_width = 100.0 * device.on_fraction_half_width.unwrap_or(f64::INFINITY);
    line(format!(
        "device             on for {:.2} % of the time +- {half_width:.1} %  (circuit {})",
        100.0 * device.on_fraction,
        device.name
    ));
    if let Some(cold_start_s) = device.cold_start_s {
        let cold_start = with_interval(cold_start_s, device.cold_start_half_width_s, "s");
        line(format!("  first start      {cold_start}"));
    }
    if device.never_started > 0 {
        line(format!(
            "  never starts     in {}",
            counted(device.never_started, "member")
        ));
    }
    line(format!(
        "  outages          longest {:.6} s",
        device.longest_outage_s
    ));
    line(format!(
        "  tasks            {} completed, {} interrupted",
        device.completed_tasks, device.interrupted_tasks
    ));
    let power = with_interval(device.mean_power_w, device.mean_power_half_width_w, "W");
    let margin = with_interval(device.margin_w, device.margin_half_width_w, "W");
    line(format!("  power            {power}, margin {margin}"));
}

fn print_stop(stop: &EnsembleStop) {
    if stop.contact_rate_hz == 0.0 {
        return line(format!("stop {:<12}  no contacts", stop.name));
    }
    let rate = with_interval(
        stop.contact_rate_hz,
        stop.contact_rate_half_width_hz,
        "contacts per second",
    );
    line(format!("stop {:<12}  {rate}", stop.name));
    line(format!(
        "  impact velocity  {}, {:.4e} m/s at most",
        with_interval(
            stop.mean_impact_velocity_m_s,
            stop.mean_impact_velocity_half_width_m_s,
            "m/s"
        ),
        stop.max_impact_velocity_m_s
    ));
    line(format!(
        "  contact duration {}, {:.4e} s at most",
        with_interval(
            stop.mean_contact_duration_s,
            stop.mean_contact_duration_half_width_s,
            "s"
        ),
        stop.max_contact_duration_s
    ));
    line(format!(
        "  duty             {}, force {:.4e} N at most",
        with_interval(
            stop.contact_duty,
            stop.contact_duty_half_width,
            "of the time"
        ),
        stop.max_contact_force_n
    ));
}
