//! `jounce jumps SPEC --over KEY=FROM:TO --against KEY2=FROM:TO`

use crate::failure::Failure;
use crate::interruption;
use crate::level_arguments::LevelArguments;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use crate::threads::ThreadsArgument;
use clap::Args;
use jounce_core::analysis::{
    BifurcationCurve, BifurcationCurvePoint, BifurcationSearch, BranchOptions, Model,
};
use jounce_core::picture::{self, Axis, BifurcationLine};
use jounce_core::spec::{NumericKey, Spec};
use jounce_core::table::{Column, Table};

/// Arguments of `jumps`.
#[derive(Debug, Args)]
pub struct Jumps {
    #[command(flatten)]
    spec: SpecArguments,
    /// First key and its range, along which bifurcations are found:
    /// drive.shaker.frequency=4Hz:20Hz.
    #[arg(long, value_name = "KEY=FROM:TO")]
    over: String,
    /// Second key and its range, in which they are continued: stop.tip.gap=0.5mm:2mm.
    #[arg(long, value_name = "KEY=FROM:TO")]
    against: String,
    /// Relative tolerance of the integration that computes the orbits.
    #[arg(long, default_value_t = 1e-9)]
    tolerance: f64,
    /// Number of values inside a range at which orbits are sought by integration; they find
    /// isolated branches.
    #[arg(long, default_value_t = 4)]
    seeds: usize,
    /// Longest period of a branch, in drive cycles; longer ones are left out.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..))]
    longest_period: u32,
    /// Leaves out the curves of maximum mean power along the first key.
    #[arg(long)]
    no_peaks: bool,
    #[command(flatten)]
    levels: LevelArguments,
    #[command(flatten)]
    threads: ThreadsArgument,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Jumps {
    /// Continues the bifurcation curves and reports.
    pub fn run(&self) -> Result<(), Failure> {
        jounce::check_tolerance(self.tolerance)?;
        let file = self.spec.file()?;
        let base = Model::new(self.spec.read(&file)?)?;
        let (key, range) = self.spec.key_and_ends(&file, &self.over)?;
        let (key_2, range_2) = self.spec.key_and_ends(&file, &self.against)?;
        if key.path() == key_2.path() {
            return Err(Failure::usage(format!(
                "--over and --against are both {}: give two different keys",
                key.path()
            )));
        }
        let search = BifurcationSearch {
            base: &base,
            keys: [&key, &key_2],
            ranges: [range, range_2],
            tolerance: self.tolerance,
            seeds: self.seeds,
            longest_period: self.longest_period,
            peaks: !self.no_peaks,
        };
        let options = BranchOptions {
            levels: self.levels.read(&base.kernel.plant)?,
            ..BranchOptions::default()
        };
        interruption::install(&base.kernel.control);
        let curves = progress::with_progress(&base.kernel.control, || {
            self.threads.run(|| search.run_with(&options))
        })??;
        for (curve, reason) in curves
            .iter()
            .flat_map(|curve| curve.failures.iter().map(move |reason| (curve, reason)))
        {
            eprintln!(
                "a curve of kind {} ends early in {}: {reason}",
                name(curve),
                key_2.path()
            );
        }
        self.print_result(&base.spec, [&key, &key_2], &curves)?;
        interruption::end(&base.kernel.control, || {
            format!("the {} finished curves", curves.len())
        })?;
        if curves.is_empty() || curves.iter().any(|curve| curve.failures.is_empty()) {
            return Ok(());
        }
        Err(Failure::Incomplete(
            "no curve is complete: continuation stopped early on each".to_owned(),
        ))
    }

    fn print_result(
        &self,
        spec: &Spec,
        keys: [&NumericKey; 2],
        curves: &[BifurcationCurve],
    ) -> Result<(), Failure> {
        if let Some(folder) = &self.output.out {
            let manifest = self
                .spec
                .manifest(spec, "jumps")
                .with("over", &self.over)
                .with("against", &self.against);
            output::table(folder, "jumps", &table(keys, curves)?, &manifest)?;
            let [x, y] = keys.map(|key| Axis::linear(key.path(), &key.unit()));
            output::figure(
                folder,
                "jumps",
                &picture::bifurcations(
                    "Bifurcation curves",
                    x,
                    y,
                    &curves.iter().map(curve_line).collect::<Vec<_>>(),
                ),
            )?;
        }
        if self.output.json {
            print(&serde_json::json!({
                "over": keys[0].path(),
                "unit": keys[0].unit(),
                "against": keys[1].path(),
                "unit_2": keys[1].unit(),
                "curves": curves.iter().map(to_json).collect::<Vec<_>>(),
                "note": self.note(),
            }));
            return Ok(());
        }
        if curves.is_empty() {
            line(format!(
                "no fold, doubling, torus, grazing, level or peak over {} for {}",
                self.over, self.against
            ));
        }
        for curve in curves {
            line(format!(
                "{} of period {}: {} points",
                name(curve),
                curve.period_cycles,
                curve.points.len()
            ));
            for point in curve.points.first().into_iter().chain(curve.points.last()) {
                let (unit, unit_2) = (keys[0].unit(), keys[1].unit());
                let stable = point
                    .stable
                    .map_or("", |stable| if stable { "  stable" } else { "  unstable" });
                line(format!(
                    "  {:>12} {unit}  {:>12} {unit_2}  {:.6e} W{stable}",
                    output::key_value(point.parameter),
                    output::key_value(point.parameter_2),
                    point.mean_power_w
                ));
            }
        }
        line(self.note());
        Ok(())
    }

    /// Returns a note on curves that the search may miss, and on the options that find more.
    fn note(&self) -> String {
        format!(
            "the search misses curves that pass neither an edge of the two ranges nor the second key's value in the spec, and curves of branches that none of {} seeds converges to or of a period above {} cycles; other ranges, more --seeds and a longer --longest-period find more",
            self.seeds, self.longest_period
        )
    }
}

/// Returns the name of a curve: a level as given, else the kind.
fn name(curve: &BifurcationCurve) -> &str {
    curve.level.as_deref().unwrap_or(curve.kind.name())
}

fn to_json(curve: &BifurcationCurve) -> serde_json::Value {
    let mut curve_json = serde_json::json!({
        "kind": curve.kind,
        "period_cycles": curve.period_cycles,
        "points": curve.points,
        "failures": curve.failures,
    });
    if let Some(level) = &curve.level {
        curve_json["level"] = level.as_str().into();
    }
    curve_json
}

fn table(keys: [&NumericKey; 2], curves: &[BifurcationCurve]) -> Result<Table, Failure> {
    let rows: Vec<(u64, &BifurcationCurve, &BifurcationCurvePoint)> = curves
        .iter()
        .enumerate()
        .flat_map(|(k, curve)| {
            curve
                .points
                .iter()
                .map(move |point| (k as u64, curve, point))
        })
        .collect();
    let number = |name: &str, unit: &str, about: &str, value: fn(&BifurcationCurvePoint) -> f64| {
        Column::new(
            name,
            unit,
            about,
            rows.iter()
                .map(|(_, _, point)| value(point))
                .collect::<Vec<f64>>(),
        )
    };
    Ok(Table::new(vec![
        Column::new(
            "curve",
            "",
            "number of the curve, from 0",
            rows.iter().map(|(k, ..)| *k).collect::<Vec<u64>>(),
        ),
        Column::new(
            "kind",
            "",
            "kind of the bifurcation, or the level",
            rows.iter()
                .map(|(_, curve, _)| name(curve).to_owned())
                .collect::<Vec<_>>(),
        ),
        Column::new(
            "period_cycles",
            "",
            "period in drive cycles",
            rows.iter()
                .map(|(_, curve, _)| u64::from(curve.period_cycles))
                .collect::<Vec<_>>(),
        ),
        number("parameter", &keys[0].unit(), keys[0].path(), |p| {
            p.parameter
        }),
        number("parameter_2", &keys[1].unit(), keys[1].path(), |p| {
            p.parameter_2
        }),
        number("mean_power_w", "W", "mean power of all loads", |p| {
            p.mean_power_w
        }),
    ])?)
}

fn curve_line(curve: &BifurcationCurve) -> BifurcationLine {
    BifurcationLine {
        kind: name(curve).to_owned(),
        x: curve.points.iter().map(|point| point.parameter).collect(),
        y: curve.points.iter().map(|point| point.parameter_2).collect(),
    }
}
