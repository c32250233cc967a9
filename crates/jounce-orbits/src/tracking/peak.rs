//! Scalar condition of power stationary along the curve of orbits over the first parameter.
//!
//! ```text
//! g = (L / P) dP/ds,   s the length along the curve of (u, (p - p0) / unit),   L = |u|
//! ```
//!
//! Slopes along the tangent are differences of fourth order; the offset from the curve by its
//! curvature is equal on both sides and cancels. Off the surface of orbits `g` is evaluated at the
//! projection onto it, so that its gradient has two directions only. The first is along the curve
//! (`d2P/ds2`, with the curvature corrected by one more shooting evaluation). The second leads to
//! the neighbouring curve at another second parameter.
//!
//! Validation: `crates/jounce-analysis/tests/orbits/two_parameters/peaks.rs` compares peaks and
//! optimal loads with the closed forms of a harvester without contact.

use super::branch_projection::{BranchProjection, TrackingError};
use super::condition::Gradient;
use super::extended_problem::ExtendedProblem;
use super::two_parameter_problem::TwoParameterProblem;
use crate::{OrbitError, ShootingEvaluation};
use jounce_linalg::norm;

/// Width of a difference along the curve, relative to the size of the state.
const DIFFERENCE_WIDTH: f64 = 3e-3;

/// A step length is accepted if it differs from the wanted one by less than this factor.
const ACCEPTED_WAY_RATIO: f64 = 3.0;

/// First step to the neighbouring curve, in difference steps of the second parameter, ...
const FIRST_WAY: f64 = 10.0;

/// ... the wanted change of `g`: over a shorter step roundoff matters, over a longer one the
/// curvature of `g`, ...
const WANTED_CHANGE: f64 = 1e-3;

/// ... and the largest change of the state over the step, relative to its size.
const MAX_STATE_CHANGE: f64 = 3e-3;

fn power_w(evaluation: &ShootingEvaluation) -> f64 {
    evaluation.loads_w.iter().sum()
}

/// `g` and its slope along the curve.
struct PowerSlopes {
    first: f64,
    /// Derivative by the arc length.
    second: f64,
}

impl<P: TwoParameterProblem> ExtendedProblem<'_, P> {
    /// Returns `g` with its gradient.
    pub(super) fn peak(
        &self,
        (start, parameter, parameter_2): (&[f64], f64, f64),
        (line, neighbour): (&P::Line, &P::Line),
    ) -> Result<Option<Gradient>, TrackingError<P>> {
        let Some(foot) = self.project((start, parameter, parameter_2), line)? else {
            return Ok(None);
        };
        let (n, size) = (foot.start.len(), foot.size());
        let width = DIFFERENCE_WIDTH * size;
        let Some(PowerSlopes { first, second }) = self.slopes(line, &foot, width)? else {
            return Ok(None);
        };
        let difference = self.plane.differences([foot.parameter, parameter_2])[1];
        let (shifted, _) = self
            .shooting(neighbour)
            .shoot(&foot.start, foot.parameter)?;
        let right: Vec<f64> = (0..n)
            .map(|i| -(shifted.residual[i] - foot.shot.residual[i]) / difference)
            .collect();
        let Some(to_side) = foot.tangent.across(&right) else {
            return Ok(None);
        };
        let shifted = |step: f64| self.first_neighbour((&foot, parameter_2), &to_side, step, width);
        let mut step = FIRST_WAY * difference;
        let Some(mut corrected) = shifted(step)? else {
            return Ok(None);
        };
        let farthest = MAX_STATE_CHANGE * size / norm(&to_side);
        let better = (step * WANTED_CHANGE / (corrected - first).abs()).min(farthest);
        if !(1.0 / ACCEPTED_WAY_RATIO..ACCEPTED_WAY_RATIO).contains(&(better / step)) {
            step = better;
            let Some(other) = shifted(step)? else {
                return Ok(None);
            };
            corrected = other;
        }
        let along = &foot.tangent.along;
        Ok(Some(Gradient {
            value: first,
            by_unknown: along[..n].iter().map(|t| second * t).collect(),
            by_parameters: [second * along[n] / self.unit, (corrected - first) / step],
            by_phase: 0.0,
            power_curvature: Some(second * size),
            is_resonant: false,
        }))
    }

    /// Computes the slopes from evaluations at one and two widths, on both sides along the curve.
    fn slopes(
        &self,
        line: &P::Line,
        foot: &BranchProjection,
        width: f64,
    ) -> Result<Option<PowerSlopes>, TrackingError<P>> {
        let (foot_power_w, residual) = (power_w(&foot.shot), &foot.shot.residual);
        let sides = self.sides(line, foot, width)?;
        // The mean of the two sides differs from the curve by the curvature.
        let left_part = |i: usize, pair: usize| {
            0.5 * (sides[pair][0].residual[i] + sides[pair][1].residual[i]) - residual[i]
        };
        let bend: Vec<f64> = (0..residual.len())
            .map(|i| -(16.0 * left_part(i, 0) - left_part(i, 1)) / 12.0)
            .collect();
        let Some(bend) = foot.tangent.across(&bend) else {
            return Ok(None);
        };
        let bent_w = power_w(&self.shoot_off(line, foot, &bend, 1.0)?);
        let both =
            |pair: usize| power_w(&sides[pair][0]) + power_w(&sides[pair][1]) - 2.0 * foot_power_w;
        let second_w = (16.0 * both(0) - both(1)) / 12.0 + 2.0 * (bent_w - foot_power_w);
        let unit = foot.size() / foot_power_w;
        Ok(Some(PowerSlopes {
            first: first_w(&sides, width) * unit,
            second: second_w / (width * width) * unit,
        }))
    }

    /// Returns `g` on the neighbouring curve.
    fn first_neighbour(
        &self,
        (foot, parameter_2): (&BranchProjection, f64),
        to_side: &[f64],
        step: f64,
        width: f64,
    ) -> Result<Option<f64>, TrackingError<P>> {
        let line = self
            .plane
            .line(parameter_2 + step)
            .map_err(OrbitError::Harvester)?;
        let corrected: Vec<f64> = foot
            .start
            .iter()
            .zip(to_side)
            .map(|(u, d)| u + step * d)
            .collect();
        let parameter = foot.parameter + step * self.unit * to_side[corrected.len()];
        let Some(other) = self.project((&corrected, parameter, parameter_2 + step), &line)? else {
            return Ok(None);
        };
        let sense: f64 = other
            .tangent
            .along
            .iter()
            .zip(&foot.tangent.along)
            .map(|(a, b)| a * b)
            .sum();
        let first = first_w(&self.sides(&line, &other, width)?, width) * other.size()
            / power_w(&other.shot);
        Ok(Some(sense.signum() * first))
    }

    fn sides(
        &self,
        line: &P::Line,
        foot: &BranchProjection,
        width: f64,
    ) -> Result<[[ShootingEvaluation; 2]; 2], TrackingError<P>> {
        let shifted_point =
            |widths: f64| self.shoot_off(line, foot, &foot.tangent.along, widths * width);
        Ok([
            [shifted_point(-1.0)?, shifted_point(1.0)?],
            [shifted_point(-2.0)?, shifted_point(2.0)?],
        ])
    }

    /// Shoots from a point changed by `(u, (p - p0) / unit)`.
    fn shoot_off(
        &self,
        line: &P::Line,
        foot: &BranchProjection,
        change: &[f64],
        length: f64,
    ) -> Result<ShootingEvaluation, TrackingError<P>> {
        let shifted: Vec<f64> = foot
            .start
            .iter()
            .zip(change)
            .map(|(u, d)| u + length * d)
            .collect();
        Ok(self
            .shooting(line)
            .shoot(
                &shifted,
                foot.parameter + length * self.unit * change[shifted.len()],
            )?
            .0)
    }
}

/// Returns the slope of the power along a curve, W per length, from the evaluations on both sides
/// of a point.
fn first_w(sides: &[[ShootingEvaluation; 2]; 2], width: f64) -> f64 {
    let across = |[before, after]: &[ShootingEvaluation; 2]| power_w(after) - power_w(before);
    (8.0 * across(&sides[0]) - across(&sides[1])) / (12.0 * width)
}
