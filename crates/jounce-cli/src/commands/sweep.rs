//! `jounce sweep SPEC --over KEY=RANGE`

use crate::cache;
use crate::failure::Failure;
use crate::interruption;
use crate::limit_warnings;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use crate::threads::ThreadsArgument;
use clap::{Args, ValueEnum};
use jounce_core::analysis::{Journal, Sweep as Study, SweepDirection, SweepOrder, SweepPoint};
use jounce_core::integrate::Control;
use jounce_core::picture::{self, Axis, SweepLine, SweepLook};
use jounce_core::run::ExceededLimit;
use jounce_core::spec::{KeyRange, Spec};
use jounce_core::table::{Column, Table};

/// Order of the points.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Order {
    /// From the first value to the last, each starting from the state of the one before.
    Up,
    /// From the last value to the first, each starting from the state of the one before.
    Down,
    /// Up, then down from the last state.
    Both,
    /// Each point from the start of the spec, in parallel.
    Independent,
}

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    spec: SpecArguments,
    /// The key and its values: KEY=FROM:TO:STEP, KEY=FROM:TO:Nx, KEY=FROM:TO:Nlog or KEY=A,B,C.
    #[arg(long, value_name = "KEY=RANGE")]
    over: String,
    /// Order of the points.
    #[arg(long, value_enum, default_value = "up")]
    direction: Order,
    /// Runs every point for run.duration and averages over run.average_over, instead of until
    /// steady state. This also holds for drives without a common period, which restart at each
    /// point.
    #[arg(long)]
    fixed_duration: bool,
    /// Required relative error of the response; overrides run.tolerance.
    #[arg(long)]
    tolerance: Option<f64>,
    #[command(flatten)]
    threads: ThreadsArgument,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Sweep {
    /// Sweeps and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let mut file = self.spec.file()?;
        if let Some(tolerance) = self.tolerance {
            file.set("run.tolerance", &format!("{tolerance:e}"))
                .map_err(|fault| Failure::faults(&self.spec.spec, vec![fault]))?;
        }
        let spec = self.spec.read(&file)?;
        let range = self.spec.map_faults(file.range(&self.over))?;
        let direction = match self.direction {
            Order::Up => SweepOrder::Up,
            Order::Down => SweepOrder::Down,
            Order::Both => SweepOrder::Both,
            Order::Independent => SweepOrder::Independent,
        };
        let study = Study {
            spec: &spec,
            range: &range,
            direction,
            fixed_duration: self.fixed_duration,
            folder: self.spec.folder(),
        };
        let options = format!("{} {:?} {}", self.over, self.direction, self.fixed_duration);
        let journal = Journal::open(&cache::folder(), &cache::key(&spec.hash_hex(), &options))?;
        let bar = progress::bar(study.len());
        bar.set_position(journal.found().len() as u64);
        if !journal.found().is_empty() {
            eprintln!("continuing after {} finished points", journal.found().len());
        }
        let control = Control::default();
        interruption::install(&control);
        let points = self
            .threads
            .run(|| study.run(Some(&journal), &control, &|_| bar.inc(1)))??;
        bar.finish_and_clear();
        if points.len() < study.len() {
            let text = format!(
                "stopped after {} of {} points; the same command continues from there",
                points.len(),
                study.len()
            );
            return Err(Failure::Interrupted(text));
        }
        self.print_result(&spec, &range, &points)?;
        journal.finish()?;
        Ok(())
    }

    fn print_result(
        &self,
        spec: &Spec,
        range: &KeyRange,
        points: &[SweepPoint],
    ) -> Result<(), Failure> {
        let repeats = spec
            .drive
            .values()
            .all(|drive| drive.frequency_hz().is_some());
        let unsettled = points
            .iter()
            .filter(|point| repeats && !point.settled)
            .count();
        if unsettled > 0 {
            eprintln!(
                "{unsettled} of {} points had not settled when averaged; they are marked settled = false",
                points.len()
            );
        }
        let exceeded: Vec<&[ExceededLimit]> = points
            .iter()
            .map(|point| point.exceeded.as_slice())
            .collect();
        let key = range.key();
        limit_warnings::warn(&exceeded, "points", |index| {
            format!(
                "{} = {:.6} {}",
                key.path(),
                points[index].parameter,
                key.unit()
            )
        });
        if let Some(folder) = &self.output.out {
            self.write(folder, spec, range, points)?;
        }
        if self.output.json {
            let point_list: Vec<_> = points.iter().map(to_json).collect();
            print(
                &serde_json::json!({ "over": range.key().path(), "unit": range.key().unit(), "points": point_list }),
            );
            return Ok(());
        }
        line(format!(
            "{:>14}  direction    mean_power_w   voltage_rms_v  settled",
            format!("parameter [{}]", range.key().unit())
        ));
        for p in points {
            line(format!(
                "{:>14.6}  {:<11}  {:.6e}  {:>13.6}  {}",
                p.parameter,
                p.direction.name(),
                p.mean_power_w,
                p.voltage_rms_v,
                p.settled
            ));
        }
        Ok(())
    }

    fn write(
        &self,
        folder: &std::path::Path,
        spec: &Spec,
        range: &KeyRange,
        points: &[SweepPoint],
    ) -> Result<(), Failure> {
        let unit = range.key().unit();
        let column = |name: &str, unit: &str, about: &str, value: fn(&SweepPoint) -> f64| {
            Column::new(
                name,
                unit,
                about,
                points.iter().map(value).collect::<Vec<f64>>(),
            )
        };
        let table = Table::new(vec![
            column("parameter", &unit, range.key().path(), |p| p.parameter),
            Column::new(
                "direction",
                "",
                "direction of the sweep",
                points
                    .iter()
                    .map(|p| p.direction.name().to_owned())
                    .collect::<Vec<_>>(),
            ),
            column("mean_power_w", "W", "mean power of all loads", |p| {
                p.mean_power_w
            }),
            column(
                "voltage_rms_v",
                "V",
                "rms voltage of the first load, else of the output of the first rectifier",
                |p| p.voltage_rms_v,
            ),
            column(
                "max_penetration_m",
                "m",
                "largest penetration of the stop",
                |p| p.max_penetration_m,
            ),
            column("contact_rate_hz", "1/s", "contacts per second", |p| {
                p.contact_rate_hz
            }),
            Column::new(
                "settled",
                "",
                "settled when averaged",
                points.iter().map(|p| p.settled).collect::<Vec<_>>(),
            ),
            Column::new(
                "period_cycles",
                "",
                "period in drive cycles",
                points
                    .iter()
                    .map(|p| u64::from(p.period_cycles))
                    .collect::<Vec<_>>(),
            ),
            column(
                "energy_residual_relative",
                "",
                "energy residual of the run",
                |p| p.energy_residual_relative,
            ),
        ])?;
        output::table(
            folder,
            "sweep",
            &table,
            &self.spec.manifest(spec, "sweep").with("over", &self.over),
        )?;
        let lines: Vec<SweepLine> = [
            SweepDirection::Up,
            SweepDirection::Down,
            SweepDirection::Independent,
        ]
        .into_iter()
        .filter_map(|direction| sweep_line(points, direction))
        .collect();
        let style = SweepLook {
            parameter: Axis::linear(range.key().path(), &unit),
            value: Axis::log("Mean power", "W"),
        };
        output::figure(
            folder,
            "sweep",
            &picture::sweep(
                &format!("Mean power over {}", range.key().path()),
                &style,
                &lines,
            ),
        )
    }
}

fn to_json(point: &SweepPoint) -> serde_json::Value {
    serde_json::json!({
        "parameter": point.parameter,
        "direction": point.direction.name(),
        "mean_power_w": point.mean_power_w,
        "voltage_rms_v": point.voltage_rms_v,
        "max_penetration_m": point.max_penetration_m,
        "contact_rate_hz": point.contact_rate_hz,
        "settled": point.settled,
        "period_cycles": point.period_cycles,
        "energy_residual_relative": point.energy_residual_relative,
        "simulated_time_s": point.simulated_time_s,
        "warnings": point.exceeded,
    })
}

fn sweep_line(points: &[SweepPoint], direction: SweepDirection) -> Option<SweepLine> {
    let mut selected: Vec<&SweepPoint> = points
        .iter()
        .filter(|point| point.direction == direction)
        .collect();
    selected.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
    let direction = match direction {
        SweepDirection::Up => picture::LineDirection::Up,
        SweepDirection::Down => picture::LineDirection::Down,
        SweepDirection::Independent => picture::LineDirection::Independent,
    };
    (!selected.is_empty()).then(|| SweepLine {
        label: "mean power".into(),
        direction,
        parameter: selected.iter().map(|p| p.parameter).collect(),
        value: selected.iter().map(|p| p.mean_power_w).collect(),
        settled: selected.iter().map(|p| p.settled).collect(),
    })
}
