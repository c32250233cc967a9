//! Derivatives of the results of a periodic orbit with respect to keys of the spec.
//!
//! An orbit is a zero of `R(u, p) = P(u, p) - u`, with the map `P` over its period. A result `w(u,
//! p)` on the orbit has the derivative
//!
//! ```text
//! du/dp = -(dR/du)^-1 dR/dp,     dw/dp = d/dt w(u + t du/dp, p + t)
//! ```
//!
//! `dR/du` is the exact derivative of the flow. The derivatives along `p` and along the curve of
//! orbits are central differences of integrations over one period, at two steps, extrapolated. The
//! error of a derivative is estimated by the difference of the two.
//!
//! Source: the implicit function theorem; the extrapolation is Richardson's.

use super::{AnalysisError, KeyLine, Model};
use jounce_continuation::Linearization;
use jounce_dynamics::Kernel;
use jounce_orbits::{Orbit, OrbitError, OrbitQuantity, Shooting, ShootingEvaluation};
use jounce_spec::NumericKey;
use rayon::prelude::*;

/// Tolerance of the integrations: their error, divided by the step, is the error of a difference.
const TOLERANCE: f64 = 1e-12;

/// Tolerance of derivatives that only guide a search.
const ROUGH_TOLERANCE: f64 = 1e-10;

/// Larger one of the two steps of a difference, relative to the scale of the key.
const STEP: f64 = 2e-4;

/// Derivative of a result with respect to a key, with its estimated error, in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Derivative {
    /// Value.
    pub value: f64,
    /// Estimated error.
    pub error: f64,
}

/// A key whose derivatives are wanted.
#[derive(Debug, Clone, Copy)]
pub struct DerivativeKey<'k> {
    /// The key.
    pub key: &'k NumericKey,
    /// Size of a change over which results change noticeably, SI: the value, or the width of its
    /// range.
    pub scale: f64,
}

/// Accuracy of derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DerivativeAccuracy {
    /// One step, without an estimate of the error: for a search.
    Rough,
    /// Two steps, extrapolated.
    Extrapolated,
}

/// Results of an orbit with their derivatives.
#[derive(Debug)]
pub struct OrbitDerivatives {
    /// Results, SI.
    pub values: Vec<f64>,
    /// Derivatives of the results, per key; an error where a model with a changed key cannot be
    /// built or integrated.
    pub by_key: Vec<Result<Vec<Derivative>, OrbitError<AnalysisError>>>,
}

type Failure = OrbitError<AnalysisError>;

/// Returns results of an orbit of a model, and their derivatives.
///
/// # Errors
/// The integration of the orbit fails.
pub fn orbit_derivatives(
    base: &Model,
    orbit: &Orbit,
    keys: &[DerivativeKey<'_>],
    quantities: &[OrbitQuantity],
    accuracy: DerivativeAccuracy,
) -> Result<OrbitDerivatives, Failure> {
    let line = KeyLine::at(base);
    let tolerance = match accuracy {
        DerivativeAccuracy::Rough => ROUGH_TOLERANCE,
        DerivativeAccuracy::Extrapolated => TOLERANCE,
    };
    let shooting = Shooting::new(&line, &base.kernel, orbit.period_cycles, tolerance);
    let (evaluation, _) = shooting.shoot(orbit.start(), 0.0)?;
    let differences = Differences {
        base,
        shooting: &shooting,
        evaluation: &evaluation,
        quantities,
        accuracy,
    };
    let derivatives = |key: &DerivativeKey<'_>| differences.derivatives(*key);
    Ok(OrbitDerivatives {
        values: differences.values(&evaluation),
        by_key: keys.par_iter().map(derivatives).collect(),
    })
}

/// Differences of integrations near an orbit.
#[derive(Clone, Copy)]
struct Differences<'b, 's> {
    base: &'b Model,
    shooting: &'b Shooting<'s, KeyLine<'s>>,
    evaluation: &'b ShootingEvaluation,
    quantities: &'b [OrbitQuantity],
    accuracy: DerivativeAccuracy,
}

impl Differences<'_, '_> {
    fn values(&self, evaluation: &ShootingEvaluation) -> Vec<f64> {
        self.quantities
            .iter()
            .map(|quantity| quantity.of(evaluation))
            .collect()
    }

    /// Returns the derivatives of the results by a key.
    fn derivatives(&self, key: DerivativeKey<'_>) -> Result<Vec<Derivative>, Failure> {
        let step = STEP * key.scale;
        let slopes = |states: &[f64], values: &dyn Fn(&ShootingEvaluation) -> Vec<f64>| {
            let half = self.slope(key.key, 0.5 * step, states, values)?;
            let whole = match self.accuracy {
                DerivativeAccuracy::Rough => half.clone(),
                DerivativeAccuracy::Extrapolated => self.slope(key.key, step, states, values)?,
            };
            Ok::<_, Failure>(extrapolated(&whole, &half))
        };
        let fixed = vec![0.0; self.shooting.scale.len()];
        let residual = slopes(&fixed, &|at| at.residual().to_vec())?;
        let right: Vec<f64> = residual.iter().map(|slope| -slope.value).collect();
        let solved = self.evaluation.bordered(&fixed, 1.0, &right, 0.0);
        let (states, _) = solved.ok_or(OrbitError::Multipliers {
            frequency_hz: 1.0 / self.evaluation.period_s,
        })?;
        slopes(&states, &|at| self.values(at))
    }

    /// Returns the central differences of some values for a step of a key, while the state changes
    /// at a rate. Where the spec allows no value on one side, they are one-sided, of the same order.
    fn slope(
        &self,
        key: &NumericKey,
        step: f64,
        states: &[f64],
        values: &dyn Fn(&ShootingEvaluation) -> Vec<f64>,
    ) -> Result<Vec<f64>, Failure> {
        let at = |step: f64| -> Result<Vec<f64>, Failure> {
            let unknown: Vec<f64> = self.evaluation.strobe_states[0]
                .iter()
                .zip(states)
                .map(|(u, rate)| u + step * rate)
                .collect();
            let kernel = self.kernel(key, step).map_err(OrbitError::Harvester)?;
            Ok(values(&self.shooting.integrated(kernel, &unknown)?))
        };
        let inward = |step: f64| {
            // f' = (-3 f(0) + 4 f(h) - f(2 h)) / (2 h) + O(h^2)
            let [here, near, far] = [at(0.0)?, at(step)?, at(2.0 * step)?];
            let slope = |k: usize| (4.0 * near[k] - 3.0 * here[k] - far[k]) / (2.0 * step);
            Ok((0..here.len()).map(slope).collect())
        };
        let (above, below) = match (at(step), at(-step)) {
            (Err(OrbitError::Harvester(_)), Ok(_)) => return inward(-step),
            (Ok(_), Err(OrbitError::Harvester(_))) => return inward(step),
            (above, below) => (above?, below?),
        };
        let difference = |(a, b): (&f64, &f64)| (a - b) / (2.0 * step);
        Ok(above.iter().zip(&below).map(difference).collect())
    }

    fn kernel(&self, key: &NumericKey, step: f64) -> Result<Kernel, AnalysisError> {
        let mut spec = self.base.spec.clone();
        let value = key.get(&spec)?;
        key.set(&mut spec, value + step)?;
        Ok(self.base.changed(spec)?.kernel)
    }
}

/// Returns the limits of differences whose errors fall with the square of the step, from a step and
/// its half.
fn extrapolated(whole: &[f64], half: &[f64]) -> Vec<Derivative> {
    let limit = |(whole, half): (&f64, &f64)| Derivative {
        value: half + (half - whole) / 3.0,
        error: (half - whole).abs() / 3.0,
    };
    whole.iter().zip(half).map(limit).collect()
}
