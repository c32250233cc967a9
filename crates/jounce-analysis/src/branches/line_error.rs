//! Error of a branch that is drawn with straight lines between its points.
//!
//! The drawing has the coordinates
//!
//! ```text
//! x = p / (range of p),   y = ln(P) / 5
//! ```
//!
//! of the key `p` and the mean power `P`. A distance of 0.01 is a hundredth of the range, or 5 % of
//! the power. The error of a line is the sum of two:
//!
//! - A point is off by Newton's correction normal to the curve, with integrations at a tenth of the
//!   tolerance. It includes the error of Newton's method and of the integrations.
//! - A chord is off by at most the height of the cubic with the directions of the curve at both
//!   ends and the error of this cubic. [`Interpolant`] bounds both, also for a curve with a kink.

use super::branch::{Branch, BranchPoint};
use super::branch_tracer::tracer::parameter_scale;
use super::branch_update::at;
use super::events::{Interpolant, slope_distance};
use crate::Parameter;
use jounce_continuation::{Direction, Metric, Position, Problem, tangent};
use jounce_dynamics::Kernel;
use jounce_orbits::{FINER_TOLERANCE, Shooting};
use rayon::prelude::*;

/// Scale of the logarithm of the power in the drawing.
const LEVEL_SCALE: f64 = 0.2;

/// Errors of the lines of branches.
#[derive(Debug)]
pub struct LineErrors<'s> {
    /// Family of models over the key.
    pub family: &'s Parameter<'s>,
    /// Kernel of one of these models.
    pub kernel: &'s Kernel,
    /// Ends of the range of the key.
    pub range: (f64, f64),
    /// Relative tolerance of the integrations that computed the points.
    pub tolerance: f64,
}

/// Point of a curve in the drawing.
struct DrawnPoint {
    position: Position,
    /// Unit tangent of the curve.
    tangent: Direction,
    drawn: [f64; 2],
    /// Direction of the tangent in the drawing.
    direction: [f64; 2],
    /// Distance from the curve.
    error: f64,
}

impl LineErrors<'_> {
    /// Returns the largest distance of each line between two neighbouring points from the curve;
    /// infinite where it is not known.
    pub fn of(&self, branch: &Branch) -> Vec<f64> {
        let (cycles, tolerance) = (branch.period_cycles, FINER_TOLERANCE * self.tolerance);
        let shooting = Shooting::new(self.family, self.kernel, cycles, tolerance);
        let points = branch.points.par_iter();
        let drawn: Vec<_> = points.map(|point| self.drawn(&shooting, point)).collect();
        let error = |pair: &[Option<DrawnPoint>]| match pair {
            [Some(from), Some(to)] => self.line_error(from, to),
            _ => f64::INFINITY,
        };
        drawn.windows(2).map(error).collect()
    }

    /// Returns a point with its direction and error; `None` where an integration fails, or where
    /// diodes pass so little power that its relative error is not known.
    fn drawn(
        &self,
        shooting: &Shooting<'_, Parameter<'_>>,
        point: &BranchPoint,
    ) -> Option<DrawnPoint> {
        let position = at(point);
        let scale = parameter_scale(self.range);
        let local = shooting.at(&position.unknown, position.parameter).ok()?;
        let has_diodes = !local.kernel.plant.system.bridges.is_empty();
        if has_diodes && point.orbit.mean_power_w < local.least_power_w() {
            return None;
        }
        let metric = Metric::at(&position, scale);
        let up = Direction {
            unknown: vec![0.0; position.unknown.len()],
            parameter: scale,
        };
        let tangent = tangent(&local, &metric, &up)?;
        let (across, _) = local.across(position.parameter, scale)?;
        let on_curve = position.offset_along(&across, 1.0);
        let draw = |position: &Position| {
            let power_w = shooting.mean_power_w(&position.unknown, position.parameter);
            Some(self.place(position.parameter, power_w.ok()?))
        };
        let here = draw(&on_curve)?;
        let step = slope_distance(shooting.tolerance);
        let slope = |side: f64| {
            let [x, y] = draw(&on_curve.offset_along(&tangent, side * step))?;
            Some([(x - here[0]) / (side * step), (y - here[1]) / (side * step)])
        };
        // At the edge of the range the key may have no meaning on one side.
        let direction = slope(1.0).or_else(|| slope(-1.0))?;
        let drawn = self.place(position.parameter, point.orbit.mean_power_w);
        Some(DrawnPoint {
            position,
            tangent,
            drawn,
            direction,
            error: (here[0] - drawn[0]).hypot(here[1] - drawn[1]),
        })
    }

    /// Returns the coordinates in the drawing.
    fn place(&self, parameter: f64, power_w: f64) -> [f64; 2] {
        let width = self.range.1 - self.range.0;
        [
            parameter / width,
            LEVEL_SCALE * power_w.max(f64::MIN_POSITIVE).ln(),
        ]
    }

    /// Returns the largest distance of the line between two points from the curve; infinite where
    /// the curve leaves an end away from the other one.
    fn line_error(&self, from: &DrawnPoint, to: &DrawnPoint) -> f64 {
        let metric = Metric::at(&from.position, parameter_scale(self.range));
        let chord = from.position.to(&to.position);
        let [x, y] = [to.drawn[0] - from.drawn[0], to.drawn[1] - from.drawn[1]];
        let ends = from.error.max(to.error);
        let length = x.hypot(y);
        if length == 0.0 {
            return ends;
        }
        let slope = |point: &DrawnPoint| {
            let side = metric.inner(&point.tangent, &chord).signum();
            let [dx, dy] = point.direction.map(|d| side * d);
            let (along, across) = (dx * x + dy * y, x * dy - y * dx);
            if along > 0.0 {
                length * across / along
            } else {
                f64::INFINITY
            }
        };
        let height = Interpolant {
            values: [0.0; 2],
            slopes: [slope(from), slope(to)],
        };
        let chord_error = 2.0 * height.error();
        if chord_error.is_finite() {
            chord_error + ends
        } else {
            f64::INFINITY
        }
    }
}
