//! Marches at every value of a key: stepped up or down with the state carried over, or from a cloud of starts.

use super::visit::{Place, Visit};
use crate::orbit::Harvester;
use crate::study::{AttractorKind, Cloud, Journal, Parameter, Prepared, StudyError, Way};
use rayon::prelude::*;

/// Order of visit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Order {
    /// From the first value to the last, from rest.
    Up,
    /// From the last value to the first, from rest.
    Down,
    /// Up, then down from where it arrived.
    Both,
    /// At each value from every start of a cloud, in parallel.
    Starts(Cloud),
}

/// A diagram to be made.
#[derive(Debug)]
pub struct Diagram<'s> {
    /// The spec at its own values.
    pub base: &'s Prepared,
    /// The harvesters.
    pub parameter: &'s Parameter<'s>,
    /// Values of the key.
    pub values: &'s [f64],
    /// Order of visit.
    pub order: Order,
    /// Points kept of a motion without a period.
    pub cycles: u32,
    /// Relative tolerance of the marches.
    pub tolerance: f64,
}

impl Diagram<'_> {
    /// Number of marches.
    pub fn len(&self) -> usize {
        self.places().len()
    }

    /// True without a march.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Makes the diagram. `done` hears of each finished march; the watch of its harvester ends it early, with what is finished given back
    /// and kept in the journal. Visits come back in order.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn run(&self, journal: Option<&Journal<Visit>>, done: &(dyn Fn(&Visit) + Sync)) -> Result<Vec<Visit>, StudyError> {
        let found = journal.map(Journal::found).unwrap_or_default();
        let watch = &self.base.kernel.watch;
        watch.expect(self.len() - found.len());
        let finish = |visit: Visit| {
            if let Some(journal) = journal {
                journal.keep(&visit)?;
            }
            watch.count();
            done(&visit);
            Ok(visit)
        };
        let mut visits = match self.order {
            Order::Starts(cloud) => self.scattered(cloud, found, &finish)?,
            Order::Up | Order::Down | Order::Both => self.stepped(found, &finish)?,
        };
        visits.sort_by_key(|visit| visit.index);
        Ok(visits)
    }

    /// A march that is finished; `None` where it was stopped on its way.
    fn finished(&self, place: Place, start: &[f64]) -> Result<Option<Visit>, StudyError> {
        let stopped = || self.base.kernel.watch.is_stopped();
        if stopped() {
            return Ok(None);
        }
        let visit = self.visit(place, start)?;
        Ok((!stopped()).then_some(visit))
    }

    /// A march at a value from a physical start.
    pub(super) fn visit(&self, place: Place, start: &[f64]) -> Result<Visit, StudyError> {
        Visit::march((self.base, self.parameter), place, start, (self.cycles, self.tolerance))
    }

    fn places(&self) -> Vec<Place> {
        let way = |direction: Way| move |parameter: &f64| (*parameter, direction, 0);
        let (up, down) = (self.values.iter().map(way(Way::Up)), self.values.iter().rev().map(way(Way::Down)));
        let all: Vec<(f64, Way, usize)> = match self.order {
            Order::Up => up.collect(),
            Order::Down => down.collect(),
            Order::Both => up.chain(down).collect(),
            Order::Starts(cloud) => {
                let starts = |value: &f64| (0..cloud.starts).map(move |start| (*value, Way::Independent, start)).collect::<Vec<_>>();
                self.values.iter().flat_map(starts).collect()
            }
        };
        let place = |(index, (parameter, direction, start))| Place { index, parameter, direction, start };
        all.into_iter().enumerate().map(place).collect()
    }

    fn scattered(
        &self,
        cloud: Cloud,
        found: &[Visit],
        finish: &(dyn Fn(Visit) -> Result<Visit, StudyError> + Sync),
    ) -> Result<Vec<Visit>, StudyError> {
        (self.places().into_par_iter())
            .map(|place| {
                if let Some(visit) = found.iter().find(|visit| visit.index == place.index) {
                    return Ok(Some(visit.clone()));
                }
                // Before the harvester is made: of the places that are left when the work is stopped, none takes time.
                if self.base.kernel.watch.is_stopped() {
                    return Ok(None);
                }
                let kernel = self.parameter.at(place.parameter)?.kernel;
                self.finished(place, &cloud.start(&kernel.plant, place.start))?.map(finish).transpose()
            })
            .filter_map(Result::transpose)
            .collect()
    }

    fn stepped(&self, found: &[Visit], finish: &(dyn Fn(Visit) -> Result<Visit, StudyError> + Sync)) -> Result<Vec<Visit>, StudyError> {
        let rest = vec![0.0; self.base.kernel.plant.len()];
        let mut visits = found.to_vec();
        for place in self.places().into_iter().skip(found.len()) {
            let start = visits.last().filter(|last| last.motion != AttractorKind::Lost).map_or(&rest, |last| &last.end).clone();
            let Some(visit) = self.finished(place, &start)? else { break };
            visits.push(finish(visit)?);
        }
        Ok(visits)
    }
}
