//! Extended problem as a family over the second parameter.

use super::condition::{Condition, Gradient};
use super::grazing::{self, GrazingPoint};
use super::two_parameter_problem::TwoParameterProblem;
use crate::bordered::border::solve_bordered;
use crate::{OrbitError, ParametricModel, Shooting, ShootingEvaluation};
use jounce_continuation::{Linearization, Problem};
use jounce_linalg::Mat;

/// Integration tolerance relative to the tolerance of the curve. The condition is a derivative of
/// the flow, and the slopes of Newton are difference quotients of it.
const INTEGRATION_TOLERANCE_FACTOR: f64 = 1e-2;

/// Smallest integration tolerance used.
const MIN_INTEGRATION_TOLERANCE: f64 = 1e-12;

/// Bifurcation of orbits, continued in two parameters.
#[derive(Debug)]
pub struct ExtendedProblem<'p, P> {
    /// Harvesters over the two parameters.
    pub plane: &'p P,
    /// Condition of the bifurcation.
    pub condition: Condition,
    /// Drive cycles in the period.
    pub cycles: u32,
    /// Relative tolerance of the curve; the integration tolerance is finer.
    pub tolerance: f64,
    /// `W` of shooting.
    pub scale: Vec<f64>,
    /// Value of the first parameter where its unknown is zero ...
    pub origin: f64,
    /// ... and its change that is scaled like a unit change of the state.
    pub unit: f64,
}

/// Extended problem evaluated at one point.
#[derive(Debug)]
pub struct ExtendedEvaluation {
    /// Orbit.
    pub shot: ShootingEvaluation,
    /// At a peak, second derivative of the power along the curve, relative to the power: negative
    /// at a maximum.
    pub power_curvature: Option<f64>,
    /// True where a pair on the circle has met on the real axis, so that the tori have ended.
    pub is_resonant: bool,
    residual: Vec<f64>,
    /// Number of rows of `R`; the rows of the condition follow.
    states: usize,
    /// Derivative by the unknown: `u`, the first parameter and, at a grazing, the time of the
    /// turning point.
    matrix: Mat<f64>,
    /// Derivative by the second parameter.
    by_parameter: Vec<f64>,
}

type LineError<P> = <<P as TwoParameterProblem>::Line as ParametricModel>::Error;

impl<P: TwoParameterProblem> ExtendedProblem<'_, P> {
    /// Returns the shooting problem along one line.
    pub fn shooting<'l>(&self, line: &'l P::Line) -> Shooting<'l, P::Line> {
        Shooting {
            family: line,
            cycles: self.cycles,
            tolerance: self.integration_tolerance(),
            scale: self.scale.clone(),
            charged: Vec::new(),
        }
    }

    fn integration_tolerance(&self) -> f64 {
        (INTEGRATION_TOLERANCE_FACTOR * self.tolerance)
            .max(MIN_INTEGRATION_TOLERANCE)
            .min(self.tolerance)
    }

    /// Returns the first parameter of an unknown.
    pub fn parameter(&self, unknown: &[f64]) -> f64 {
        self.origin + self.unit * unknown[self.parameter_index()]
    }

    /// Returns the index of the first parameter in the unknown: it follows the state.
    pub fn parameter_index(&self) -> usize {
        self.scale.len()
    }

    /// Returns the unknown of an orbit at a value of the first parameter.
    pub fn unknown(&self, start: &[f64], parameter: f64) -> Vec<f64> {
        let phase = matches!(self.condition, Condition::Touching(_)).then_some(0.0);
        start
            .iter()
            .copied()
            .chain([(parameter - self.origin) / self.unit])
            .chain(phase)
            .collect()
    }
}

impl<P: TwoParameterProblem> ExtendedProblem<'_, P> {
    /// Returns the distance of the nearest turning point past its surface, relative to the scale of
    /// the motion, with its gradient; `None` without one.
    ///
    /// # Errors
    /// See [`Problem::at`].
    pub fn past(
        &self,
        unknown: &[f64],
        parameter_2: f64,
    ) -> Result<Option<Gradient>, OrbitError<LineError<P>>> {
        let (start, parameter) = (&unknown[..self.parameter_index()], self.parameter(unknown));
        let differences = self.plane.differences([parameter, parameter_2]);
        let lines = self.lines(parameter_2, differences)?;
        let (evaluation, nearby, _) = self.shots(&lines, (start, parameter), differences)?;
        let Some(touch) = GrazingPoint::of(&evaluation) else {
            return Ok(None);
        };
        let gradients = grazing::gradients(
            touch,
            &evaluation,
            [&nearby[0], &nearby[1]],
            differences,
            (&self.scale, self.integration_tolerance()),
        )?;
        Ok(gradients.into_iter().next())
    }

    /// Returns the harvesters along the line of a second parameter, and along the one a difference
    /// beyond.
    fn lines(
        &self,
        parameter_2: f64,
        differences: [f64; 2],
    ) -> Result<[P::Line; 2], OrbitError<LineError<P>>> {
        let line = |parameter_2: f64| self.plane.line(parameter_2).map_err(OrbitError::Harvester);
        Ok([line(parameter_2)?, line(parameter_2 + differences[1])?])
    }

    /// Integrates the period at a point, and at a difference of either parameter from it; true when
    /// the derivative by the first parameter is exact.
    fn shots(
        &self,
        [line, second_shifted]: &[P::Line; 2],
        (start, parameter): (&[f64], f64),
        differences: [f64; 2],
    ) -> Result<(ShootingEvaluation, [ShootingEvaluation; 2], bool), OrbitError<LineError<P>>> {
        let shooting = self.shooting(line);
        let (evaluation, exact) = shooting.shoot(start, parameter)?;
        let (by_first, _) = shooting.shoot(start, parameter + differences[0])?;
        let (by_second, _) = self.shooting(second_shifted).shoot(start, parameter)?;
        Ok((evaluation, [by_first, by_second], exact))
    }

    /// Returns the conditions of the bifurcation with their gradients; `None` where it does not
    /// exist.
    fn conditions(
        &self,
        (unknown, parameter_2): (&[f64], f64),
        [line, second_shifted]: &[P::Line; 2],
        (evaluation, [by_first, by_second]): (&ShootingEvaluation, &[ShootingEvaluation; 2]),
        differences: [f64; 2],
    ) -> Result<Option<Vec<Gradient>>, OrbitError<LineError<P>>> {
        let n = self.parameter_index();
        let (start, parameter) = (&unknown[..n], self.parameter(unknown));
        let nearby = [by_first, by_second];
        let shifted = |by: &[f64]| {
            let start: Vec<f64> = start.iter().zip(by).map(|(u, d)| u + d).collect();
            self.shooting(line)
                .shoot(&start, parameter)
                .map(|(evaluation, _)| evaluation)
        };
        let one = match self.condition {
            Condition::Touching(touch) => {
                let touch = touch.with_unknown(unknown[n + 1]);
                let scale = (&self.scale[..], self.integration_tolerance());
                let gradients = grazing::gradients(touch, evaluation, nearby, differences, scale)?;
                return Ok(Some(gradients));
            }
            Condition::Peak => {
                self.peak((start, parameter, parameter_2), (line, second_shifted))?
            }
            condition => condition.gradient(evaluation, nearby, differences, shifted)?,
        };
        Ok(one.map(|gradient| vec![gradient]))
    }

    /// Returns the derivative of the equations by the unknown.
    fn matrix(&self, evaluation: &ShootingEvaluation, gradients: &[Gradient]) -> Mat<f64> {
        let n = self.parameter_index();
        let phase_unit = if let Condition::Touching(touch) = self.condition {
            touch.unit_cycles
        } else {
            0.0
        };
        let size = n + gradients.len();
        Mat::from_fn(size, size, |i, j| match (i < n, j) {
            (true, j) if j < n => evaluation.map()[(i, j)] - f64::from(u8::from(i == j)),
            (true, j) if j == n => self.unit * evaluation.by_parameter[i],
            (true, _) => 0.0,
            (false, j) if j < n => gradients[i - n].by_unknown[j],
            (false, j) if j == n => self.unit * gradients[i - n].by_parameters[0],
            (false, _) => phase_unit * gradients[i - n].by_phase,
        })
    }
}

impl<P: TwoParameterProblem> Problem for ExtendedProblem<'_, P> {
    type Evaluation = ExtendedEvaluation;
    type Error = OrbitError<LineError<P>>;

    fn at(&self, unknown: &[f64], parameter_2: f64) -> Result<ExtendedEvaluation, Self::Error> {
        let n = self.parameter_index();
        let (start, parameter) = (&unknown[..n], self.parameter(unknown));
        let differences = self.plane.differences([parameter, parameter_2]);
        let lines = self.lines(parameter_2, differences)?;
        let (mut evaluation, nearby, exact) =
            self.shots(&lines, (start, parameter), differences)?;
        if !exact {
            evaluation.by_parameter = nearby[0]
                .residual
                .iter()
                .zip(&evaluation.residual)
                .map(|(a, b)| (a - b) / differences[0])
                .collect();
        }
        let conditions = self.conditions(
            (unknown, parameter_2),
            &lines,
            (&evaluation, &nearby),
            differences,
        )?;
        // Without the condition no bifurcation exists: the residual stays finite under every
        // correction.
        let gradients = conditions.unwrap_or_else(|| vec![Gradient::none(n)]);
        let by_parameter = (0..n)
            .map(|i| (nearby[1].residual[i] - evaluation.residual[i]) / differences[1])
            .chain(gradients.iter().map(|gradient| gradient.by_parameters[1]))
            .collect();
        let residual = evaluation
            .residual
            .iter()
            .copied()
            .chain(gradients.iter().map(|gradient| gradient.value))
            .collect();
        let (bend, is_resonant) = (gradients[0].power_curvature, gradients[0].is_resonant);
        Ok(ExtendedEvaluation {
            power_curvature: bend,
            is_resonant,
            residual,
            matrix: self.matrix(&evaluation, &gradients),
            by_parameter,
            states: n,
            shot: evaluation,
        })
    }
}

impl ExtendedEvaluation {
    /// Returns the ratio of the smallest singular value of the equations of the orbit (by its state
    /// and the first parameter) to the next larger one. It is zero where the branch over the first
    /// parameter is a point, such as an isolated branch at its birth.
    pub fn share_of_branch(&self) -> Option<f64> {
        let equations = self.matrix.view((0, 0), (self.states, self.states + 1));
        match &jounce_linalg::singular_values(&equations.into_owned())?[..] {
            [.., next, smallest] => Some(smallest / next),
            _ => None,
        }
    }
}

impl Linearization for ExtendedEvaluation {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn bordered(
        &self,
        row: &[f64],
        corner: f64,
        right: &[f64],
        last: f64,
    ) -> Option<(Vec<f64>, f64)> {
        // The condition may be scaled freely: it takes the size of the rows above it.
        let n = row.len();
        let size = |i: usize| {
            (0..n)
                .map(|j| self.matrix[(i, j)].abs())
                .fold(f64::MIN_POSITIVE, f64::max)
        };
        let factors: Vec<f64> = (0..n)
            .map(|i| if i < self.states { 1.0 } else { 1.0 / size(i) })
            .collect();
        let matrix = Mat::from_fn(n, n, |i, j| self.matrix[(i, j)] * factors[i]);
        let column: Vec<f64> = self
            .by_parameter
            .iter()
            .enumerate()
            .map(|(i, b)| b * factors[i])
            .collect();
        let right: Vec<f64> = right
            .iter()
            .enumerate()
            .map(|(i, r)| r * factors[i])
            .collect();
        solve_bordered(&matrix, &column, (row, corner), (&right, last))
    }
}
