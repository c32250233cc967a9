//! `jounce basins SPEC --starts N --seed S`

use crate::failure::Failure;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use crate::threads::ThreadsArgument;
use clap::Args;
use jounce::picture::{Axis, Colour, Figure, Marker, Panel, Series};
use jounce::plant::Plant;
use jounce::study::{Attractor, Basins as Study, BasinsAnswer, Cloud, Parameter, Prepared};
use jounce::table::{Column, Table};

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
    /// Size of the cloud at the stop, in gaps (or steady amplitudes, where those are larger).
    #[arg(long, default_value_t = 10.0)]
    spread: f64,
    /// Relative tolerance of the marches.
    #[arg(long, default_value_t = 1e-8)]
    tolerance: f64,
    #[command(flatten)]
    threads: ThreadsArgument,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Basins {
    /// Marches the cloud and reports.
    pub fn run(&self) -> Result<(), Failure> {
        if self.starts == 0 || !(self.spread > 0.0 && self.spread.is_finite()) || !(self.tolerance > 0.0 && self.tolerance < 1e-2) {
            return Err(Failure::usage("--starts and --spread must be greater than 0, --tolerance between 0 and 0.01".to_owned()));
        }
        let file = self.spec.file()?;
        let base = Prepared::new(self.spec.checked(file.spec())?)?;
        let Some((name, drive)) = base.spec.drive.iter().next() else {
            return Err(Failure::Input("a basin needs a drive: add [drive.NAME] to the spec".to_owned()));
        };
        let value = drive.frequency_hz;
        let key = self.spec.checked(file.numeric_key(&format!("drive.{name}.frequency")))?;
        let parameter = Parameter::new(&base, &key, value);
        let cloud = Cloud { starts: self.starts, seed: self.seed, spread: self.spread };
        let study = Study { base: &base, parameter: &parameter, value, cloud, tolerance: self.tolerance };
        let bar = progress::counted(self.starts, "starts");
        let answer = self.threads.run(|| study.run(&|| bar.inc(1)))??;
        bar.finish_and_clear();
        if answer.lost.len() == self.starts {
            return Err(Failure::NotConverged(format!("every march failed; the first: {}", answer.lost[0].1)));
        }
        if let Some((index, why)) = answer.lost.first() {
            eprintln!("{} of {} marches failed; start {index}: {why}", answer.lost.len(), self.starts);
        }
        self.tell(&base, &cloud, &answer)
    }

    fn tell(&self, base: &Prepared, cloud: &Cloud, answer: &BasinsAnswer) -> Result<(), Failure> {
        if let Some(folder) = &self.output.out {
            let manifest = self.spec.manifest(&base.spec, "basins").with("seed", self.seed).with("spread", self.spread);
            output::table(folder, "attractors", &table(answer)?, &manifest)?;
            output::figure(folder, "basins", &drawn(&base.kernel.plant, cloud, answer))?;
        }
        if self.output.json {
            print(&serde_json::json!({
                "attractors": answer.attractors.iter().map(listed).collect::<Vec<_>>(),
                "expected_power_w": answer.expected_power_w,
                "expected_power_low_w": answer.expected_power_low_w,
                "expected_power_high_w": answer.expected_power_high_w,
                "starts": self.starts,
                "lost": answer.lost.len(),
                "seed": self.seed,
            }));
            return Ok(());
        }
        line("attractor      period  contacts    mean_power_w  share (95 %)");
        for a in &answer.attractors {
            let share = &a.share;
            line(format!(
                "{:<13} {:>7} {:>9}    {:.6e}  {:.3} ({:.3} to {:.3})",
                a.id, a.period_cycles, a.contacts_per_period, a.mean_power_w, share.fraction, share.low, share.high
            ));
        }
        line(format!(
            "expected power {:.6e} W ({:.3e} to {:.3e})",
            answer.expected_power_w, answer.expected_power_low_w, answer.expected_power_high_w
        ));
        Ok(())
    }
}

fn listed(a: &Attractor) -> serde_json::Value {
    serde_json::json!({
        "id": a.id,
        "period_cycles": a.period_cycles,
        "chaotic": a.chaotic,
        "mean_power_w": a.mean_power_w,
        "contacts_per_period": a.contacts_per_period,
        "lyapunov_per_s": a.lyapunov.map(|(exponent, _)| exponent),
        "lyapunov_error_per_s": a.lyapunov.map(|(_, error)| error),
        "fraction": a.share.fraction,
        "fraction_low": a.share.low,
        "fraction_high": a.share.high,
    })
}

fn table(answer: &BasinsAnswer) -> Result<Table, Failure> {
    let all = &answer.attractors;
    let number = |name: &str, unit: &str, about: &str, value: fn(&Attractor) -> f64| {
        Column::new(name, unit, about, all.iter().map(value).collect::<Vec<f64>>())
    };
    Ok(Table::new(vec![
        Column::new("id", "", "period in drive cycles and a letter by falling power", all.iter().map(|a| a.id.clone()).collect::<Vec<_>>()),
        Column::new(
            "period_cycles",
            "",
            "period in drive cycles, 0 for none",
            all.iter().map(|a| u64::from(a.period_cycles)).collect::<Vec<_>>(),
        ),
        Column::new("chaotic", "", "neighbouring motions part", all.iter().map(|a| a.chaotic).collect::<Vec<bool>>()),
        number("mean_power_w", "W", "mean power of all loads", |a| a.mean_power_w),
        number("fraction", "", "share of the starts", |a| a.share.fraction),
        number("fraction_low", "", "lower end of its 95 % interval", |a| a.share.low),
        number("fraction_high", "", "upper end of its 95 % interval", |a| a.share.high),
    ])?)
}

/// The starts by displacement and velocity towards the stop, coloured by where they end.
fn drawn(plant: &Plant, cloud: &Cloud, answer: &BasinsAnswer) -> Figure {
    let n = plant.system.modes.len();
    let mut panel = Panel::new(Axis::linear("Displacement towards the stop", "m"), Axis::linear("Velocity", "m/s")).high(380.0);
    for (k, attractor) in answer.attractors.iter().enumerate() {
        let along = |start: &[f64]| plant.system.stops.first().map_or(0.0, |stop| stop.shape.iter().zip(start).map(|(s, q)| s * q).sum());
        let (x, y) = (attractor.starts.iter())
            .map(|index| {
                let state = cloud.start(plant, *index);
                (along(&state[..n]), along(&state[n..2 * n]))
            })
            .unzip();
        panel = panel.with(Series::points(x, y, Marker::Circle).colour(Colour::nth(k)).label(&attractor.id));
    }
    Figure::new("Where starts end").with(panel)
}
