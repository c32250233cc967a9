//! `jounce basins SPEC --starts N --seed S`

mod grid;

use crate::failure::Failure;
use crate::interruption;
use crate::limit_warnings;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments, check_drive, check_tolerance};
use crate::threads::ThreadsArgument;
use clap::Args;
use jounce_core::analysis::{
    Attractor, Basins as Study, BasinsResult, Cloud, GridAxis, InitialStates, Model, Parameter,
    Recognition, SectionPoint,
};
use jounce_core::picture::{Colour, Figure, Marker, Panel, Series};
use jounce_core::plant::Plant;
use jounce_core::run::ExceededLimit;
use jounce_core::table::{Column, Table};

/// Arguments of `basins`.
#[derive(Debug, Args)]
pub struct Basins {
    #[command(flatten)]
    spec: SpecArguments,
    /// Number of starts.
    #[arg(long, default_value_t = 200)]
    starts: usize,
    /// Seed of the cloud.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Size of the cloud at the stop, in gaps (or in steady amplitudes, if larger).
    #[arg(long, default_value_t = 10.0)]
    spread: f64,
    /// Side of a plane or box of starts instead of the cloud, with its number of values; once for
    /// each side: displacement=-5mm:5mm:21x, velocity=-1m/s:1m/s:21x or voltage=-10V:10V:5x.
    #[arg(long, value_name = "SIDE=FROM:TO:Nx", allow_hyphen_values = true, conflicts_with_all = ["starts", "seed", "spread"])]
    grid: Vec<String>,
    /// Relative tolerance of the integration.
    #[arg(long, default_value_t = 1e-8)]
    tolerance: f64,
    /// Longest period of an attractor, in drive cycles.
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..))]
    longest_period: u32,
    /// Number of drive cycles after which a start without a proven attractor counts as chaos or
    /// undecided.
    #[arg(long, default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..))]
    max_cycles: u32,
    #[command(flatten)]
    threads: ThreadsArgument,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Basins {
    /// Integrates the cloud and reports.
    pub fn run(&self) -> Result<(), Failure> {
        check_tolerance(self.tolerance)?;
        if self.starts == 0 || !(self.spread > 0.0 && self.spread.is_finite()) {
            return Err(Failure::usage(format!(
                "--starts {} and --spread {}: give numbers greater than 0",
                self.starts, self.spread
            )));
        }
        let file = self.spec.file()?;
        let base = Model::new(self.spec.read(&file)?)?;
        let Some((name, drive)) = base.spec.drive.iter().next() else {
            return Err(Failure::Input(
                "a basin needs a drive: add [drive.NAME] to the spec".to_owned(),
            ));
        };
        let Some(value) = drive.frequency_hz() else {
            return Err(jounce_core::analysis::AnalysisError::Aperiodic {
                drive: name.clone(),
            }
            .into());
        };
        check_drive(&self.spec, &base.kernel.plant, "a basin")?;
        let key = self
            .spec
            .checked(file.numeric_key(&format!("drive.{name}.frequency")))?;
        let parameter = Parameter::new(&base, &key, value);
        let starts = match grid::read(&self.grid, base.spec.stop.len())? {
            Some(grid) => InitialStates::Grid(grid),
            None => InitialStates::Cloud(Cloud {
                starts: self.starts,
                seed: self.seed,
                spread: self.spread,
            }),
        };
        let of = starts.len();
        let (longest_period, max_cycles) = (self.longest_period, self.max_cycles);
        let recognition = Recognition {
            longest_period,
            max_cycles,
            ..Recognition::at(self.tolerance)
        };
        let study = Study {
            base: &base,
            parameter: &parameter,
            value,
            starts,
            recognition,
        };
        interruption::install(&base.kernel.control);
        let bar = progress::counted(of, "starts");
        let answer = self.threads.run(|| study.run(&|| bar.inc(1)))??;
        bar.finish_and_clear();
        let finished = answer.lost.len()
            + answer
                .attractors
                .iter()
                .map(|a| a.starts.len())
                .sum::<usize>();
        if finished == 0 {
            return Err(Failure::Interrupted(
                "stopped before the first start was finished".to_owned(),
            ));
        }
        if answer.lost.len() == finished {
            return Err(Failure::NotConverged(format!(
                "every run failed; the first: {}",
                answer.lost[0].1
            )));
        }
        if let Some((index, why)) = answer.lost.first() {
            eprintln!(
                "{} of {finished} runs failed; start {index}: {why}",
                answer.lost.len()
            );
        }
        self.tell(&base, &study.starts, &answer)?;
        interruption::end(&base.kernel.control, || {
            format!("{finished} of {of} starts")
        })
    }

    fn tell(
        &self,
        base: &Model,
        starts: &InitialStates,
        answer: &BasinsResult,
    ) -> Result<(), Failure> {
        let passed: Vec<&[ExceededLimit]> = answer
            .attractors
            .iter()
            .map(|a| a.exceeded.as_slice())
            .collect();
        limit_warnings::warn(&passed, "attractors", |place| {
            format!("attractor {}", answer.attractors[place].id)
        });
        if let Some(folder) = &self.output.out {
            let manifest = self
                .spec
                .manifest(&base.spec, "basins")
                .with("seed", self.seed)
                .with("spread", self.spread);
            output::table(folder, "attractors", &table(answer)?, &manifest)?;
            output::figure(
                folder,
                "basins",
                &figure(&base.kernel.plant, starts, answer),
            )?;
            output::table(
                folder,
                "starts",
                &starts_table(&base.kernel.plant, starts, answer)?,
                &manifest,
            )?;
        }
        if self.output.json {
            print(&serde_json::json!({
                "attractors": answer.attractors.iter().map(to_json).collect::<Vec<_>>(),
                "expected_power_w": answer.expected_power_w,
                "expected_power_low_w": answer.expected_power_low_w,
                "expected_power_high_w": answer.expected_power_high_w,
                "starts": starts.len(),
                "lost": answer.lost.len(),
                "seed": self.seed,
            }));
            return Ok(());
        }
        line("attractor      period  contacts    mean_power_w  share (95 %)");
        for a in &answer.attractors {
            let share = &a.share;
            let mirror = a
                .mirror_of
                .as_ref()
                .map_or_else(String::new, |id| format!("  mirror image of {id}"));
            line(format!(
                "{:<13} {:>7} {:>9}    {:.6e}  {:.3} ({:.3} to {:.3}){mirror}",
                a.id,
                a.period_cycles,
                a.contacts_per_period,
                a.mean_power_w,
                share.fraction,
                share.low,
                share.high
            ));
        }
        line(format!(
            "expected power {:.6e} W ({:.3e} to {:.3e})",
            answer.expected_power_w, answer.expected_power_low_w, answer.expected_power_high_w
        ));
        Ok(())
    }
}

fn to_json(a: &Attractor) -> serde_json::Value {
    serde_json::json!({
        "id": a.id,
        "period_cycles": a.period_cycles,
        "chaotic": a.is_chaotic(),
        "mirror_of": a.mirror_of,
        "mean_power_w": a.mean_power_w,
        "contacts_per_period": a.contacts_per_period,
        "lyapunov_per_s": a.lyapunov.map(|(exponent, _)| exponent),
        "lyapunov_error_per_s": a.lyapunov.map(|(_, error)| error),
        "fraction": a.share.fraction,
        "fraction_low": a.share.low,
        "fraction_high": a.share.high,
        "warnings": a.exceeded,
    })
}

fn table(answer: &BasinsResult) -> Result<Table, Failure> {
    let all = &answer.attractors;
    let number = |name: &str, unit: &str, about: &str, value: fn(&Attractor) -> f64| {
        Column::new(
            name,
            unit,
            about,
            all.iter().map(value).collect::<Vec<f64>>(),
        )
    };
    Ok(Table::new(vec![
        Column::new(
            "id",
            "",
            "period in drive cycles and a letter by decreasing power",
            all.iter().map(|a| a.id.clone()).collect::<Vec<_>>(),
        ),
        Column::new(
            "period_cycles",
            "",
            "period in drive cycles, 0 without a period",
            all.iter()
                .map(|a| u64::from(a.period_cycles))
                .collect::<Vec<_>>(),
        ),
        Column::new(
            "chaotic",
            "",
            "neighbouring motions diverge",
            all.iter().map(|a| a.is_chaotic()).collect::<Vec<bool>>(),
        ),
        number("mean_power_w", "W", "mean power of all loads", |a| {
            a.mean_power_w
        }),
        number("fraction", "", "share of the starts", |a| a.share.fraction),
        number(
            "fraction_low",
            "",
            "lower end of the 95 % interval of the share",
            |a| a.share.low,
        ),
        number(
            "fraction_high",
            "",
            "upper end of the 95 % interval of the share",
            |a| a.share.high,
        ),
    ])?)
}

/// Returns a table with one row for each start, in order.
fn starts_table(
    plant: &Plant,
    starts: &InitialStates,
    answer: &BasinsResult,
) -> Result<Table, Failure> {
    let all: Vec<SectionPoint> = (0..starts.len())
        .map(|index| SectionPoint::of(&plant.system, &starts.start(plant, index)))
        .collect();
    let is_lost = |index: usize| answer.lost.iter().any(|(lost, _)| *lost == index);
    let home = |index: usize| match answer.attractors.iter().find(|a| a.starts.contains(&index)) {
        Some(attractor) => attractor.id.clone(),
        None if is_lost(index) => "lost".to_owned(),
        None => "not computed".to_owned(),
    };
    let number = |name: &str, unit: &str, about: &str, value: fn(&SectionPoint) -> f64| {
        Column::new(
            name,
            unit,
            about,
            all.iter().map(value).collect::<Vec<f64>>(),
        )
    };
    Ok(Table::new(vec![
        Column::new(
            "start",
            "",
            "number of the start, from 0",
            (0..all.len() as u64).collect::<Vec<_>>(),
        ),
        number(
            "displacement_m",
            "m",
            "displacement towards the stop",
            |point| point.displacement_m,
        ),
        number(
            "velocity_m_per_s",
            "m/s",
            "velocity towards the stop",
            |point| point.velocity_m_per_s,
        ),
        number("voltage_v", "V", "voltage of the first patch", |point| {
            point.voltage_v
        }),
        Column::new(
            "attractor",
            "",
            "id of the attractor",
            (0..all.len()).map(home).collect::<Vec<_>>(),
        ),
    ])?)
}

/// Draws the starts by displacement and velocity towards the stop, or by the sides of their grid,
/// coloured by attractor.
fn figure(plant: &Plant, starts: &InitialStates, answer: &BasinsResult) -> Figure {
    let sides: Vec<GridAxis> = match starts {
        InitialStates::Grid(grid) => grid.sides.iter().map(|side| side.axis).collect(),
        InitialStates::Cloud(_) => Vec::new(),
    };
    let plane = match sides[..] {
        [first, second, ..] => [first, second],
        [GridAxis::Voltage] => [GridAxis::Voltage, GridAxis::Velocity],
        _ => [GridAxis::Displacement, GridAxis::Velocity],
    };
    let [x, y] = plane.map(grid::axis);
    let marker = if sides.is_empty() {
        Marker::Circle
    } else {
        Marker::Square
    };
    let mut panel = Panel::new(x, y).high(380.0);
    for (k, attractor) in answer.attractors.iter().enumerate() {
        let at = |index: &usize| {
            let point = SectionPoint::of(&plant.system, &starts.start(plant, *index));
            let [x, y] = plane.map(|axis| grid::value(axis, &point));
            (x, y)
        };
        let (x, y) = attractor.starts.iter().map(at).unzip();
        panel = panel.with(
            Series::points(x, y, marker)
                .colour(Colour::nth(k))
                .label(&attractor.id),
        );
    }
    Figure::new("Basins of attraction").with(panel)
}
