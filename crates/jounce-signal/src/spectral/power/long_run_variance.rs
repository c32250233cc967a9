//! Uncertainty of the mean of a correlated series.
//!
//! The spectral density of the series at zero frequency is taken from a fitted autoregressive
//! process (Burg's recursion, the order by Schwarz's criterion):
//!
//! ```text
//! var(mean) = S(0) / M,   S(0) = s^2 / (1 + a_1 + ... + a_m)^2,   n = M var(y) / S(0)
//! ```
//!
//! with `M` values equivalent to `n` independent ones. The logarithm of `S(0)` is too low by about
//! `4 / n`, because the deviations are from the sample mean and the coefficients are fitted. Its
//! own variance is about `4 / n`, so it has `n / 2` degrees of freedom. That holds for many
//! independent values. For few, powers are also skewed, and a low mean comes with a low spread:
//! there twice the correction and `0.3 n` degrees of freedom give the nominal coverage.
//!
//! Source: J. Burg, Maximum entropy spectral analysis, Stanford (1975); C. Chatfield, The Analysis
//! of Time Series (2003), section 4.2 (bias of fitted coefficients).

use crate::spectral::student_95;

/// Maximum order of the process.
const MAX_ORDER: usize = 6;
/// Bias of the logarithm of the density at zero, times the number of independent values, as used
/// for intervals.
const BIAS_FACTOR: f64 = 4.0;
const CAUTION_FACTOR: f64 = 8.0;
/// Degrees of freedom of the density per independent value, and the minimum.
const FREEDOM_PER_VALUE: f64 = 0.3;
const MIN_FREEDOM: f64 = 2.0;
/// Number of independent values below which corrections do not grow.
const MIN_INDEPENDENT_VALUES: f64 = 3.0;
/// Share of the variance below which the residual of a process indicates a periodic series: higher
/// orders would fit the remainder of the sample mean at zero.
const PERIODIC_VARIANCE_SHARE: f64 = 1e-3;

/// Information content of a series.
pub(super) struct LongRunVariance {
    /// Number of independent values.
    pub effective_count: f64,
    /// Variance of one value.
    pub variance: f64,
    /// Half-width of the 95 % confidence interval of the mean, before skewness.
    pub half_width: f64,
}

/// Computes the uncertainty of values about their mean.
pub(super) fn long_run(values: &[f64]) -> LongRunVariance {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let deviations: Vec<f64> = values.iter().map(|x| x - mean).collect();
    let variance = deviations.iter().map(|x| x * x).sum::<f64>() / count;
    if variance <= 0.0 {
        return LongRunVariance {
            effective_count: count,
            variance,
            half_width: 0.0,
        };
    }
    let at_zero = density_at_zero(&deviations, variance);
    let independent = count * variance / at_zero;
    let corrected = |by: f64| (by / independent.max(MIN_INDEPENDENT_VALUES)).exp();
    let cautious_density = at_zero * corrected(CAUTION_FACTOR);
    let freedom = (FREEDOM_PER_VALUE * count * variance / cautious_density).max(MIN_FREEDOM);
    LongRunVariance {
        effective_count: (independent / corrected(BIAS_FACTOR)).min(count),
        variance,
        half_width: student_95(freedom) * (cautious_density / count).sqrt(),
    }
}

/// Density of the autoregressive process of optimal order.
fn density_at_zero(row: &[f64], variance: f64) -> f64 {
    let count = row.len() as f64;
    let (mut forward, mut backward) = (row.to_vec(), row.to_vec());
    let (mut coefficients, mut prediction_variance) = (vec![1.0], variance);
    let (mut least_criterion, mut result) = (count * variance.ln(), variance);
    for order in 1..=MAX_ORDER.min(row.len() / 4) {
        let pairs = || forward[1..].iter().zip(&backward);
        let (cross_sum, power_sum) = pairs().fold((0.0, 0.0), |(cross_sum, power_sum), (f, b)| {
            (cross_sum + f * b, power_sum + f * f + b * b)
        });
        if power_sum <= 0.0 {
            break;
        }
        let reflection = -2.0 * cross_sum / power_sum;
        (forward, backward) = pairs()
            .map(|(f, b)| (f + reflection * b, b + reflection * f))
            .unzip();
        coefficients.push(0.0);
        let reversed: Vec<f64> = coefficients.iter().rev().copied().collect();
        coefficients
            .iter_mut()
            .zip(reversed)
            .for_each(|(a, b)| *a += reflection * b);
        prediction_variance = (prediction_variance * (1.0 - reflection * reflection))
            .max(PERIODIC_VARIANCE_SHARE * variance);
        let criterion = count * prediction_variance.ln() + count.ln() * order as f64;
        if criterion < least_criterion {
            (least_criterion, result) = (
                criterion,
                prediction_variance / coefficients.iter().sum::<f64>().powi(2),
            );
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RandomStream;

    /// `x_k = 0.8 x_k-1 + e_k`: `n = M (1 - 0.8) / (1 + 0.8)`. Average of 200 series of 900 values,
    /// equivalent to 100: measured 99.
    #[test]
    fn effective_count_of_an_autoregressive_series_is_exact() {
        let row = |seed: u64| {
            let (mut stream, mut x) = (RandomStream::new(seed, 4), 0.0);
            let all: Vec<f64> = (0..1000)
                .map(|_| {
                    x = 0.8 * x + stream.normal_pair()[0];
                    x
                })
                .collect();
            all[100..].to_vec()
        };
        let effective_count = (0..200)
            .map(|seed| long_run(&row(seed)).effective_count)
            .sum::<f64>()
            / 200.0;
        eprintln!("worth {effective_count:.1}");
        assert!(
            (effective_count / 100.0 - 1.0).abs() < 0.1,
            "{effective_count}"
        );
    }

    #[test]
    fn a_constant_row_is_known_and_a_periodic_one_has_no_density_at_zero() {
        assert!(long_run(&[2.0; 64]).half_width == 0.0);
        let sine: Vec<f64> = (0..256).map(|k| (f64::from(k) * 0.9).sin()).collect();
        assert!(long_run(&sine).effective_count > 200.0);
    }
}
