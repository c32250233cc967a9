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

use super::student_95;

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
    pub effective: f64,
    /// Variance of one value.
    pub variance: f64,
    /// Half-width of the 95 % confidence interval of the mean, before skewness.
    pub half_width: f64,
}

/// Computes the uncertainty of values about their mean.
pub(super) fn long_run(values: &[f64]) -> LongRunVariance {
    let count = values.len() as f64;
    let middle = values.iter().sum::<f64>() / count;
    let row: Vec<f64> = values.iter().map(|x| x - middle).collect();
    let variance = row.iter().map(|x| x * x).sum::<f64>() / count;
    if variance <= 0.0 {
        return LongRunVariance {
            effective: count,
            variance,
            half_width: 0.0,
        };
    }
    let at_zero = density_at_zero(&row, variance);
    let independent = count * variance / at_zero;
    let corrected = |by: f64| (by / independent.max(MIN_INDEPENDENT_VALUES)).exp();
    let careful = at_zero * corrected(CAUTION_FACTOR);
    let freedom = (FREEDOM_PER_VALUE * count * variance / careful).max(MIN_FREEDOM);
    LongRunVariance {
        effective: (independent / corrected(BIAS_FACTOR)).min(count),
        variance,
        half_width: student_95(freedom) * (careful / count).sqrt(),
    }
}

/// Density of the autoregressive process of optimal order.
fn density_at_zero(row: &[f64], variance: f64) -> f64 {
    let count = row.len() as f64;
    let (mut forward, mut backward) = (row.to_vec(), row.to_vec());
    let (mut coefficients, mut left) = (vec![1.0], variance);
    let (mut least, mut found) = (count * variance.ln(), variance);
    for order in 1..=MAX_ORDER.min(row.len() / 4) {
        let pairs = || forward[1..].iter().zip(&backward);
        let (both, squares) = pairs().fold((0.0, 0.0), |(both, squares), (f, b)| {
            (both + f * b, squares + f * f + b * b)
        });
        if squares <= 0.0 {
            break;
        }
        let reflection = -2.0 * both / squares;
        (forward, backward) = pairs()
            .map(|(f, b)| (f + reflection * b, b + reflection * f))
            .unzip();
        coefficients.push(0.0);
        let turned: Vec<f64> = coefficients.iter().rev().copied().collect();
        coefficients
            .iter_mut()
            .zip(turned)
            .for_each(|(a, b)| *a += reflection * b);
        left = (left * (1.0 - reflection * reflection)).max(PERIODIC_VARIANCE_SHARE * variance);
        let cost = count * left.ln() + count.ln() * order as f64;
        if cost < least {
            (least, found) = (cost, left / coefficients.iter().sum::<f64>().powi(2));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_core::drive::RandomStream;

    /// `x_k = 0.8 x_k-1 + e_k`: `n = M (1 - 0.8) / (1 + 0.8)`. Average of 200 series of 900 values,
    /// equivalent to 100: measured 99.
    #[test]
    fn a_row_that_remembers_is_worth_what_its_process_says() {
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
        let worth = (0..200)
            .map(|seed| long_run(&row(seed)).effective)
            .sum::<f64>()
            / 200.0;
        eprintln!("worth {worth:.1}");
        assert!((worth / 100.0 - 1.0).abs() < 0.1, "{worth}");
    }

    #[test]
    fn a_constant_row_is_known_and_a_periodic_one_has_no_density_at_zero() {
        assert!(long_run(&[2.0; 64]).half_width == 0.0);
        let sine: Vec<f64> = (0..256).map(|k| (f64::from(k) * 0.9).sin()).collect();
        assert!(long_run(&sine).effective > 200.0);
    }
}
