//! Derivatives of the results of a periodic orbit by differences of integrations, where the exact
//! ones are not known: with rectified circuits.
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

use super::{Derivative, DerivativeAccuracy, DerivativeKey, Failure};
use crate::{AnalysisError, KeyLine, Model};
use jounce_continuation::Linearization;
use jounce_dynamics::Kernel;
use jounce_orbits::{OrbitError, OrbitQuantity, Shooting, ShootingEvaluation};
use jounce_spec::NumericKey;

/// Larger one of the two steps of a difference, relative to the scale of the key.
const STEP: f64 = 2e-4;

/// Differences of integrations near an orbit.
#[derive(Clone, Copy)]
pub struct Differences<'b, 's> {
    pub base: &'b Model,
    pub shooting: &'b Shooting<'s, KeyLine<'s>>,
    pub evaluation: &'b ShootingEvaluation,
    pub quantities: &'b [OrbitQuantity],
    pub accuracy: DerivativeAccuracy,
}

impl Differences<'_, '_> {
    pub fn values(&self, evaluation: &ShootingEvaluation) -> Vec<f64> {
        self.quantities
            .iter()
            .map(|quantity| quantity.of(evaluation))
            .collect()
    }

    /// Returns the derivatives of the results by a key.
    pub fn derivatives(&self, key: DerivativeKey<'_>) -> Result<Vec<Derivative>, Failure> {
        let step = STEP * key.scale;
        let slopes = |states: &[f64], values: &dyn Fn(&ShootingEvaluation) -> Vec<f64>| {
            let half = self.slope(key.key, 0.5 * step, states, values)?;
            let whole = match self.accuracy {
                DerivativeAccuracy::Rough => half.clone(),
                DerivativeAccuracy::Estimated => self.slope(key.key, step, states, values)?,
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
