//! Quantities derived from a fitted spec, with their uncertainty.
//!
//! ```text
//! var ln y = sum_kl g_k g_l cov(x_k, x_l),   g_k = d ln y / d ln p_k
//! ```
//!
//! to first order in the keys `p_k`, whose logarithms have the covariance of the fit.

use jounce_spec::{Fault, Spec};

use super::FitResult;

/// Step in the logarithm of a key for finite differences.
const LOG_DIFFERENCE: f64 = 1e-4;

/// Quantity derived from a fitted spec.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Derived {
    /// Value.
    pub value: f64,
    /// Relative standard deviation, propagated from the keys.
    pub deviation: f64,
    /// Lower end of the 95 % confidence interval.
    pub low: f64,
    /// Upper end of the 95 % confidence interval.
    pub high: f64,
}

impl FitResult {
    /// Computes a quantity from the fitted spec with `derive`, positive, such as a power or an
    /// optimal load, and its confidence interval.
    ///
    /// # Errors
    /// Those of `derive`, and a key that cannot take a perturbed value.
    ///
    /// # Limits
    /// To first order in the keys; a further measurement of the quantity has its own noise in
    /// addition.
    pub fn derived<E: From<Fault>>(
        &self,
        fitted: &Spec,
        derive: impl Fn(&Spec) -> Result<f64, E>,
    ) -> Result<Derived, E> {
        let value = derive(fitted)?;
        let slope = |key: &super::FittedKey| {
            let value_at = |by: f64| {
                let mut spec = fitted.clone();
                spec.set_si(&key.key, key.after * by.exp())?;
                derive(&spec)
            };
            Ok(
                (value_at(LOG_DIFFERENCE)? / value_at(-LOG_DIFFERENCE)?).ln()
                    / (2.0 * LOG_DIFFERENCE),
            )
        };
        let slopes = self
            .keys
            .iter()
            .map(slope)
            .collect::<Result<Vec<f64>, E>>()?;
        let contribution = |k: usize| slopes[k] * self.keys[k].deviation;
        let each = |k: usize| {
            (0..slopes.len())
                .map(move |l| contribution(k) * contribution(l) * self.correlation[k][l])
                .sum::<f64>()
        };
        let deviation = (0..slopes.len()).map(each).sum::<f64>().max(0.0).sqrt();
        let [low, high] = [-1.0, 1.0].map(|sign| value * (sign * self.quantile * deviation).exp());
        Ok(Derived {
            value,
            deviation,
            low,
            high,
        })
    }
}
