//! Basins of attraction: the attractors of many starts, and how likely each is.

mod options;
mod report;
mod result;

pub use options::BasinsOptions;
pub(crate) use options::cloud;
pub use result::{AttractorResult, BasinsResult, FailedStart, StartPoint};

use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::on_threads;
use crate::periodic;
use jounce_analysis::run::WorstExcess;
use jounce_analysis::{AttractorKind, Basins, InitialStates, MIN_TRANSIENT_CYCLES, SectionPoint};
use jounce_model::plant::Plant;

impl Harvester {
    /// Finds the attractors that a cloud or a grid of starts reaches, the share of the starts that
    /// reach each, and the expected power. A start belongs to the orbit that its motion is proven
    /// to reach. After a stop by the control the finished starts are counted.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Grid`], [`Error::NoDrive`], [`Error::DriveAtRest`], and
    /// [`Error::Stopped`] where no start was finished.
    ///
    /// ```no_run
    /// use jounce::{BasinsOptions, Harvester};
    /// let harvester = Harvester::read("harvester.toml")?;
    /// let result = harvester.basins(&BasinsOptions { starts: 400, ..Default::default() })?;
    /// println!("{} attractors, {} W expected", result.attractors.len(), result.expected_power_w);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn basins(&self, options: &BasinsOptions) -> Result<BasinsResult, Error> {
        let recognition = options.recognition()?;
        let starts = options.initial_states(self.spec().stop.len())?;
        periodic::frequency(self, "a basin")?;
        let base = self.model()?;
        periodic::check_drives(&base.kernel.plant, "a basin")?;
        let study = Basins {
            base: &base,
            starts,
            recognition,
        };
        // Before the integration, so that a stopped call has nothing left to compute.
        let points = points(&base.kernel.plant, &study.starts);
        let found = on_threads(options.threads, || Ok(study.run()?))?;
        let result = BasinsResult {
            gap_m: fixed_gap_m(&base.kernel.plant),
            ..BasinsResult::new(&found, &study.starts, points, options.seed)
        };
        if result.finished == 0 {
            Err(Error::Stopped)
        } else {
            Ok(result)
        }
    }
}

/// Returns the gap of the first stop, unless the motions of two bases change it.
fn fixed_gap_m(plant: &Plant) -> Option<f64> {
    let stop = plant.system.stops.first()?;
    stop.bases.is_empty().then_some(stop.gap_m)
}

/// Returns the place of each start.
fn points(plant: &Plant, starts: &InitialStates) -> Vec<SectionPoint> {
    let point = |index| SectionPoint::of(&plant.system, &starts.start(plant, index));
    (0..starts.len()).map(point).collect()
}

impl BasinsResult {
    fn new(
        found: &jounce_analysis::BasinsResult,
        starts: &InitialStates,
        points: Vec<SectionPoint>,
        seed: u64,
    ) -> Self {
        let mut attractor = vec![None; points.len()];
        for (number, own) in found.attractors.iter().enumerate() {
            own.starts
                .iter()
                .for_each(|start| attractor[*start] = Some(number));
        }
        let point = |(point, attractor): (SectionPoint, Option<usize>)| StartPoint {
            displacement_m: point.displacement_m,
            velocity_m_s: point.velocity_m_s,
            voltage_v: point.voltage_v,
            attractor,
        };
        let failed = |(start, reason): &(usize, String)| FailedStart {
            start: *start,
            reason: reason.clone(),
        };
        Self {
            attractors: found.attractors.iter().map(AttractorResult::of).collect(),
            expected_power_w: found.expected_power_w,
            expected_power_low_w: found.expected_power_low_w,
            expected_power_high_w: found.expected_power_high_w,
            starts: points.len(),
            finished: found.lost.len() + attractor.iter().flatten().count(),
            failed: found.lost.iter().map(failed).collect(),
            chaotic_transients: found.chaotic_transients.len(),
            seed,
            gap_m: None,
            points: points.into_iter().zip(attractor).map(point).collect(),
            sides: match starts {
                InitialStates::Grid(grid) => grid.sides.iter().map(|side| side.axis).collect(),
                InitialStates::Cloud(_) => Vec::new(),
            },
        }
    }

    /// Returns the messages about undecided starts, about starts with chaotic transients, and about
    /// exceeded limits of patches on attractors.
    pub fn warnings(&self) -> Vec<String> {
        let is_undecided = |own: &&AttractorResult| own.id == AttractorKind::Undecided.name();
        let undecided = self.attractors.iter().position(|own| is_undecided(&own));
        let starts = |number| {
            self.points
                .iter()
                .filter(move |own| own.attractor == Some(number))
        };
        let undecided = undecided.map_or(0, |number| starts(number).count());
        let found = self.attractors.iter().filter(|own| !is_undecided(own));
        let found: Vec<&AttractorResult> = found.collect();
        let exceeded: Vec<_> = found.iter().map(|own| own.warnings.as_slice()).collect();
        let place = |number: usize| format!("attractor {}", found[number].id);
        let mut messages = WorstExcess::messages(&exceeded, "attractors", place);
        if self.chaotic_transients > 0 {
            messages.insert(0, format!(
                "{} of {} starts reach their orbit after a chaotic transient of {MIN_TRANSIENT_CYCLES} drive cycles or more: roundoff decides which orbit each of them reaches; their shares are not affected",
                self.chaotic_transients, self.finished
            ));
        }
        if undecided > 0 {
            messages.insert(0, format!(
                "{undecided} of {} starts are undecided, so that the expected power contains transients; give a larger `max_cycles`",
                self.finished
            ));
        }
        messages
    }
}
