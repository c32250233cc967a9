//! `jounce branch SPEC --over KEY=FROM:TO`

use crate::failure::Failure;
use crate::interruption;
use crate::option_names::on_command_line;
use crate::output::{self, counted, key_value, line, power};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::{Bifurcation, Branch as Curve, HalfPowerBandwidth, PowerPeak, band_limit_text};
use jounce::{BranchOptions, BranchResult, Control, Harvester};
use std::path::Path;

/// Arguments of `branch`.
#[derive(Debug, Args)]
pub struct Branch {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: BranchOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Branch {
    /// Continues the branches and reports.
    pub fn run(&self) -> Result<(), Failure> {
        self.spec.refuse_set(&self.options.over)?;
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        interruption::install(&control);
        let result = progress::with_progress(&control, || harvester.branch(&self.options));
        let result = result.map_err(|error| self.spec.failure(error))?;
        let warnings = result.warnings();
        if result.branches.is_empty() {
            return Err(Failure::NotConverged(on_command_line(&warnings.join("\n"))));
        }
        output::warn(&warnings);
        if let Some(folder) = &self.output.out {
            self.write(folder, &harvester, &result)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        interruption::end(&control, || {
            format!("the {} branches that were finished", result.branches.len())
        })?;
        if result.branches.iter().any(Curve::is_complete) {
            return Ok(());
        }
        Err(Failure::Incomplete(
            "no branch is complete: continuation stopped early on each".to_owned(),
        ))
    }

    fn write(
        &self,
        folder: &Path,
        harvester: &Harvester,
        result: &BranchResult,
    ) -> Result<(), Failure> {
        let manifest = self.spec.manifest(harvester, "branch", &self.options)?;
        output::table(folder, "branches", &result.table()?, &manifest)?;
        let bifurcations = result.bifurcations_table()?;
        output::table(folder, "bifurcations", &bifurcations, &manifest)?;
        output::table(folder, "bandwidths", &result.bandwidths_table()?, &manifest)?;
        output::figure(folder, "branches", &result.figure())
    }
}

/// Prints the result as lines of text.
fn print_lines(result: &BranchResult) {
    for branch in &result.branches {
        print_branch(result, branch);
    }
    if result.branches.len() > 1 && result.peak.is_some() {
        line("all branches together");
        print_bandwidth(result, &result.peak, &result.half_power_bandwidth);
    }
    line(on_command_line(&result.note));
}

fn print_branch(result: &BranchResult, branch: &Curve) {
    let points = &branch.points;
    let stable = points.iter().filter(|point| point.stable).count();
    let undecided = points
        .iter()
        .filter(|point| point.stability_undecided)
        .count();
    let undecided_note = match undecided {
        0 => String::new(),
        _ => format!(", {undecided} of undecided stability"),
    };
    line(format!(
        "branch of period {}: {}, {stable} of them stable{undecided_note}",
        branch.period_cycles,
        counted(points.len(), "point")
    ));
    for (low, high) in branch.stable_ranges() {
        line(format!(
            "  {:<16} {:>12} {} to {} {}",
            "stable from",
            key_value(low),
            result.unit,
            key_value(high),
            result.unit
        ));
    }
    for bifurcation in &branch.bifurcations {
        let is_end = branch.ends_stable_part(bifurcation);
        print_bifurcation(result, bifurcation, is_end);
    }
    print_bandwidth(result, &branch.peak, &branch.half_power_bandwidth);
}

fn print_bifurcation(result: &BranchResult, bifurcation: &Bifurcation, is_end: bool) {
    let name = bifurcation.level.as_ref().or(bifurcation.stop.as_ref());
    let error = bifurcation.parameter_error;
    line(format!(
        "  {:<16} {:>12} {}{}  {:.6e} {}{}{}",
        bifurcation.kind.name(),
        key_value(bifurcation.parameter),
        result.unit,
        error.map_or_else(String::new, |error| format!(" +- {error:.1e}")),
        result.quantity.at(bifurcation),
        result.quantity.unit(),
        name.map_or_else(String::new, |name| format!("  {name}")),
        if is_end {
            "  end of a stable range"
        } else {
            ""
        }
    ));
}

fn print_bandwidth(
    BranchResult { key, unit, .. }: &BranchResult,
    peak: &Option<PowerPeak>,
    bandwidth: &Option<HalfPowerBandwidth>,
) {
    let (Some(peak), Some(bandwidth)) = (peak, bandwidth) else {
        return;
    };
    line(format!(
        "  {:<16} {:>12} {unit}  {} W  ({})",
        "largest stable",
        key_value(peak.parameter),
        power(peak.mean_power_w),
        band_limit_text(peak.at)
    ));
    line(format!(
        "  {:<16} {:>12} {unit}  +- {:.1e}  (range of {key} in which a stable power is at least half of it)",
        "half-power range",
        key_value(bandwidth.width),
        bandwidth.width_error
    ));
    for interval in &bandwidth.intervals {
        let (from, to) = (&interval.from, &interval.to);
        line(format!(
            "    from {} ({}) to {} {unit} ({})",
            key_value(from.parameter),
            band_limit_text(from.at),
            key_value(to.parameter),
            band_limit_text(to.at)
        ));
    }
}
