//! Weighted Birkhoff averages.
//!
//! ```text
//! WB(f) = sum_k w(k / T) f_k / sum_k w(k / T),   w(t) = exp(-1 / (t (1 - t))),   0 < t < 1
//! ```
//!
//! Over a quasi-periodic motion they converge faster than any power of the number `T` of samples;
//! over chaos they converge like its square root. The difference of the averages over two
//! successive windows distinguishes the two.
//!
//! Source: S. Das, Y. Saiki, E. Sander and J. A. Yorke, Nonlinearity 30 (2017) 4111; E. Sander and
//! J. D. Meiss, Physica D 411 (2020) 132569.

/// Returns the weighted average of samples.
pub fn weighted_average(samples: &[f64]) -> f64 {
    let count = samples.len() as f64;
    let weight = |k: usize| {
        let t = (k as f64 + 0.5) / count;
        (-1.0 / (t * (1.0 - t))).exp()
    };
    let (sum, weights) =
        samples
            .iter()
            .enumerate()
            .fold((0.0, 0.0), |(sum, weights), (k, sample)| {
                let weight_k = weight(k);
                (sum + weight_k * sample, weights + weight_k)
            });
    sum / weights
}

/// Returns the difference of the averages over the two halves of samples, relative to the standard
/// deviation of the samples; `None` where the variation is within roundoff.
pub fn half_difference(samples: &[f64]) -> Option<f64> {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    let deviation = (samples
        .iter()
        .map(|sample| (sample - mean).powi(2))
        .sum::<f64>()
        / count)
        .sqrt();
    let (first, second) = samples.split_at(samples.len() / 2);
    let difference = (weighted_average(first) - weighted_average(second)).abs();
    (deviation > 1e-9 * mean.abs()).then(|| difference / deviation)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation by the golden mean with average 1, compared with the fully chaotic logistic map
    /// with average 1/2.
    #[test]
    fn averages_over_a_rotation_converge_and_over_chaos_do_not() {
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0) * std::f64::consts::TAU;
        let rotation: Vec<f64> = (0..1024)
            .map(|k| {
                1.0 + (golden * f64::from(k)).cos() + 0.3 * (2.0 * golden * f64::from(k)).sin()
            })
            .collect();
        assert!((weighted_average(&rotation) - 1.0).abs() < 1e-12);
        assert!(half_difference(&rotation).is_some_and(|difference| difference < 1e-8));
        let chaos: Vec<f64> = std::iter::successors(Some(0.3), |x: &f64| Some(4.0 * x * (1.0 - x)))
            .take(1024)
            .collect();
        assert!(
            (weighted_average(&chaos) - 0.5).abs() < 0.05
                && half_difference(&chaos).is_some_and(|difference| difference > 1e-3)
        );
        assert!(half_difference(&[2.0; 16]).is_none());
    }
}
