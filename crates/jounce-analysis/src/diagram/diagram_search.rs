//! Integrations at every value of a key: stepped up or down with the state carried over, or from a
//! cloud of starts.

use super::diagram_point::{DiagramPoint, SectionState};
use crate::{AnalysisError, AttractorKind, Cloud, Journal, Model, Parameter, SweepDirection};
use jounce_orbits::ParametricModel;
use rayon::prelude::*;

/// Order of the points of a diagram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DiagramOrder {
    /// From the first value to the last, from rest.
    Up,
    /// From the last value to the first, from rest.
    Down,
    /// Up, then down from the last state.
    Both,
    /// At each value from every start of a cloud, in parallel.
    Starts(Cloud),
}

/// Definition of a bifurcation diagram.
#[derive(Debug)]
pub struct Diagram<'s> {
    /// Model of the spec, unchanged.
    pub base: &'s Model,
    /// Family of models over the key.
    pub parameter: &'s Parameter<'s>,
    /// Values of the key.
    pub values: &'s [f64],
    /// Order of the points.
    pub order: DiagramOrder,
    /// Section points recorded for an aperiodic motion.
    pub cycles: u32,
    /// Relative tolerance of the integrations.
    pub tolerance: f64,
}

impl Diagram<'_> {
    /// Number of integrations.
    pub fn len(&self) -> usize {
        self.start_states().len()
    }

    /// True for a diagram without integrations.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Computes the diagram and returns its points in order. `done` is called for each finished
    /// point. The control of the model cancels it; the finished points are then returned and remain
    /// in the journal.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn run(
        &self,
        journal: Option<&Journal<DiagramPoint>>,
        done: &(dyn Fn(&DiagramPoint) + Sync),
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        let completed = journal.map(Journal::found).unwrap_or_default();
        let control = &self.base.kernel.control;
        control.expect(self.len() - completed.len());
        let finish = |visit: DiagramPoint| {
            if let Some(journal) = journal {
                journal.keep(&visit)?;
            }
            control.count();
            done(&visit);
            Ok(visit)
        };
        let mut visits = match self.order {
            DiagramOrder::Starts(cloud) => self.scattered(cloud, completed, &finish)?,
            DiagramOrder::Up | DiagramOrder::Down | DiagramOrder::Both => {
                self.stepped(completed, &finish)?
            }
        };
        visits.sort_by_key(|visit| visit.index);
        Ok(visits)
    }

    /// Returns a finished point; `None` where it was cancelled.
    fn complete_point(
        &self,
        state: SectionState,
        start: &[f64],
    ) -> Result<Option<DiagramPoint>, AnalysisError> {
        let stopped = || self.base.kernel.control.is_stopped();
        if stopped() {
            return Ok(None);
        }
        let visit = self.visit(state, start)?;
        Ok((!stopped()).then_some(visit))
    }

    /// Integrates at a value from a physical start.
    pub(super) fn visit(
        &self,
        state: SectionState,
        start: &[f64],
    ) -> Result<DiagramPoint, AnalysisError> {
        DiagramPoint::integrate(
            (self.base, self.parameter),
            state,
            start,
            (self.cycles, self.tolerance),
        )
    }

    fn start_states(&self) -> Vec<SectionState> {
        let state_at =
            |direction: SweepDirection| move |parameter: &f64| (*parameter, direction, 0);
        let (up, down) = (
            self.values.iter().map(state_at(SweepDirection::Up)),
            self.values.iter().rev().map(state_at(SweepDirection::Down)),
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
        let state = |(index, (parameter, direction, start))| SectionState {
            index,
            parameter,
            direction,
            start,
        };
        all.into_iter().enumerate().map(state).collect()
    }

    fn scattered(
        &self,
        cloud: Cloud,
        completed: &[DiagramPoint],
        finish: &(dyn Fn(DiagramPoint) -> Result<DiagramPoint, AnalysisError> + Sync),
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        (self.start_states().into_par_iter())
            .map(|state| {
                if let Some(visit) = completed.iter().find(|visit| visit.index == state.index) {
                    return Ok(Some(visit.clone()));
                }
                // Checked before the model is built, so that after cancellation the remaining
                // points take no time.
                if self.base.kernel.control.is_stopped() {
                    return Ok(None);
                }
                let kernel = self.parameter.at(state.parameter)?.kernel;
                self.complete_point(state, &cloud.start(&kernel.plant, state.start))?
                    .map(finish)
                    .transpose()
            })
            .filter_map(Result::transpose)
            .collect()
    }

    fn stepped(
        &self,
        completed: &[DiagramPoint],
        finish: &(dyn Fn(DiagramPoint) -> Result<DiagramPoint, AnalysisError> + Sync),
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        let rest = vec![0.0; self.base.kernel.plant.len()];
        let mut visits = completed.to_vec();
        for state in self.start_states().into_iter().skip(completed.len()) {
            let start = visits
                .last()
                .filter(|last| last.motion != AttractorKind::Lost)
                .map_or(&rest, |last| &last.end)
                .clone();
            let Some(visit) = self.complete_point(state, &start)? else {
                break;
            };
            visits.push(finish(visit)?);
        }
        Ok(visits)
    }
}
