//! The extended problem as a family over the second parameter.

use super::condition::{Condition, Gradient};
use super::plane::Plane;
use super::touching;
use crate::continuation::{Family, Linear};
use crate::orbit::border::solve_bordered;
use crate::orbit::{Harvester, OrbitError, Shooting, Shot};
use faer::Mat;

/// Tolerance of the marches beside that of the curve: what is zero on it is a derivative of the flow, and the slopes of Newton are
/// differences of that.
const FINER: f64 = 1e-2;

/// Least tolerance of the marches that they are made finer to.
const FINEST: f64 = 1e-12;

/// A bifurcation of orbits to be followed through a plane.
#[derive(Debug)]
pub struct Tracking<'p, P> {
    /// The harvesters.
    pub plane: &'p P,
    /// What is zero.
    pub condition: Condition,
    /// Drive cycles of the period.
    pub cycles: u32,
    /// Relative tolerance of the curve; the marches are finer.
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
    /// True where a pair on the circle has met on the real axis: tori have ended.
    pub is_resonant: bool,
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
        Shooting { harvester: line, cycles: self.cycles, tolerance: self.march_tolerance(), scale: self.scale.clone(), charged: Vec::new() }
    }

    fn march_tolerance(&self) -> f64 {
        (FINER * self.tolerance).max(FINEST).min(self.tolerance)
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
        let differences = self.plane.differences([parameter, parameter_2]);
        let line = self.plane.line(parameter_2).map_err(OrbitError::Harvester)?;
        let beside = self.plane.line(parameter_2 + differences[1]).map_err(OrbitError::Harvester)?;
        let shooting = self.shooting(&line);
        let (mut shot, exact) = shooting.shoot(start, parameter)?;
        let (ahead, _) = shooting.shoot(start, parameter + differences[0])?;
        let (aside, _) = self.shooting(&beside).shoot(start, parameter)?;
        if !exact {
            shot.by_parameter = ahead.residual.iter().zip(&shot.residual).map(|(a, b)| (a - b) / differences[0]).collect();
        }
        let moved = |by: &[f64]| {
            let start: Vec<f64> = start.iter().zip(by).map(|(u, d)| u + d).collect();
            shooting.shoot(&start, parameter).map(|(shot, _)| shot)
        };
        let found = match self.condition {
            Condition::Peak => self.peak((start, parameter, parameter_2), &line, &shot, &aside)?,
            Condition::Touching => touching::gradient(&shot, [&ahead, &aside], differences, (&self.scale, self.march_tolerance()))?,
            condition => condition.gradient(&shot, [&ahead, &aside], differences, moved)?,
        };
        // Without the condition there is no bifurcation: a residual that no correction meets.
        let gradient = found.unwrap_or_else(|| Gradient {
            value: f64::NAN,
            by_unknown: vec![0.0; n],
            by_parameters: [0.0; 2],
            bend: None,
            is_resonant: false,
        });
        let by_second = |i: usize| (aside.residual[i] - shot.residual[i]) / differences[1];
        let by_first = |i: usize| self.unit * if i < n { shot.by_parameter[i] } else { gradient.by_parameters[0] };
        let matrix = Mat::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (_, false) => by_first(i),
            (true, true) => shot.map[(i, j)] - f64::from(u8::from(i == j)),
            (false, true) => gradient.by_unknown[j],
        });
        let by_parameter = (0..=n).map(|i| if i < n { by_second(i) } else { gradient.by_parameters[1] }).collect();
        let residual = shot.residual.iter().copied().chain([gradient.value]).collect();
        Ok(Tracked { shot, bend: gradient.bend, is_resonant: gradient.is_resonant, residual, matrix, by_parameter })
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
