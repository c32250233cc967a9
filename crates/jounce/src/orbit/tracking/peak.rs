//! Power that is stationary along the curve of orbits over the first parameter, as a scalar.
//!
//! ```text
//! g = (L / P) dP/ds,   s the length along the curve of (u, (p - p0) / unit),   L = |u|
//! ```
//!
//! Slopes along the tangent are differences of fourth order in their width; what moves off the curve by its bend does so alike on both
//! sides and cancels. Off the surface of orbits `g` is that of the orbit across from there, so that its gradient has two directions only: along
//! the curve (`d2P/ds2`, with the bend of the curve put back by one shot more), and to the neighbouring curve at another second parameter.
//!
//! Validation: `tests/orbits/peaks.rs` compares peaks and optimal loads with the closed forms of a harvester that never touches.

use super::condition::Gradient;
use super::plane::Plane;
use super::tracked::Tracking;
use crate::orbit::border::solve_bordered;
use crate::orbit::{Harvester, OrbitError, Shot, null_vector};
use faer::{ColRef, Mat};

/// Width of the difference along the curve, beside the size of the state.
const WIDTH: f64 = 3e-3;

/// Way to the neighbouring curve that is tried first, in differences of the second parameter, ...
const ASIDE: f64 = 10.0;

/// ... the change of `g` that it should make: over a shorter way roundoff counts, over a longer one `g` bends, ...
const CHANGE: f64 = 1e-3;

/// ... and the farthest that the state may go on it, beside its size.
const REACH: f64 = 3e-3;

/// Newton steps to the orbit across from a place, and the residual beside the size of the state below which none is taken.
const STEPS: usize = 2;
const CLOSED: f64 = 1e-11;

/// The orbit across from a place.
struct Foot {
    start: Vec<f64>,
    parameter: f64,
    shot: Shot,
    tangent: Tangent,
}

/// The line through a place, linearised.
struct Tangent {
    matrix: Mat<f64>,
    column: Vec<f64>,
    /// Unit vector of `(u, (p - p0) / unit)`.
    along: Vec<f64>,
}

impl Tangent {
    fn of(shot: &Shot, unit: f64) -> Option<Self> {
        let n = shot.residual.len();
        let matrix = Mat::from_fn(n, n, |i, j| shot.map[(i, j)] - f64::from(u8::from(i == j)));
        let column: Vec<f64> = shot.by_parameter.iter().map(|by| unit * by).collect();
        let square = Mat::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => matrix[(i, j)],
            (true, false) => column[i],
            (false, _) => 0.0,
        });
        let rough = null_vector(&square);
        let (mut along, last) = solve_bordered(&matrix, &column, (&rough[..n], rough[n]), (&vec![0.0; n], 1.0))?;
        along.push(last);
        let length = ColRef::from_slice(&along).norm_l2();
        along.iter_mut().for_each(|t| *t /= length);
        Some(Self { matrix, column, along })
    }

    /// The shortest change that changes the residual by `right`.
    fn across(&self, right: &[f64]) -> Option<Vec<f64>> {
        let n = right.len();
        let (mut change, last) = solve_bordered(&self.matrix, &self.column, (&self.along[..n], self.along[n]), (right, 0.0))?;
        change.push(last);
        Some(change)
    }
}

fn power_w(shot: &Shot) -> f64 {
    shot.loads_w.iter().sum()
}

type Failure<P> = OrbitError<<<P as Plane>::Line as Harvester>::Error>;

impl<P: Plane> Tracking<'_, P> {
    /// `g` with its gradient.
    pub(super) fn peak(
        &self,
        (start, parameter, parameter_2): (&[f64], f64, f64),
        (line, beside): (&P::Line, &P::Line),
    ) -> Result<Option<Gradient>, Failure<P>> {
        let Some(Foot { start, parameter, shot, tangent }) = self.foot((start, parameter), line)? else { return Ok(None) };
        let difference = self.plane.differences([parameter, parameter_2])[1];
        let n = start.len();
        let (size, own_w) = (ColRef::from_slice(&start).norm_l2(), power_w(&shot));
        let width = WIDTH * size;
        let sides = self.sides(line, (&start, parameter), &tangent.along, width)?;
        // Half-way between the two sides the straight way has left the curve by the bend.
        let left = |i: usize, pair: usize| 0.5 * (sides[pair][0].residual[i] + sides[pair][1].residual[i]) - shot.residual[i];
        let bend: Vec<f64> = (0..n).map(|i| -(16.0 * left(i, 0) - left(i, 1)) / 12.0).collect();
        let Some(bend) = tangent.across(&bend) else { return Ok(None) };
        let bent_w = power_w(&self.shoot_off(line, (&start, parameter), &bend, 1.0)?);
        let both = |pair: usize| power_w(&sides[pair][0]) + power_w(&sides[pair][1]) - 2.0 * own_w;
        let second = (16.0 * both(0) - both(1)) / 12.0 + 2.0 * (bent_w - own_w);
        let per_length = second / (width * width) * size / own_w;
        let (aside, _) = self.shooting(beside).shoot(&start, parameter)?;
        let right: Vec<f64> = (0..n).map(|i| -(aside.residual[i] - shot.residual[i]) / difference).collect();
        let Some(to_side) = tangent.across(&right) else { return Ok(None) };
        let slope = slope(&sides, width) * size / own_w;
        let aside_by = |step: f64| self.slope_aside((&start, parameter, parameter_2), &tangent.along, &to_side, step);
        let mut step = ASIDE * difference;
        let Some(mut there) = aside_by(step)? else { return Ok(None) };
        let farthest = REACH * size / ColRef::from_slice(&to_side).norm_l2();
        let better = (step * CHANGE / (there - slope).abs()).min(farthest);
        if !(0.3..3.0).contains(&(better / step)) {
            step = better;
            match aside_by(step)? {
                Some(other) => there = other,
                None => return Ok(None),
            }
        }
        Ok(Some(Gradient {
            value: slope,
            by_unknown: tangent.along[..n].iter().map(|t| per_length * t).collect(),
            by_parameters: [per_length * tangent.along[n] / self.unit, (there - slope) / step],
            by_phase: 0.0,
            bend: Some(per_length * size),
            is_resonant: false,
        }))
    }

    /// The orbit across from a place, at the same second parameter.
    fn foot(&self, (start, parameter): (&[f64], f64), line: &P::Line) -> Result<Option<Foot>, Failure<P>> {
        let (mut start, mut parameter) = (start.to_vec(), parameter);
        for step in 0.. {
            let shot = self.shot_with_slopes(line, &start, parameter)?;
            let Some(tangent) = Tangent::of(&shot, self.unit) else { break };
            let off = ColRef::from_slice(&shot.residual).norm_l2() / ColRef::from_slice(&start).norm_l2();
            if step == STEPS || off < CLOSED {
                return Ok(Some(Foot { start, parameter, shot, tangent }));
            }
            let right: Vec<f64> = shot.residual.iter().map(|r| -r).collect();
            let Some(change) = tangent.across(&right) else { break };
            start.iter_mut().zip(&change).for_each(|(u, d)| *u += d);
            parameter += self.unit * change[start.len()];
        }
        Ok(None)
    }

    /// A shot with its derivative by the first parameter to second order: what the tangent is off by, `g` is off by.
    fn shot_with_slopes(&self, line: &P::Line, start: &[f64], parameter: f64) -> Result<Shot, Failure<P>> {
        let shooting = self.shooting(line);
        let (mut shot, exact) = shooting.shoot(start, parameter)?;
        if !exact {
            let difference = line.difference();
            let [(less, _), (more, _)] = [shooting.shoot(start, parameter - difference)?, shooting.shoot(start, parameter + difference)?];
            let slope = |(more, less): (&f64, &f64)| (more - less) / (2.0 * difference);
            shot.by_parameter = more.residual.iter().zip(&less.residual).map(slope).collect();
        }
        Ok(shot)
    }

    /// A shot off a place by a change of `(u, (p - p0) / unit)`.
    fn shoot_off(&self, line: &P::Line, (start, parameter): (&[f64], f64), change: &[f64], length: f64) -> Result<Shot, Failure<P>> {
        let n = start.len();
        let moved: Vec<f64> = start.iter().zip(change).map(|(u, d)| u + length * d).collect();
        Ok(self.shooting(line).shoot(&moved, parameter + length * self.unit * change[n])?.0)
    }

    /// Shots once and twice a width off a place, on both sides along the curve.
    fn sides(&self, line: &P::Line, here: (&[f64], f64), along: &[f64], width: f64) -> Result<[[Shot; 2]; 2], Failure<P>> {
        let off = |widths: f64| self.shoot_off(line, here, along, widths * width);
        Ok([[off(-1.0)?, off(1.0)?], [off(-2.0)?, off(2.0)?]])
    }

    /// `g` on the neighbouring curve.
    fn slope_aside(
        &self,
        (start, parameter, parameter_2): (&[f64], f64, f64),
        along: &[f64],
        to_side: &[f64],
        step: f64,
    ) -> Result<Option<f64>, Failure<P>> {
        let n = start.len();
        let line = self.plane.line(parameter_2 + step).map_err(OrbitError::Harvester)?;
        let there: Vec<f64> = start.iter().zip(to_side).map(|(u, d)| u + step * d).collect();
        let parameter = parameter + step * self.unit * to_side[n];
        let shot = self.shot_with_slopes(&line, &there, parameter)?;
        let Some(tangent) = Tangent::of(&shot, self.unit) else { return Ok(None) };
        let sense: f64 = tangent.along.iter().zip(along).map(|(a, b)| a * b).sum();
        let size = ColRef::from_slice(start).norm_l2();
        let width = WIDTH * size;
        let sides = self.sides(&line, (&there, parameter), &tangent.along, width)?;
        Ok(Some(sense.signum() * slope(&sides, width) * size / power_w(&shot)))
    }
}

/// Slope of the power along a curve, W per length, from the shots beside a place.
fn slope(sides: &[[Shot; 2]; 2], width: f64) -> f64 {
    let across = |[before, after]: &[Shot; 2]| power_w(after) - power_w(before);
    (8.0 * across(&sides[0]) - across(&sides[1])) / (12.0 * width)
}
