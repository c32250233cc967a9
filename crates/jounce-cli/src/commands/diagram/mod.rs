//! `jounce diagram SPEC --over KEY=RANGE`

mod figure;
mod report;

use crate::cache;
use crate::failure::Failure;
use crate::interruption;
use crate::output;
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use crate::threads::ThreadsArgument;
use clap::{Args, ValueEnum};
use jounce_core::analysis::DiagramPoint;
use jounce_core::analysis::{
    AttractorKind, AttractorTracks, Branch, BranchSearch, Cloud, Diagram as Study, DiagramOrder,
    Journal, Model, OrbitMethodKind, Parameter,
};
use jounce_core::spec::{KeyRange, Spec};

/// Default number of starts of the cloud at each value.
const DEFAULT_STARTS: usize = 20;

/// Default seed of the cloud.
const DEFAULT_SEED: u64 = 1;

/// Default size of the cloud.
const DEFAULT_SPREAD: f64 = 10.0;

/// Order of the values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Direction {
    /// From the first value to the last, each starting from the state of the one before.
    Up,
    /// From the last value to the first, each starting from the state of the one before.
    Down,
    /// Up, then down from the last state.
    Both,
    /// At each value from every start of a cloud; attractors are matched between values.
    Starts,
}

/// Arguments of `diagram`.
#[derive(Debug, Args)]
pub struct Diagram {
    #[command(flatten)]
    spec: SpecArguments,
    /// The key and its values: KEY=FROM:TO:STEP, KEY=FROM:TO:Nx, KEY=FROM:TO:Nlog or KEY=A,B,C.
    #[arg(long, value_name = "KEY=RANGE")]
    over: String,
    /// Order of the values.
    #[arg(long, value_enum, default_value = "both")]
    direction: Direction,
    /// Number of starts at each value, with --direction starts; 20 if left out.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    starts: Option<u32>,
    /// Seed of their cloud; 1 if left out.
    #[arg(long)]
    seed: Option<u64>,
    /// Size of the cloud at the stop, in gaps (or in steady amplitudes, if larger); 10 if left out.
    #[arg(long)]
    spread: Option<f64>,
    /// Number of drive cycles shown of a motion without a period.
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    cycles: u32,
    /// Relative tolerance of the integration.
    #[arg(long, default_value_t = 1e-8)]
    tolerance: f64,
    /// Leaves out the continued branches.
    #[arg(long)]
    no_branches: bool,
    /// Longest period of a continued branch, in drive cycles.
    #[arg(long, default_value_t = 4, conflicts_with = "no_branches", value_parser = clap::value_parser!(u32).range(1..))]
    longest_period: u32,
    #[command(flatten)]
    threads: ThreadsArgument,
    #[command(flatten)]
    pub output: OutputArguments,
}

/// Result of a diagram.
struct DiagramResult {
    points: Vec<DiagramPoint>,
    history: Option<AttractorTracks>,
    branches: Vec<Branch>,
}

impl Diagram {
    /// Computes the diagram and reports.
    pub fn run(&self) -> Result<(), Failure> {
        jounce::check_tolerance(self.tolerance)?;
        let order = self.order()?;
        let file = self.spec.file()?;
        let spec = self.spec.read(&file)?;
        let range = self.spec.map_faults(file.range(&self.over))?;
        let values = range.values();
        if values.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(Failure::usage(format!(
                "{}: the values of a diagram must increase",
                self.over
            )));
        }
        let (low, high) = (values[0], values[values.len() - 1]);
        let base = Model::new(spec.clone())?;
        jounce::check_drives(&base.kernel.plant, "a diagram")?;
        let width = if high > low {
            high - low
        } else {
            high.abs().max(1e-12)
        };
        let parameter = Parameter::new(&base, range.key(), width);
        let study = Study {
            base: &base,
            parameter: &parameter,
            values,
            order,
            cycles: self.cycles,
            tolerance: self.tolerance,
        };
        let points = self.integrate(&study, &spec)?;
        let history = match order {
            DiagramOrder::Starts(_) => {
                Some(progress::with_progress(&base.kernel.control, || {
                    self.threads.run(|| study.history(&points))
                })??)
            }
            DiagramOrder::Up | DiagramOrder::Down | DiagramOrder::Both => None,
        };
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range: (low, high),
            method: OrbitMethodKind::Shooting,
            tolerance: self.tolerance,
            seeds: 4,
            longest_period: self.longest_period,
        };
        let with_branches = !self.no_branches && high > low;
        let branches = if with_branches {
            progress::with_progress(&base.kernel.control, || self.threads.run(|| search.run()))??
        } else {
            Vec::new()
        };
        self.print_result(
            &spec,
            (&base, &parameter, &range),
            &DiagramResult {
                points,
                history,
                branches,
            },
        )?;
        interruption::end(&base.kernel.control, || {
            "all runs, and the attractor histories and branches that were finished".to_owned()
        })
    }

    fn order(&self) -> Result<DiagramOrder, Failure> {
        if let Some(spread) = self
            .spread
            .filter(|spread| !(*spread > 0.0 && spread.is_finite()))
        {
            return Err(Failure::usage(format!(
                "--spread {spread}: give a number greater than 0"
            )));
        }
        let cloud_options = [
            ("--starts", self.starts.is_some()),
            ("--seed", self.seed.is_some()),
            ("--spread", self.spread.is_some()),
        ];
        if let Some((option, _)) = cloud_options
            .into_iter()
            .find(|(_, is_given)| *is_given && self.direction != Direction::Starts)
        {
            return Err(Failure::usage(format!(
                "{option} needs a cloud of starts: add --direction starts or leave {option} out"
            )));
        }
        Ok(match self.direction {
            Direction::Up => DiagramOrder::Up,
            Direction::Down => DiagramOrder::Down,
            Direction::Both => DiagramOrder::Both,
            Direction::Starts => DiagramOrder::Starts(Cloud {
                starts: self.starts.map_or(DEFAULT_STARTS, |starts| starts as usize),
                seed: self.seed.unwrap_or(DEFAULT_SEED),
                spread: self.spread.unwrap_or(DEFAULT_SPREAD),
            }),
        })
    }

    /// Computes the runs, and continues an interrupted call of the same command.
    fn integrate(&self, study: &Study, spec: &Spec) -> Result<Vec<DiagramPoint>, Failure> {
        let options = format!(
            "diagram {} {:?} {} {}",
            self.over, study.order, self.cycles, self.tolerance
        );
        let journal = Journal::<DiagramPoint>::open(
            &cache::folder(),
            &cache::key(&spec.hash_hex(), &options),
        )?;
        let bar = progress::counting_bar(study.len(), "runs");
        bar.set_position(journal.found().len() as u64);
        if !journal.found().is_empty() {
            eprintln!("continuing after {} finished runs", journal.found().len());
        }
        interruption::install(&study.base.kernel.control);
        let points = self
            .threads
            .run(|| study.run(Some(&journal), &|_| bar.inc(1)))??;
        bar.finish_and_clear();
        if points.len() < study.len() {
            let text = format!(
                "stopped after {} of {} runs; the same command continues from there",
                points.len(),
                study.len()
            );
            return Err(Failure::Interrupted(text));
        }
        journal.finish()?;
        let lost = points
            .iter()
            .filter(|point| point.motion == AttractorKind::Lost)
            .count();
        if lost == points.len() {
            return Err(Failure::NotConverged(
                "every run failed; try a larger --tolerance or another range".to_owned(),
            ));
        }
        if lost > 0 {
            eprintln!(
                "{lost} of {} runs failed; their motion is `lost`",
                points.len()
            );
        }
        Ok(points)
    }

    fn print_result(
        &self,
        spec: &Spec,
        (base, parameter, range): (&Model, &Parameter, &KeyRange),
        result: &DiagramResult,
    ) -> Result<(), Failure> {
        if let Some(folder) = &self.output.out {
            let manifest = self
                .spec
                .manifest(spec, "diagram")
                .with("over", &self.over)
                .with("seed", self.seed.unwrap_or(DEFAULT_SEED));
            output::table(
                folder,
                "diagram",
                &report::points(range.key(), result)?,
                &manifest,
            )?;
            if let Some(history) = &result.history {
                output::table(
                    folder,
                    "attractors",
                    &report::attractors(range.key(), history)?,
                    &manifest,
                )?;
            }
            output::figure(
                folder,
                "diagram",
                &figure::figure((base, parameter), range.key(), result)?,
            )?;
        }
        if self.output.json {
            report::json(range.key(), result);
        } else {
            report::text(range.key(), result);
        }
        Ok(())
    }
}
