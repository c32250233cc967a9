//! Stiffness of a fitted pulse for any exponent, and the laws of fixed exponent that a pulse
//! allows.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::problem::PulseProblem;
use super::pulse::minimised;
use super::{ContactError, PulseShape};
use jounce_signal::NORMAL_95;
use jounce_signal::spectral::Hit;

/// Contact law with a fixed exponent, fitted to the same pulse.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FixedExponentLaw {
    /// Exponent: 1 for a linear spring, 1.5 for Hertz.
    pub exponent: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Stiffness, N/m^exponent, for the mass of the hammer; `None` without a mass.
    pub stiffness: Option<f64>,
    /// Confidence interval of the stiffness, 95 %; `None` without a mass.
    pub stiffness_95: Option<(f64, f64)>,
    /// Approach velocity of the hammer, m/s; `None` without a mass.
    pub speed_m_s: Option<f64>,
    /// RMS residual of the law relative to the peak force.
    pub relative_error: f64,
}

impl FixedExponentLaw {
    /// Fits the law with a given exponent.
    pub(super) fn of(
        exponent: f64,
        (time_s, force_n): (&[f64], &[f64]),
        hit: &Hit,
        mass_kg: Option<f64>,
    ) -> Result<Self, ContactError> {
        let (problem, squared) = minimised(time_s, force_n, hit, Some(exponent))?;
        let covariance = covariance(&problem, squared)?;
        let stiffness = mass_kg.map(|mass_kg| Stiffness::of(&problem, &covariance, mass_kg));
        let [.., damping] = problem.parameters(&problem.unknowns);
        Ok(Self {
            exponent,
            restitution: PulseShape::new(exponent, damping).restitution,
            stiffness: stiffness.as_ref().map(|stiffness| stiffness.value),
            stiffness_95: stiffness.as_ref().map(Stiffness::interval_95),
            speed_m_s: mass_kg.map(|mass_kg| speed_m_s(&problem, mass_kg)),
            relative_error: relative_error(squared, time_s, hit),
        })
    }
}

/// Covariance of the scaled unknowns of a fit, estimated from the residuals.
pub(super) fn covariance(
    problem: &PulseProblem<'_>,
    squared: f64,
) -> Result<DMatrix<f64>, ContactError> {
    let j = problem.derivatives();
    let freedom = (problem.time_s.len() - problem.unknowns.len()) as f64;
    Ok((j.transpose() * &j)
        .try_inverse()
        .ok_or(ContactError::NoFit)?
        * (squared / freedom))
}

/// RMS residual of a fit relative to the peak force.
pub(super) fn relative_error(squared: f64, time_s: &[f64], hit: &Hit) -> f64 {
    (squared / time_s.len() as f64).sqrt() / hit.peak_force_n
}

/// Approach velocity of the hammer, m/s.
pub(super) fn speed_m_s(problem: &PulseProblem<'_>, mass_kg: f64) -> f64 {
    let [_, unit_s, unit_n, ..] = problem.parameters(&problem.unknowns);
    unit_n * unit_s / mass_kg
}

/// Stiffness for a given hammer mass: `ln k = n ln m + (1 - n) ln F0 - 2 n ln T0`.
pub(super) struct Stiffness {
    /// N/m^n
    pub value: f64,
    /// Standard deviation of its logarithm.
    pub relative_deviation: f64,
}

impl Stiffness {
    pub fn of(problem: &PulseProblem<'_>, covariance: &DMatrix<f64>, mass_kg: f64) -> Self {
        let [_, unit_s, unit_n, exponent, _] = problem.parameters(&problem.unknowns);
        let value =
            mass_kg.powf(exponent) * unit_n.powf(1.0 - exponent) * unit_s.powf(-2.0 * exponent);
        // Derivatives of ln k by start, unit of time, unit of force, the exponent where it is free,
        // and damping.
        let mut slope = vec![0.0, -2.0 * exponent / unit_s, (1.0 - exponent) / unit_n];
        slope.extend(
            problem
                .exponent
                .is_none()
                .then(|| (mass_kg / (unit_n * unit_s * unit_s)).ln()),
        );
        slope.push(0.0);
        let slope = DVector::from_fn(slope.len(), |k, _| slope[k] * problem.scale[k]);
        Self {
            value,
            relative_deviation: slope.dot(&(covariance * &slope)).max(0.0).sqrt(),
        }
    }

    /// Confidence interval, 95 %.
    pub fn interval_95(&self) -> (f64, f64) {
        let log_half_width = NORMAL_95 * self.relative_deviation;
        (
            self.value * (-log_half_width).exp(),
            self.value * log_half_width.exp(),
        )
    }
}
