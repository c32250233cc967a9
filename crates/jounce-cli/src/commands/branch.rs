//! `jounce branch SPEC --over KEY=FROM:TO`

use super::bandwidth;
use super::branch_json::branch_to_json;
use super::branch_tables::{bifurcations_table, points_table};
use crate::failure::Failure;
use crate::interruption;
use crate::level_arguments::LevelArguments;
use crate::limit_warnings;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use crate::threads::ThreadsArgument;
use clap::{Args, ValueEnum};
use jounce_core::analysis::{
    AnalysisError, BranchOptions, BranchSearch, Model, NotProved, OrbitMethodKind, Parameter,
    Termination,
};
use jounce_core::analysis::{
    BandwidthSearch, Bandwidths, Bifurcation, Branch as Curve, BranchPoint,
};
use jounce_core::orbit::OrbitError;
use jounce_core::picture::{self, Axis, BranchLine, BranchMark};
use jounce_core::plant::{Plant, System};
use jounce_core::run::{ExceededLimit, Limits};
use jounce_core::spec::{NumericKey, Spec};
use std::path::Path;

/// Number of harmonics at the start of harmonic balance.
const HARMONICS: usize = 64;

/// Method of computing orbits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OrbitMethod {
    /// Shooting with the exact flow: every contact law, every period.
    Shooting,
    /// Harmonics of the contact forces: contact laws with a finite force.
    HarmonicBalance,
}

/// Arguments of `branch`.
#[derive(Debug, Args)]
pub struct Branch {
    #[command(flatten)]
    spec: SpecArguments,
    /// The key and its range: KEY=FROM:TO, as in drive.shaker.frequency=4Hz:20Hz.
    #[arg(long, value_name = "KEY=FROM:TO")]
    over: String,
    /// Method of computing orbits.
    #[arg(long, value_enum, default_value = "shooting")]
    method: OrbitMethod,
    /// Harmonics of the drive at the start of --method harmonic-balance; 64 if left out. More are
    /// added until the tolerance is met.
    #[arg(long)]
    harmonics: Option<usize>,
    /// Relative tolerance of the integration that computes the orbits.
    #[arg(long, default_value_t = 5e-10)]
    tolerance: f64,
    /// Number of values inside the range at which orbits are sought by integration; they find
    /// isolated branches.
    #[arg(long, default_value_t = 12)]
    seeds: usize,
    /// Longest period of a branch, in drive cycles; longer ones are left out.
    #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(1..))]
    longest_period: u32,
    #[command(flatten)]
    levels: LevelArguments,
    /// Largest step along a branch, in relative changes of the state or twentieths of the range.
    #[arg(long, default_value_t = BranchOptions::default().largest_step)]
    largest_step: f64,
    /// Limit on the work of continuation, in drive cycles of all orbits. Branches beyond it are
    /// counted, but not continued.
    #[arg(long, default_value_t = BranchOptions::default().budget)]
    budget: usize,
    #[command(flatten)]
    threads: ThreadsArgument,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Branch {
    /// Continues the branches and reports.
    pub fn run(&self) -> Result<(), Failure> {
        jounce::check_tolerance(self.tolerance)?;
        let method = self.method()?;
        let file = self.spec.file()?;
        let spec = self.spec.read(&file)?;
        let (key, range) = self.spec.key_and_ends(&file, &self.over)?;
        let base = Model::new(spec)?;
        let quantity = OrbitQuantity::of(&base.kernel.plant.system)?;
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range,
            method,
            tolerance: self.tolerance,
            seeds: self.seeds,
            longest_period: self.longest_period,
        };
        let options = self.options(&base.kernel.plant)?;
        let width = BandwidthSearch {
            base: &base,
            parameter: &parameter,
            range,
            tolerance: self.tolerance,
        };
        let limits = Limits::of(&base.spec, &base.kernel.plant);
        let work = || -> Result<_, OrbitError<AnalysisError>> {
            let branches = search.run_with(&options)?;
            let exceeded: Result<Vec<_>, AnalysisError> = branches
                .iter()
                .map(|branch| branch.exceeded(&parameter, &limits, self.tolerance))
                .collect();
            let exceeded = match exceeded {
                // The branches found so far are returned without their warnings.
                Err(_) if base.kernel.control.is_stopped() => branches
                    .iter()
                    .map(|branch| vec![Vec::new(); branch.points.len()])
                    .collect(),
                exceeded => exceeded.map_err(OrbitError::Harvester)?,
            };
            Ok((width.run(&branches), exceeded, branches))
        };
        interruption::install(&base.kernel.control);
        let (widths, exceeded, branches) =
            progress::with_progress(&base.kernel.control, || self.threads.run(work))??;
        if branches.is_empty() && base.kernel.control.is_stopped() {
            return Err(Failure::Interrupted(
                "stopped before the first branch was finished".to_owned(),
            ));
        }
        if branches.is_empty() {
            let text = format!(
                "no periodic orbit was found over {}: no integration reached one; try more --seeds, a longer --longest-period, more damping or another range",
                self.over
            );
            return Err(Failure::NotConverged(text));
        }
        self.print_warnings(&branches, key.unit().as_ref());
        let values: Vec<f64> = branches
            .iter()
            .flat_map(|branch| &branch.points)
            .map(|point| point.parameter)
            .collect();
        let all_exceeded: Vec<&[ExceededLimit]> =
            exceeded.iter().flatten().map(Vec::as_slice).collect();
        limit_warnings::warn(&all_exceeded, "points", |index| {
            format!("{} = {:.6} {}", key.path(), values[index], key.unit())
        });
        self.print_result(
            (&base.spec, quantity),
            &key,
            (&branches, &exceeded),
            &widths,
        )?;
        interruption::end(&base.kernel.control, || {
            format!("the {} branches that were finished", branches.len())
        })?;
        if branches.iter().any(Curve::is_complete) {
            return Ok(());
        }
        Err(Failure::Incomplete(
            "no branch is complete: continuation stopped early on each".to_owned(),
        ))
    }

    fn options(&self, plant: &Plant) -> Result<BranchOptions, Failure> {
        let largest_step = self.largest_step;
        if !(1e-3..=1.0).contains(&largest_step) {
            return Err(Failure::usage(format!(
                "--largest-step {largest_step}: give a number from 0.001 to 1"
            )));
        }
        Ok(BranchOptions {
            largest_step,
            budget: self.budget,
            levels: self.levels.read(plant)?,
        })
    }

    fn method(&self) -> Result<OrbitMethodKind, Failure> {
        match (self.method, self.harmonics) {
            (_, Some(harmonics)) if !(4..=2048).contains(&harmonics) => Err(Failure::usage(
                format!("--harmonics {harmonics}: give a number from 4 to 2048"),
            )),
            (OrbitMethod::Shooting, Some(harmonics)) => Err(Failure::usage(format!(
                "--harmonics {harmonics}: --method shooting has no harmonics; add --method harmonic-balance or leave --harmonics out"
            ))),
            (OrbitMethod::Shooting, None) => Ok(OrbitMethodKind::Shooting),
            (OrbitMethod::HarmonicBalance, harmonics) => Ok(OrbitMethodKind::HarmonicBalance {
                harmonics: harmonics.unwrap_or(HARMONICS),
            }),
        }
    }

    /// Returns a note on branches that the search may miss, and on the options that find more.
    fn note(&self) -> String {
        format!(
            "the search misses branches that none of {} seeds converges to, and branches of a period above {} cycles; more --seeds and a longer --longest-period find more",
            self.seeds, self.longest_period
        )
    }

    /// Prints branches that end early, and large error estimates.
    fn print_warnings(&self, branches: &[Curve], unit: &str) {
        for (branch, ending) in branches
            .iter()
            .flat_map(|branch| branch.endings.iter().map(move |ending| (branch, ending)))
        {
            let (event_text, why, parameter) = match ending {
                Termination::Failed { why, parameter } => ("ends", why, parameter),
                Termination::Grazing { why, parameter } => (
                    "has a sharp kink at a grazing point and ends",
                    why,
                    parameter,
                ),
                Termination::Sticking { why, parameter } => {
                    ("begins to stick and ends", why, parameter)
                }
                Termination::Points => {
                    let points = branch.points.len();
                    let cycles = branch.period_cycles;
                    eprintln!(
                        "a branch of period {cycles} was stopped after {points} points: give a shorter range or a larger --budget"
                    );
                    continue;
                }
                Termination::Range | Termination::Closed | Termination::Merged => continue,
            };
            eprintln!(
                "a branch of period {} {event_text} at {parameter} {}: {why}",
                branch.period_cycles, unit
            );
        }
        let skipped: usize = branches.iter().map(|branch| branch.not_followed).sum();
        if skipped > 0 {
            eprintln!(
                "warning: the branches of {skipped} period doublings were not continued: the --budget of {} is used up, or Newton iteration found no first orbit",
                self.budget
            );
        }
        for (branch, interval) in branches.iter().flat_map(|branch| {
            branch
                .not_proved
                .iter()
                .map(move |interval| (branch, interval))
        }) {
            let (cycles, event, NotProved { from, to, why, .. }) =
                (branch.period_cycles, interval.event.name(), interval);
            eprintln!(
                "warning: a branch of period {cycles} may hold two more events `{event}` from {from} to {to} {unit}: {why}"
            );
        }
        let estimates = branches
            .iter()
            .flat_map(|branch| &branch.points)
            .map(|point| (point.orbit.error_estimate, point.parameter));
        if let Some((max_error, parameter)) = estimates
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(max_error, _)| *max_error > 1e-3)
        {
            let method_hint = if self.method == OrbitMethod::Shooting {
                ""
            } else {
                " or --method shooting"
            };
            eprintln!(
                "the largest error estimate is {max_error:.1e}, at {parameter} {}: try a smaller --tolerance{method_hint}",
                unit
            );
        }
    }

    fn print_result(
        &self,
        (spec, quantity): (&Spec, OrbitQuantity),
        key: &NumericKey,
        (branches, exceeded): (&[Curve], &[Vec<Vec<ExceededLimit>>]),
        widths: &Bandwidths,
    ) -> Result<(), Failure> {
        if let Some(folder) = &self.output.out {
            self.write(folder, (spec, quantity), key, branches, widths)?;
        }
        if self.output.json {
            let branch_list: Vec<_> = (branches.iter().zip(exceeded).zip(&widths.branches))
                .map(|((branch, exceeded), width)| branch_to_json(branch, exceeded, width.as_ref()))
                .collect();
            let overall = widths.together.as_ref();
            print(&serde_json::json!({
                "over": key.path(),
                "unit": key.unit(),
                "branches": branch_list,
                "peak": overall.map(|width| width.peak),
                "half_power_bandwidth": overall.map(bandwidth::to_json),
                "note": self.note(),
            }));
            return Ok(());
        }
        for (branch, width) in branches.iter().zip(&widths.branches) {
            let stable = branch
                .points
                .iter()
                .filter(|point| point.orbit.is_stable())
                .count();
            let undecided = branch
                .points
                .iter()
                .filter(|point| point.orbit.is_stability_undecided())
                .count();
            let undecided_note = if undecided > 0 {
                format!(", {undecided} of undecided stability")
            } else {
                String::new()
            };
            line(format!(
                "branch of period {}: {} points, {stable} of them stable{undecided_note}",
                branch.period_cycles,
                branch.points.len()
            ));
            for bifurcation in &branch.bifurcations {
                let (at, unit) = (&bifurcation.at, key.unit());
                let (value, quantity_unit) = (quantity.value(at), quantity.unit());
                let name = bifurcation
                    .level
                    .as_ref()
                    .or(bifurcation.stop.as_ref())
                    .map_or_else(String::new, |name| format!("  {name}"));
                line(format!(
                    "  {:<16} {:>12} {unit}  {value:.6e} {quantity_unit}{name}",
                    bifurcation.kind.name(),
                    output::key_value(at.parameter)
                ));
            }
            width
                .iter()
                .for_each(|width| bandwidth::print(width, &key.unit()));
        }
        if let Some(overall) = widths.together.as_ref().filter(|_| branches.len() > 1) {
            line("all branches together");
            bandwidth::print(overall, &key.unit());
        }
        line(self.note());
        Ok(())
    }

    fn write(
        &self,
        folder: &Path,
        (spec, quantity): (&Spec, OrbitQuantity),
        key: &NumericKey,
        branches: &[Curve],
        widths: &Bandwidths,
    ) -> Result<(), Failure> {
        let manifest = self
            .spec
            .manifest(spec, "branch")
            .with("over", &self.over)
            .with("tolerance", self.tolerance);
        output::table(folder, "branches", &points_table(key, branches)?, &manifest)?;
        output::table(
            folder,
            "bifurcations",
            &bifurcations_table(key, branches)?,
            &manifest,
        )?;
        output::table(
            folder,
            "bandwidths",
            &bandwidth::table(key, widths)?,
            &manifest,
        )?;
        let lines: Vec<BranchLine> = branches
            .iter()
            .map(|branch| branch_line(branch, quantity))
            .collect();
        let marks = branches.iter().flat_map(|branch| {
            branch
                .bifurcations
                .iter()
                .map(|bifurcation| mark(bifurcation, quantity))
        });
        let marks: Vec<BranchMark> = marks.collect();
        let (x, y) = (Axis::linear(key.path(), &key.unit()), quantity.axis());
        let title = format!("Branches of periodic orbits over {}", key.path());
        output::figure(
            folder,
            "branches",
            &picture::branches(&title, x, y, &lines, &marks),
        )
    }
}

/// Quantity of an orbit that is printed and drawn over the parameter.
#[derive(Debug, Clone, Copy)]
enum OrbitQuantity {
    /// Mean power.
    Power,
    /// Displacement amplitude at the first stop, for a harvester without a circuit.
    Displacement,
}

impl OrbitQuantity {
    fn of(system: &System) -> Result<Self, Failure> {
        match (system.loads.is_empty() && system.bridges.is_empty(), system.stops.is_empty()) {
            (false, _) => Ok(Self::Power),
            (true, false) => Ok(Self::Displacement),
            (true, true) => Err(Failure::Input(
                "the harvester has neither a stop nor a circuit, so its response is linear: use `jounce frf`, or add a [stop.NAME] or a [circuit.NAME]"
                    .to_owned(),
            )),
        }
    }

    fn value(self, point: &BranchPoint) -> f64 {
        match self {
            Self::Power => point.orbit.mean_power_w,
            Self::Displacement => point.orbit.displacement_peak_m,
        }
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Power => "W",
            Self::Displacement => "m",
        }
    }

    fn axis(self) -> Axis {
        match self {
            Self::Power => Axis::log("Mean power", "W"),
            Self::Displacement => Axis::linear("Displacement amplitude", "m"),
        }
    }
}

fn branch_line(branch: &Curve, quantity: OrbitQuantity) -> BranchLine {
    BranchLine {
        label: format!("period {}", branch.period_cycles),
        parameter: branch.points.iter().map(|point| point.parameter).collect(),
        value: branch
            .points
            .iter()
            .map(|point| quantity.value(point))
            .collect(),
        stable: branch
            .points
            .iter()
            .map(|point| point.orbit.is_stable())
            .collect(),
    }
}

fn mark(bifurcation: &Bifurcation, quantity: OrbitQuantity) -> BranchMark {
    let kind = bifurcation
        .level
        .clone()
        .unwrap_or_else(|| bifurcation.kind.name().to_owned());
    BranchMark {
        kind,
        parameter: bifurcation.at.parameter,
        value: quantity.value(&bifurcation.at),
    }
}
