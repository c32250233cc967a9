//! The extended problem as a family over the second parameter.

use super::condition::{Condition, Gradient};
use super::plane::Plane;
use super::touching;
use crate::continuation::{Family, Linear};
use crate::orbit::border::solve_bordered;
use crate::orbit::{Harvester, OrbitError, Shooting, Shot};
use faer::Mat;

/// A bifurcation of orbits to be followed through a plane.
#[derive(Debug)]
pub struct Tracking<'p, P> {
    /// The harvesters.
    pub plane: &'p P,
    /// What is zero.
    pub condition: Condition,
    /// Drive cycles of the period.
    pub cycles: u32,
    /// Relative tolerance of the march.
    pub tolerance: f64,
    /// `W` of shooting.
    pub scale: Vec<f64>,
    /// Value of the first parameter where its unknown is zero ...
    pub origin: f64,
    /// ... and the change of it that counts like a change of the state by one.
    pub unit: f64,
}

/// The extended problem at one place.
#[derive(Debug)]
pub struct Tracked {
    /// The orbit.
    pub shot: Shot,
    /// At a peak, second derivative of the power along the curve, beside the power: negative at a maximum.
    pub bend: Option<f64>,
    residual: Vec<f64>,
    /// By `u` and the unknown of the first parameter.
    matrix: Mat<f64>,
    /// By the second parameter.
    by_parameter: Vec<f64>,
}

type LineError<P> = <<P as Plane>::Line as Harvester>::Error;

impl<P: Plane> Tracking<'_, P> {
    /// Shooting along one line.
    pub fn shooting<'l>(&self, line: &'l P::Line) -> Shooting<'l, P::Line> {
        Shooting { harvester: line, cycles: self.cycles, tolerance: self.tolerance, scale: self.scale.clone(), charged: Vec::new() }
    }

    /// The first parameter of an unknown.
    pub fn parameter(&self, unknown: &[f64]) -> f64 {
        self.origin + self.unit * unknown.last().copied().unwrap_or(0.0)
    }

    /// The unknown of an orbit at a value of the first parameter.
    pub fn unknown(&self, start: &[f64], parameter: f64) -> Vec<f64> {
        start.iter().copied().chain([(parameter - self.origin) / self.unit]).collect()
    }
}

impl<P: Plane> Family for Tracking<'_, P> {
    type Local = Tracked;
    type Error = OrbitError<LineError<P>>;

    fn at(&self, unknown: &[f64], parameter_2: f64) -> Result<Tracked, Self::Error> {
        let n = unknown.len() - 1;
        let (start, parameter) = (&unknown[..n], self.parameter(unknown));
        let differences = self.plane.differences();
        let line = self.plane.line(parameter_2).map_err(OrbitError::Harvester)?;
        let beside = self.plane.line(parameter_2 + differences[1]).map_err(OrbitError::Harvester)?;
        let shooting = self.shooting(&line);
        let (shot, _) = shooting.shoot(start, parameter)?;
        let (ahead, _) = shooting.shoot(start, parameter + differences[0])?;
        let (aside, _) = self.shooting(&beside).shoot(start, parameter)?;
        let moved = |by: &[f64]| {
            let start: Vec<f64> = start.iter().zip(by).map(|(u, d)| u + d).collect();
            shooting.shoot(&start, parameter).map(|(shot, _)| shot)
        };
        let found = match self.condition {
            Condition::Peak => self.peak((start, parameter, parameter_2), &line, &shot, [&ahead, &aside])?,
            Condition::Touching => touching::gradient(&shot, [&ahead, &aside], differences, (&self.scale, self.tolerance))?,
            condition => condition.gradient(&shot, [&ahead, &aside], differences, moved)?,
        };
        // Without the condition there is no bifurcation: a residual that no correction meets.
        let gradient = found.unwrap_or_else(|| Gradient { value: f64::NAN, by_unknown: vec![0.0; n], by_parameters: [0.0; 2], bend: None });
        let difference = |other: &Shot, k: usize, i: usize| (other.residual[i] - shot.residual[i]) / differences[k];
        let by_first = |i: usize| self.unit * if i < n { difference(&ahead, 0, i) } else { gradient.by_parameters[0] };
        let matrix = Mat::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (_, false) => by_first(i),
            (true, true) => shot.map[(i, j)] - f64::from(u8::from(i == j)),
            (false, true) => gradient.by_unknown[j],
        });
        let by_parameter = (0..=n).map(|i| if i < n { difference(&aside, 1, i) } else { gradient.by_parameters[1] }).collect();
        let residual = shot.residual.iter().copied().chain([gradient.value]).collect();
        Ok(Tracked { shot, bend: gradient.bend, residual, matrix, by_parameter })
    }
}

impl Linear for Tracked {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn bordered(&self, row: &[f64], corner: f64, right: &[f64], last: f64) -> Option<(Vec<f64>, f64)> {
        // Any multiple of the condition is the same condition: it takes the size of the rows above it.
        let n = row.len();
        let size = (0..n).map(|j| self.matrix[(n - 1, j)].abs()).fold(f64::MIN_POSITIVE, f64::max);
        let factor = |i: usize| if i + 1 < n { 1.0 } else { 1.0 / size };
        let matrix = Mat::from_fn(n, n, |i, j| self.matrix[(i, j)] * factor(i));
        let column: Vec<f64> = self.by_parameter.iter().enumerate().map(|(i, b)| b * factor(i)).collect();
        let right: Vec<f64> = right.iter().enumerate().map(|(i, r)| r * factor(i)).collect();
        solve_bordered(&matrix, &column, (row, corner), (&right, last))
    }
}
