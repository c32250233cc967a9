//! Marches at every value of a key: stepped up or down with the state carried over, or from a cloud of starts.

use super::diagram_point::{DiagramPoint, SectionState};
use crate::analysis::{
    AnalysisError, AttractorKind, Cloud, Journal, Model, Parameter, SweepDirection,
};
use crate::orbit::ParametricModel;
use rayon::prelude::*;

/// Order of visit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DiagramOrder {
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
    pub base: &'s Model,
    /// The harvesters.
    pub parameter: &'s Parameter<'s>,
    /// Values of the key.
    pub values: &'s [f64],
    /// Order of visit.
    pub order: DiagramOrder,
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

    /// Makes the diagram. `done` hears of each finished march; the control of its harvester ends it early, with what is finished given back
    /// and kept in the journal. Visits come back in order.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn run(
        &self,
        journal: Option<&Journal<DiagramPoint>>,
        done: &(dyn Fn(&DiagramPoint) + Sync),
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        let found = journal.map(Journal::found).unwrap_or_default();
        let control = &self.base.kernel.control;
        control.expect(self.len() - found.len());
        let finish = |visit: DiagramPoint| {
            if let Some(journal) = journal {
                journal.keep(&visit)?;
            }
            control.count();
            done(&visit);
            Ok(visit)
        };
        let mut visits = match self.order {
            DiagramOrder::Starts(cloud) => self.scattered(cloud, found, &finish)?,
            DiagramOrder::Up | DiagramOrder::Down | DiagramOrder::Both => {
                self.stepped(found, &finish)?
            }
        };
        visits.sort_by_key(|visit| visit.index);
        Ok(visits)
    }

    /// A march that is finished; `None` where it was stopped on its way.
    fn finished(
        &self,
        place: SectionState,
        start: &[f64],
    ) -> Result<Option<DiagramPoint>, AnalysisError> {
        let stopped = || self.base.kernel.control.is_stopped();
        if stopped() {
            return Ok(None);
        }
        let visit = self.visit(place, start)?;
        Ok((!stopped()).then_some(visit))
    }

    /// A march at a value from a physical start.
    pub(super) fn visit(
        &self,
        place: SectionState,
        start: &[f64],
    ) -> Result<DiagramPoint, AnalysisError> {
        DiagramPoint::march(
            (self.base, self.parameter),
            place,
            start,
            (self.cycles, self.tolerance),
        )
    }

    fn places(&self) -> Vec<SectionState> {
        let way = |direction: SweepDirection| move |parameter: &f64| (*parameter, direction, 0);
        let (up, down) = (
            self.values.iter().map(way(SweepDirection::Up)),
            self.values.iter().rev().map(way(SweepDirection::Down)),
        );
        let all: Vec<(f64, SweepDirection, usize)> = match self.order {
            DiagramOrder::Up => up.collect(),
            DiagramOrder::Down => down.collect(),
            DiagramOrder::Both => up.chain(down).collect(),
            DiagramOrder::Starts(cloud) => {
                let starts = |value: &f64| {
                    (0..cloud.starts)
                        .map(move |start| (*value, SweepDirection::Independent, start))
                        .collect::<Vec<_>>()
                };
                self.values.iter().flat_map(starts).collect()
            }
        };
        let place = |(index, (parameter, direction, start))| SectionState {
            index,
            parameter,
            direction,
            start,
        };
        all.into_iter().enumerate().map(place).collect()
    }

    fn scattered(
        &self,
        cloud: Cloud,
        found: &[DiagramPoint],
        finish: &(dyn Fn(DiagramPoint) -> Result<DiagramPoint, AnalysisError> + Sync),
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        (self.places().into_par_iter())
            .map(|place| {
                if let Some(visit) = found.iter().find(|visit| visit.index == place.index) {
                    return Ok(Some(visit.clone()));
                }
                // Before the harvester is made: of the places that are left when the work is stopped, none takes time.
                if self.base.kernel.control.is_stopped() {
                    return Ok(None);
                }
                let kernel = self.parameter.at(place.parameter)?.kernel;
                self.finished(place, &cloud.start(&kernel.plant, place.start))?
                    .map(finish)
                    .transpose()
            })
            .filter_map(Result::transpose)
            .collect()
    }

    fn stepped(
        &self,
        found: &[DiagramPoint],
        finish: &(dyn Fn(DiagramPoint) -> Result<DiagramPoint, AnalysisError> + Sync),
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        let rest = vec![0.0; self.base.kernel.plant.len()];
        let mut visits = found.to_vec();
        for place in self.places().into_iter().skip(found.len()) {
            let start = visits
                .last()
                .filter(|last| last.motion != AttractorKind::Lost)
                .map_or(&rest, |last| &last.end)
                .clone();
            let Some(visit) = self.finished(place, &start)? else {
                break;
            };
            visits.push(finish(visit)?);
        }
        Ok(visits)
    }
}
