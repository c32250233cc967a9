//! Sweeps over one numeric key of the spec.
//!
//! Stepped sweeps carry the state over and continue the phase of the drive, so they follow a branch
//! of solutions as long as it exists. Independent points start from the start state of the spec and
//! run in parallel. Each point is computed by the same operations for any number of threads, so the
//! results are bitwise identical.

use super::{AnalysisError, Journal, Model, SweepDirection, SweepPoint};
use crate::run::{RunError, RunPlan, RunResult, StartState, Warning, simulate};
use jounce_control::Control;
use jounce_dynamics::IntegrationError;
use jounce_spec::{Drive, DriveSignal, KeyRange, Spec};
use rayon::prelude::*;
use std::path::PathBuf;

/// Order of the points of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepOrder {
    /// From the first value to the last.
    Up,
    /// From the last value to the first.
    Down,
    /// Up, then down from the last state.
    Both,
    /// Each point from the start state of the spec.
    Independent,
}

/// Definition of a sweep.
#[derive(Debug)]
pub struct Sweep<'s> {
    /// The spec, unchanged.
    pub spec: &'s Spec,
    /// The key and its values.
    pub range: &'s KeyRange,
    /// Order of the points.
    pub direction: SweepOrder,
    /// True: every point runs for `run.duration`. False: until its response has settled. Under an
    /// aperiodic drive nothing settles: every point runs for `run.duration`, with its drives from
    /// their beginning.
    pub fixed_duration: bool,
    /// Folder to which the path of a start state file is relative.
    pub folder: PathBuf,
}

/// Drive cycles between two checks of whether a point has settled.
const CYCLES_PER_CHECK: f64 = 48.0;
/// Drive cycles of the average after a point has settled; a multiple of every period of the search.
const CYCLES_AVERAGED: f64 = 12.0;
/// Limit in run durations, after which a point is reported as not settled.
const MAX_DURATIONS: f64 = 15.0;

impl Sweep<'_> {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.visits().len()
    }

    /// True for a sweep without points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Runs the sweep and returns its points in order. `done` is called for each finished point.
    /// `control` cancels the sweep; the finished points are then returned and remain in the
    /// journal.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn run(
        &self,
        journal: Option<&Journal>,
        control: &Control,
        done: &(dyn Fn(&SweepPoint) + Sync),
    ) -> Result<Vec<SweepPoint>, AnalysisError> {
        let base = Model::watched(self.spec.clone(), control)?;
        let noise = |drive: &Drive| matches!(drive.signal, DriveSignal::Noise { .. });
        if let Some((drive, _)) = self.spec.drive.iter().find(|(_, drive)| noise(drive)) {
            return Err(AnalysisError::SweptNoise {
                drive: drive.clone(),
            });
        }
        control.expect(self.len());
        let mut points = match self.direction {
            SweepOrder::Independent => self.independent(&base, journal, done)?,
            _ => self.stepped(&base, journal, done)?,
        };
        points.sort_by_key(|point| point.index);
        Ok(points)
    }

    fn visits(&self) -> Vec<(f64, SweepDirection)> {
        let up = self.range.values().to_vec();
        let down: Vec<f64> = up.iter().rev().copied().collect();
        match self.direction {
            SweepOrder::Up => directed(&up, SweepDirection::Up),
            SweepOrder::Down => directed(&down, SweepDirection::Down),
            SweepOrder::Both => [
                directed(&up, SweepDirection::Up),
                directed(&down, SweepDirection::Down),
            ]
            .concat(),
            SweepOrder::Independent => up
                .into_iter()
                .map(|value| (value, SweepDirection::Independent))
                .collect(),
        }
    }

    fn independent(
        &self,
        base: &Model,
        journal: Option<&Journal>,
        done: &(dyn Fn(&SweepPoint) + Sync),
    ) -> Result<Vec<SweepPoint>, AnalysisError> {
        let completed = journal.map(Journal::found).unwrap_or_default();
        let points = (self.visits().into_par_iter().enumerate())
            .map(|(index, (value, direction))| {
                if let Some(point) = completed.iter().find(|point| point.index == index) {
                    return Ok(Some(point.clone()));
                }
                if base.kernel.control.is_stopped() {
                    return Ok(None);
                }
                let model = base.changed(self.at(value)?)?;
                let start = model.start(&self.folder)?;
                let point = unless_stopped(self.point(&model, start, index, value, direction))?;
                point
                    .map(|point| self.finish(base, journal, done, point))
                    .transpose()
            })
            .filter_map(Result::transpose)
            .collect::<Result<Vec<_>, AnalysisError>>()?;
        Ok(points)
    }

    fn stepped(
        &self,
        base: &Model,
        journal: Option<&Journal>,
        done: &(dyn Fn(&SweepPoint) + Sync),
    ) -> Result<Vec<SweepPoint>, AnalysisError> {
        let mut points: Vec<SweepPoint> = journal.map(Journal::found).unwrap_or_default().to_vec();
        for (index, (value, direction)) in self.visits().into_iter().enumerate().skip(points.len())
        {
            let model = base.changed(self.at(value)?)?;
            let start = match points.last() {
                Some(last) => last.end.clone(),
                None => model.start(&self.folder)?,
            };
            let Some(point) = unless_stopped(self.point(&model, start, index, value, direction))?
            else {
                break;
            };
            points.push(self.finish(base, journal, done, point)?);
        }
        Ok(points)
    }

    fn at(&self, value: f64) -> Result<Spec, AnalysisError> {
        let mut spec = self.spec.clone();
        self.range.key().set(&mut spec, value)?;
        Ok(spec)
    }

    fn finish(
        &self,
        base: &Model,
        journal: Option<&Journal>,
        done: &(dyn Fn(&SweepPoint) + Sync),
        point: SweepPoint,
    ) -> Result<SweepPoint, AnalysisError> {
        if let Some(journal) = journal {
            journal.keep(&point)?;
        }
        base.kernel.control.count();
        done(&point);
        Ok(point)
    }

    /// Integrates one point.
    fn point(
        &self,
        model: &Model,
        mut start: StartState,
        index: usize,
        value: f64,
        direction: SweepDirection,
    ) -> Result<SweepPoint, AnalysisError> {
        let run = &model.spec.run;
        let fixed_duration = self.fixed_duration || model.kernel.plant.system.aperiodic().is_some();
        let cycle_s = model
            .kernel
            .plant
            .period_s()
            .unwrap_or(run.duration_s)
            .min(run.duration_s);
        let plan = match fixed_duration {
            true => RunPlan::of(run, 0.0),
            false => RunPlan {
                duration_s: CYCLES_PER_CHECK * cycle_s,
                average_over_s: CYCLES_AVERAGED * cycle_s,
                tolerance: run.tolerance,
                record_s: 0.0,
            },
        };
        let plan = plan.watching(&model.spec, &model.kernel.plant);
        let mut simulated_time_s = 0.0;
        loop {
            let kernel = model.from_state(&start)?;
            let result = simulate(&kernel, &start, &plan)?;
            simulated_time_s += plan.duration_s;
            start = result.end.clone();
            if fixed_duration
                || result
                    .settlement
                    .is_some_and(|settlement| settlement.settled)
                || simulated_time_s >= MAX_DURATIONS * run.duration_s
            {
                let mut warnings = Warning::of(&model.spec, &kernel, &plan, &result);
                warnings.retain(|warning| !matches!(warning, Warning::Recording { .. }));
                return Ok(SweepPoint {
                    warnings,
                    ..point_of(&result, &plan, (index, value, direction), simulated_time_s)
                });
            }
        }
    }
}

/// Returns values with the direction in which each is reached; the first has that of the second.
fn directed(values: &[f64], single: SweepDirection) -> Vec<(f64, SweepDirection)> {
    let reached = |index: usize| {
        let next = index.max(1);
        match values.get(next) {
            Some(value) if *value < values[next - 1] => SweepDirection::Down,
            Some(_) => SweepDirection::Up,
            None => single,
        }
    };
    (values.iter().enumerate())
        .map(|(index, value)| (*value, reached(index)))
        .collect()
}

/// Returns `None` for a point that was cancelled.
fn unless_stopped(
    point: Result<SweepPoint, AnalysisError>,
) -> Result<Option<SweepPoint>, AnalysisError> {
    match point {
        Err(AnalysisError::Run(RunError::Integration(IntegrationError::Stopped { .. }))) => {
            Ok(None)
        }
        point => point.map(Some),
    }
}

fn point_of(
    result: &RunResult,
    plan: &RunPlan,
    (index, parameter, direction): (usize, f64, SweepDirection),
    simulated_time_s: f64,
) -> SweepPoint {
    SweepPoint {
        index,
        parameter,
        direction,
        mean_power_w: result.mean_power_w,
        voltage_rms_v: result.voltage_rms_v().unwrap_or(f64::NAN),
        max_penetration_m: result.max_penetration_m,
        contact_rate_hz: result.contacts as f64 / plan.average_over_s,
        settled: result
            .settlement
            .is_some_and(|settlement| settlement.settled),
        period_cycles: result
            .settlement
            .map_or(0, |settlement| settlement.period_cycles),
        energy_residual_relative: result.energies.residual_relative(),
        simulated_time_s,
        warnings: Vec::new(),
        end: result.end.clone(),
    }
}
