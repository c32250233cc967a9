//! Sweep up and down over a key; points are returned one by one.

use super::key_span::values;
use super::{Design, KeySpan};
use crate::error::Error;
use jounce_analysis::{Sweep, SweepDirection, SweepOrder, SweepPoint};
use jounce_control::Control;
use jounce_spec::KeyRange;
use serde::Serialize;

/// A point of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LivePoint {
    /// Number of the point, from 0.
    pub index: usize,
    /// Number of points of the sweep.
    pub points: usize,
    /// Value of the key, SI.
    pub parameter: f64,
    /// False on the way down.
    pub up: bool,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Rms voltage of the first load, V.
    pub voltage_rms_v: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// True where the response has settled.
    pub settled: bool,
}

impl Design {
    /// Integrates at so many values of a key, up and then down from the last state. `done` is
    /// called for each point as soon as it is integrated. Returns the number of points.
    ///
    /// # Errors
    /// [`Error::Spec`] and [`Error::Option`] for the key and its range, [`Error::Analysis`] for a
    /// drive of noise or an integration that does not converge.
    pub fn sweep(
        &self,
        span: &KeySpan,
        points: usize,
        control: &Control,
        done: &(dyn Fn(LivePoint) + Sync),
    ) -> Result<usize, Error> {
        let range = values(span.key(self)?, span.ends(), points, "x")?;
        self.sweep_over(&range, SweepOrder::Both, control, done)
    }

    /// Runs a sweep over a range.
    pub(super) fn sweep_over(
        &self,
        range: &KeyRange,
        direction: SweepOrder,
        control: &Control,
        done: &(dyn Fn(LivePoint) + Sync),
    ) -> Result<usize, Error> {
        let sweep = Sweep {
            spec: self.spec(),
            range,
            direction,
            fixed_duration: false,
            folder: self.harvester().folder().to_path_buf(),
        };
        let points = sweep.len();
        let report = |point: &SweepPoint| {
            done(LivePoint {
                index: point.index,
                points,
                parameter: point.parameter,
                up: point.direction != SweepDirection::Down,
                mean_power_w: point.mean_power_w,
                voltage_rms_v: point.voltage_rms_v,
                max_penetration_m: point.max_penetration_m,
                settled: point.settled,
            });
        };
        sweep.run(None, control, &report)?;
        Ok(points)
    }
}
