//! Confidence intervals of the keys by profile likelihood.
//!
//! Where a feature depends on a key through a sum and not a product, the objective is not a
//! parabola in the logarithm of the key. An interval from the covariance then has too little
//! coverage. With `S(x)` the minimum of the objective over all other keys, with one key fixed at
//! `x`,
//!
//! ```text
//! S(low) = S(high) = S_min + q^2,
//! ```
//!
//! where `q` is the quantile; for a parabolic `S` this is the interval of the covariance. The other
//! keys follow by Gauss-Newton steps. Their derivatives start from those at the minimum and are
//! corrected at every step (Broyden's update).
//!
//! Source: D. Venzon, S. Moolgavkar, A method for computing profile-likelihood-based confidence
//! intervals, Applied Statistics 37 (1988) 87. Validation:
//! `crates/jounce-experiment/tests/fitted/coverage.rs`, and a key whose interval is known in closed
//! form below.

use nalgebra::{DMatrix, DVector};

use super::FitError;

/// Tolerance on the distance of an end from the minimum, relative to the quantile.
const END_TOLERANCE: f64 = 0.005;
/// Maximum number of steps towards an end.
const MAX_STEPS: usize = 40;
/// Maximum remaining decrease of the objective by the other keys at an end, relative to the squared
/// quantile.
const MAX_REMAINING_GAIN: f64 = 0.01;
/// Maximum change per step of the distance from the minimum.
const MAX_DISTANCE_CHANGE: f64 = 2.0;

/// Errors at a set of unknowns.
pub(super) type ErrorFunction<'p> = dyn Fn(&DVector<f64>) -> Result<DVector<f64>, FitError> + 'p;

/// Minimum whose profile is computed.
pub(super) struct Profile<'p> {
    /// Errors, relative to their deviations, at a set of unknowns.
    pub errors: &'p ErrorFunction<'p>,
    /// Unknowns at the minimum.
    pub least: &'p DVector<f64>,
    /// Errors at the minimum.
    pub at_least: &'p DVector<f64>,
    /// Sum of their squares.
    pub objective: f64,
    /// Derivatives of the errors at the minimum.
    pub derivatives: &'p DMatrix<f64>,
    /// Covariance of the unknowns at the minimum.
    pub covariance: &'p DMatrix<f64>,
}

impl Profile<'_> {
    /// Finds the end of the interval of unknown `k`, about `quantile` deviations to one side;
    /// `None` where the model cannot be evaluated that far.
    ///
    /// # Errors
    /// Cancellation.
    pub fn end(&self, k: usize, quantile: f64) -> Result<Option<f64>, FitError> {
        let mut derivatives = self.derivatives.clone();
        let distance = quantile * self.covariance[(k, k)].sqrt();
        let mut unknowns =
            self.least + self.covariance.column(k) / self.covariance[(k, k)] * distance;
        let (mut previous, mut previous_reached) = (
            ProfilePoint {
                unknowns: self.least.clone(),
                errors: self.at_least.clone(),
            },
            0.0,
        );
        for _ in 0..MAX_STEPS {
            let errors = match (self.errors)(&unknowns) {
                Ok(errors) => errors,
                Err(stopped @ FitError::Stopped { .. }) => return Err(stopped),
                Err(_) => return Ok(None),
            };
            let current = ProfilePoint { unknowns, errors };
            derivatives += self.update(&derivatives, &previous, &current);
            let Some(covariance) = (derivatives.transpose() * &derivatives).try_inverse() else {
                return Ok(None);
            };
            let nuisance = derivatives.clone().remove_column(k);
            let Some(inverse) = (nuisance.transpose() * &nuisance).try_inverse() else {
                return Ok(None);
            };
            let slope = nuisance.transpose() * &current.errors;
            let step = -inverse * &slope;
            let remaining = -slope.dot(&step);
            let reached = (current.errors.norm_squared() - remaining - self.objective)
                .max(0.0)
                .sqrt();
            let is_converged = (reached / quantile.abs() - 1.0).abs() < END_TOLERANCE
                && remaining < MAX_REMAINING_GAIN * quantile * quantile;
            if is_converged {
                return Ok(Some(current.unknowns[k]));
            }
            // Secant method, limited in step.
            let displacement = current.unknowns[k] - self.least[k];
            let inverse_slope = (displacement - (previous.unknowns[k] - self.least[k]))
                / (reached - previous_reached);
            let scale = if inverse_slope.is_finite() {
                ((displacement + (quantile.abs() - reached) * inverse_slope) / displacement)
                    .clamp(1.0 / MAX_DISTANCE_CHANGE, MAX_DISTANCE_CHANGE)
            } else {
                1.0
            };
            unknowns = &current.unknowns
                + covariance.column(k) / covariance[(k, k)] * (displacement * (scale - 1.0))
                + step.insert_row(k, 0.0);
            (previous, previous_reached) = (current, reached);
        }
        Ok(None)
    }

    /// Broyden's update: the smallest change of the derivatives, unknowns scaled by their
    /// deviations, that reproduces the errors at the end of the step.
    fn update(
        &self,
        derivatives: &DMatrix<f64>,
        from: &ProfilePoint,
        to: &ProfilePoint,
    ) -> DMatrix<f64> {
        let step_taken = &to.unknowns - &from.unknowns;
        let mismatch = &to.errors - &from.errors - derivatives * &step_taken;
        let scaled_step = step_taken.component_div(&self.covariance.diagonal());
        mismatch * scaled_step.transpose() / scaled_step.dot(&step_taken)
    }
}

/// Set of unknowns with its errors.
struct ProfilePoint {
    unknowns: DVector<f64>,
    errors: DVector<f64>,
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// One number `1 + b exp(x) + exp(y)` measured to `s`, one `exp(y)` to `t`. Without priors `y`
    /// is free to follow, and the profile of `x` is a straight line in `exp(x)`, whose interval is
    /// `exp(x0) +- q hypot(s, t) / b`.
    #[test]
    fn a_key_that_adds_to_a_feature_has_a_lopsided_interval() {
        let (b, s, t, x, y) = (0.4, 0.05, 0.08, -0.3_f64, 0.2_f64);
        let errors = |unknowns: &DVector<f64>| {
            let (first_factor, other) = (unknowns[0].exp(), unknowns[1].exp());
            Ok(DVector::from_vec(vec![
                (b * (first_factor - x.exp()) + other - y.exp()) / s,
                (other - y.exp()) / t,
            ]))
        };
        let least = DVector::from_vec(vec![x, y]);
        let derivatives =
            DMatrix::from_row_slice(2, 2, &[b * x.exp() / s, y.exp() / s, 0.0, y.exp() / t]);
        let covariance = (derivatives.transpose() * &derivatives)
            .try_inverse()
            .unwrap();
        let profile = Profile {
            errors: &errors,
            least: &least,
            at_least: &errors(&least).unwrap(),
            objective: 0.0,
            derivatives: &derivatives,
            covariance: &covariance,
        };
        for quantile in [1.96, -1.96] {
            let expected = (x.exp() + quantile * s.hypot(t) / b).ln();
            let result = profile.end(0, quantile).unwrap().unwrap();
            assert!(
                (result - expected).abs() < 0.01 * (expected - x).abs(),
                "{result} {expected}"
            );
            // The interval of the covariance is far off.
            assert!(
                (x + quantile * covariance[(0, 0)].sqrt() - expected).abs()
                    > 0.1 * (expected - x).abs()
            );
        }
    }

    #[test]
    fn a_model_that_ends_on_the_way_gives_no_end() {
        let errors = |unknowns: &DVector<f64>| {
            if unknowns[0] > 0.5 {
                Err(FitError::NotConverged { evaluations: 0 })
            } else {
                Ok(unknowns.clone())
            }
        };
        let (least, unit) = (DVector::zeros(1), DMatrix::identity(1, 1));
        let profile = Profile {
            errors: &errors,
            least: &least,
            at_least: &DVector::zeros(1),
            objective: 0.0,
            derivatives: &unit,
            covariance: &unit,
        };
        assert_eq!(profile.end(0, 2.0).unwrap(), None);
        assert!((profile.end(0, -2.0).unwrap().unwrap() + 2.0).abs() < 0.01);
    }
}
