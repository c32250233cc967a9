//! Result of a sweep.

use jounce_analysis::run::{ExceededLimit, Warning, WorstExcess};
use jounce_analysis::{Sweep, SweepDirection};
use serde::Serialize;

/// Runs at every value of a key, in the order of the points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepResult {
    /// Path of the key.
    pub key: String,
    /// SI unit of the key.
    pub unit: String,
    /// The points; after a stop by the user the finished ones.
    pub points: Vec<SweepPoint>,
    /// Number of points of the complete sweep.
    #[serde(skip)]
    pub expected: usize,
    /// True where all drives are periodic, so that a response can settle.
    #[serde(skip)]
    pub can_settle: bool,
}

/// Result at one value of the key.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepPoint {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Direction from which it was reached.
    pub direction: SweepDirection,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Rms voltage of the first load, or of the storage of the first rectified circuit without a
    /// load, V; NaN where no circuit takes power.
    pub voltage_rms_v: f64,
    /// Largest penetration of any stop, m.
    pub max_penetration_m: f64,
    /// Contacts per second, Hz.
    pub contact_rate_hz: f64,
    /// True where the response had settled at the end of the average, which may contain a transient.
    pub settled: bool,
    /// Period of the response in drive cycles.
    pub period_cycles: u32,
    /// Energy residual relative to the largest energy.
    pub energy_residual_relative: f64,
    /// Simulated time, s.
    pub simulated_time_s: f64,
    /// Warnings of the run.
    pub warnings: Vec<Warning>,
}

impl SweepResult {
    pub(super) fn new(study: &Sweep, points: Vec<jounce_analysis::SweepPoint>) -> Self {
        let key = study.range.key();
        let mut drives = study.spec.drive.values();
        Self {
            key: key.path().to_owned(),
            unit: key.unit(),
            expected: study.len(),
            can_settle: drives.all(|drive| drive.frequency_hz().is_some()),
            points: points.into_iter().map(SweepPoint::of).collect(),
        }
    }

    /// Returns the message about points that had not settled, if there are any.
    pub fn unsettled(&self) -> Option<String> {
        let unsettled = self.points.iter().filter(|point| !point.settled).count();
        (self.can_settle && unsettled > 0).then(|| {
            format!(
                "{unsettled} of {} points had not settled when averaged; they are marked settled = false",
                self.points.len()
            )
        })
    }

    /// Returns the note on the starts of the points of a stepped sweep; `None` where each point starts
    /// from `run.start`.
    pub fn carried_over(&self) -> Option<&'static str> {
        let is_stepped = |point: &SweepPoint| point.direction != SweepDirection::Independent;
        self.points.iter().any(is_stepped).then_some(
            "each point starts from the motion at the point before; with `direction` independent each starts from run.start",
        )
    }

    /// Returns the messages about warnings of points: of each limit the worst case, of others the
    /// first.
    pub fn warnings(&self) -> Vec<String> {
        let limits: Vec<Vec<ExceededLimit>> =
            self.points.iter().map(SweepPoint::exceeded).collect();
        let limits: Vec<&[ExceededLimit]> = limits.iter().map(Vec::as_slice).collect();
        let mut messages = WorstExcess::messages(&limits, "points", |index| self.place(index));
        let all = self.points.iter().enumerate().flat_map(|(index, point)| {
            let own = point.warnings.iter();
            own.map(move |warning| (index, warning))
        });
        let mut others: Vec<(usize, &Warning, usize)> = Vec::new();
        for (index, warning) in all.filter(|(_, own)| !matches!(own, Warning::Limit(_))) {
            let is_same = |(_, first, _): &&mut (usize, &Warning, usize)| {
                std::mem::discriminant(*first) == std::mem::discriminant(warning)
                    && first.subject() == warning.subject()
            };
            match others.iter_mut().find(is_same) {
                Some((_, _, count)) => *count += 1,
                None => others.push((index, warning, 1)),
            }
        }
        let of = self.points.len();
        messages.extend(others.into_iter().map(|(index, warning, count)| {
            let place = self.place(index);
            format!("{warning}; {count} of {of} points have this warning, first {place}")
        }));
        messages
    }

    /// Returns the key with its value at a point.
    fn place(&self, index: usize) -> String {
        let value = self.points[index].parameter;
        format!("{} = {value:.6} {}", self.key, self.unit)
    }
}

impl SweepPoint {
    /// Returns the exceeded limits of patches.
    fn exceeded(&self) -> Vec<ExceededLimit> {
        let limits = self.warnings.iter().filter_map(|warning| match warning {
            Warning::Limit(exceeded) => Some(exceeded.clone()),
            _ => None,
        });
        limits.collect()
    }

    fn of(point: jounce_analysis::SweepPoint) -> Self {
        Self {
            parameter: point.parameter,
            direction: point.direction,
            mean_power_w: point.mean_power_w,
            voltage_rms_v: point.voltage_rms_v,
            max_penetration_m: point.max_penetration_m,
            contact_rate_hz: point.contact_rate_hz,
            settled: point.settled,
            period_cycles: point.period_cycles,
            energy_residual_relative: point.energy_residual_relative,
            simulated_time_s: point.simulated_time_s,
            warnings: point.warnings,
        }
    }
}
