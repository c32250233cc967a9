//! Projection of a point onto the surface of orbits, at the same second parameter.

use super::extended_problem::ExtendedProblem;
use super::two_parameter_problem::TwoParameterProblem;
use crate::bordered::border::solve_bordered;
use crate::{OrbitError, ParametricModel, ShootingEvaluation, null_vector};
use jounce_linalg::{Mat, norm};

/// Newton steps of the projection, and the residual, relative to the size of the state, below which
/// no step is made.
const MAX_NEWTON_STEPS: usize = 2;
const NEWTON_TOLERANCE: f64 = 1e-13;

/// Reach to both sides of the first parameter, in steps of its difference quotient.
const FIRST_PARAMETER_REACH: f64 = 10.0;

/// Projection of a point onto the surface of orbits.
pub(super) struct BranchProjection {
    pub start: Vec<f64>,
    pub parameter: f64,
    pub shot: ShootingEvaluation,
    pub tangent: LinearizedOrbit,
}

/// Line through a point, linearised.
pub(super) struct LinearizedOrbit {
    matrix: Mat<f64>,
    column: Vec<f64>,
    /// Unit vector of `(u, (p - p0) / unit)`.
    pub along: Vec<f64>,
}

impl LinearizedOrbit {
    fn of(evaluation: &ShootingEvaluation, unit: f64) -> Option<Self> {
        let n = evaluation.residual.len();
        let matrix = Mat::from_fn(n, n, |i, j| {
            evaluation.map()[(i, j)] - f64::from(u8::from(i == j))
        });
        let column: Vec<f64> = evaluation.by_parameter.iter().map(|by| unit * by).collect();
        let square = Mat::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => matrix[(i, j)],
            (true, false) => column[i],
            (false, _) => 0.0,
        });
        let rough = null_vector(&square);
        let (mut along, last) = solve_bordered(
            &matrix,
            &column,
            (&rough[..n], rough[n]),
            (&vec![0.0; n], 1.0),
        )?;
        along.push(last);
        let length = norm(&along);
        along.iter_mut().for_each(|t| *t /= length);
        Some(Self {
            matrix,
            column,
            along,
        })
    }

    /// Returns the shortest change that changes the residual by `right`.
    pub fn across(&self, right: &[f64]) -> Option<Vec<f64>> {
        let n = right.len();
        let (mut change, last) = solve_bordered(
            &self.matrix,
            &self.column,
            (&self.along[..n], self.along[n]),
            (right, 0.0),
        )?;
        change.push(last);
        Some(change)
    }
}

pub(super) type TrackingError<P> =
    OrbitError<<<P as TwoParameterProblem>::Line as ParametricModel>::Error>;

impl BranchProjection {
    /// Returns the size of the state.
    pub fn size(&self) -> f64 {
        norm(&self.start)
    }
}

impl<P: TwoParameterProblem> ExtendedProblem<'_, P> {
    /// Projects a point onto the surface of orbits, at the same second parameter.
    pub(super) fn project(
        &self,
        (start, parameter, parameter_2): (&[f64], f64, f64),
        line: &P::Line,
    ) -> Result<Option<BranchProjection>, TrackingError<P>> {
        let (mut start, mut parameter) = (start.to_vec(), parameter);
        for step in 0.. {
            let evaluation = self.shot_with_slopes(line, &start, (parameter, parameter_2))?;
            let Some(tangent) = LinearizedOrbit::of(&evaluation, self.unit) else {
                break;
            };
            let residual = norm(&evaluation.residual) / norm(&start);
            if step == MAX_NEWTON_STEPS || residual < NEWTON_TOLERANCE {
                return Ok(Some(BranchProjection {
                    start,
                    parameter,
                    shot: evaluation,
                    tangent,
                }));
            }
            let right: Vec<f64> = evaluation.residual.iter().map(|r| -r).collect();
            let Some(change) = tangent.across(&right) else {
                break;
            };
            start.iter_mut().zip(&change).for_each(|(u, d)| *u += d);
            parameter += self.unit * change[start.len()];
        }
        Ok(None)
    }

    /// Shoots with the derivative by the first parameter to second order: an error of the tangent
    /// is amplified many times in the slope of the power along it.
    fn shot_with_slopes(
        &self,
        line: &P::Line,
        start: &[f64],
        (parameter, parameter_2): (f64, f64),
    ) -> Result<ShootingEvaluation, TrackingError<P>> {
        let shooting = self.shooting(line);
        let (mut evaluation, exact) = shooting.shoot(start, parameter)?;
        if !exact {
            let difference =
                FIRST_PARAMETER_REACH * self.plane.differences([parameter, parameter_2])[0];
            let [(less, _), (more, _)] = [
                shooting.shoot(start, parameter - difference)?,
                shooting.shoot(start, parameter + difference)?,
            ];
            let slope = |(more, less): (&f64, &f64)| (more - less) / (2.0 * difference);
            evaluation.by_parameter = more
                .residual
                .iter()
                .zip(&less.residual)
                .map(slope)
                .collect();
        }
        Ok(evaluation)
    }
}
