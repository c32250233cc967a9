//! `jounce diagram SPEC --over KEY=RANGE`

use crate::cache;
use crate::failure::Failure;
use crate::interruption;
use crate::option_names::on_command_line;
use crate::output::{self, line};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::{AttractorTrack, DiagramPoint, Transition};
use jounce::{Control, DiagramOptions, DiagramResult, Harvester};
use std::path::Path;

/// What the values of an attractor mean.
const FOUND_AMONG_STARTS: &str = "first found, missing: the first value of the key at which runs, from the starts or from the value before, reach the attractor, or no longer do; `jounce branch` locates the bifurcations";

/// Arguments of `diagram`.
#[derive(Debug, Args)]
pub struct Diagram {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: DiagramOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Diagram {
    /// Computes the diagram and reports; continues an interrupted call of the same command.
    pub fn run(&self) -> Result<(), Failure> {
        self.spec.refuse_set(&self.options.over)?;
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        let failure = |error| self.spec.failure(error);
        let journal = harvester.diagram_journal(&self.options, cache::folder());
        let journal = journal.map_err(failure)?;
        if !journal.found().is_empty() {
            output::note(format!(
                "continuing after {} finished runs",
                journal.found().len()
            ));
        }
        interruption::install(&control);
        let work = || harvester.diagram_with_journal(&self.options, &journal);
        let result = progress::with_parts("runs", &control, work).map_err(failure)?;
        let (finished, expected) = (result.points.len(), result.expected);
        if finished < expected {
            return Err(Failure::Interrupted(format!(
                "stopped after {finished} of {expected} runs; the same command continues from there"
            )));
        }
        let warnings = result.warnings();
        if result.points.iter().all(DiagramPoint::is_lost) {
            cache::finish(journal)?;
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
            "all runs, and the attractor histories and branches that were finished".to_owned()
        })?;
        cache::finish(journal)
    }

    fn write(
        &self,
        folder: &Path,
        harvester: &Harvester,
        result: &DiagramResult,
    ) -> Result<(), Failure> {
        let manifest = self.spec.manifest(harvester, "diagram", &self.options)?;
        output::table(folder, "diagram", &result.table()?, &manifest)?;
        if let Some(attractors) = result.attractors_table()? {
            output::table(folder, "attractors", &attractors, &manifest)?;
        }
        output::figure(folder, "diagram", &result.figure())
    }
}

/// Prints the result as lines of text: attractors where known, else runs.
fn print_lines(result: &DiagramResult) {
    if let Some(attractors) = &result.attractors {
        for attractor in attractors {
            print_attractor(&result.unit, attractor);
        }
        line(FOUND_AMONG_STARTS);
        return;
    }
    let heading = output::key_heading(&result.key, &result.unit);
    let width = heading.len();
    line(format!(
        "{heading}  direction    motion     period  contacts    mean_power_w"
    ));
    for point in &result.points {
        line(format!(
            "{:>width$}  {:<11}  {:<9}  {:>6}  {:>8}    {}",
            output::key_value(point.parameter),
            point.direction.name(),
            point.motion.name(),
            point.period_cycles,
            point.contacts_per_period,
            output::power(point.mean_power_w)
        ));
    }
}

/// Prints one attractor: its range, its origin and its end.
fn print_attractor(unit: &str, attractor: &AttractorTrack) {
    let (Some(first), Some(last)) = (attractor.seen.first(), attractor.seen.last()) else {
        return;
    };
    let transition = |transition: &Option<Transition>, verb: &str, where_it_ends: &str| {
        transition.as_ref().map_or_else(String::new, |transition| {
            let other = transition.other.as_ref();
            let other =
                other.map_or_else(String::new, |other| format!(" ({where_it_ends} {other})"));
            format!(", {verb} at {} {unit}{other}", transition.parameter)
        })
    };
    line(format!(
        "{:<12} {:<9} from {} to {} {unit}, {:.3e} to {:.3e} W{}{}",
        attractor.id,
        attractor.motion.name(),
        first.parameter,
        last.parameter,
        first.mean_power_w,
        last.mean_power_w,
        transition(&attractor.born, "first found", "one value back it ends on"),
        transition(&attractor.died, "missing", "it ends on")
    ));
}
