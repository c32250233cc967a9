//! Sobol indices from two independent draws `a` and `b`, and `a` with one column of `b`.
//!
//! ```text
//! first = mean(f(b) (f(mixed) - f(a))) / V,   total = mean((f(a) - f(mixed))^2) / (2 V)
//! ```
//!
//! Source: A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, table 2 (b) and (f). The
//! intervals are quantiles of resampled draws.

use jounce_signal::RandomStream;

/// Number of resamplings for an interval.
const RESAMPLES: u64 = 400;

/// Numbers of the resamplings at the ends of the 95 % interval, in order.
const ENDS: [usize; 2] = [10, 389];

/// Values of a function at the draws.
pub struct Values<'v> {
    /// At the first draw.
    pub a: &'v [f64],
    /// At the second.
    pub b: &'v [f64],
    /// At the first, with one column of the second.
    pub mixed: &'v [f64],
}

/// Index with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Index {
    /// Value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Returns the first and the total index; 0 where the function does not vary.
pub fn indices(values: &Values<'_>, seed: u64) -> [Index; 2] {
    let count = values.a.len();
    let all: Vec<usize> = (0..count).collect();
    let center = estimate(values, &all);
    let mut resampled = [Vec::new(), Vec::new()];
    for number in 0..RESAMPLES {
        let mut stream = RandomStream::new(seed, u64::MAX - number);
        let drawn: Vec<usize> = (0..count)
            .map(|_| ((stream.uniform() * count as f64) as usize).min(count - 1))
            .collect();
        let [first, total] = estimate(values, &drawn);
        resampled[0].push(first);
        resampled[1].push(total);
    }
    [0, 1].map(|k| {
        resampled[k].sort_by(f64::total_cmp);
        Index {
            value: center[k],
            low: resampled[k][ENDS[0]],
            high: resampled[k][ENDS[1]],
        }
    })
}

fn estimate(values: &Values<'_>, draws: &[usize]) -> [f64; 2] {
    let count = draws.len() as f64;
    let mean = |value: &dyn Fn(usize) -> f64| draws.iter().map(|k| value(*k)).sum::<f64>() / count;
    let Values { a, b, mixed } = values;
    let center = 0.5 * (mean(&|k| a[k]) + mean(&|k| b[k]));
    let square = |value: f64| (value - center).powi(2);
    let variance = 0.5 * (mean(&|k| square(a[k])) + mean(&|k| square(b[k])));
    if variance == 0.0 {
        return [0.0; 2];
    }
    [
        mean(&|k| (b[k] - center) * (mixed[k] - a[k])) / variance,
        0.5 * mean(&|k| (a[k] - mixed[k]).powi(2)) / variance,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::Places;
    use std::f64::consts::PI;

    /// Ishigami's function on (-pi, pi)^3 has known indices.
    #[test]
    fn indices_of_ishigami() {
        let draws = 4096;
        let ishigami = |x: &[f64]| {
            let [a, b, c] = [0, 1, 2].map(|k| PI * (2.0 * x[k] - 1.0));
            a.sin() + 7.0 * b.sin().powi(2) + 0.1 * c.powi(4) * a.sin()
        };
        let pairs = Places::new(6, 3).take(draws);
        let a: Vec<f64> = pairs.iter().map(|pair| ishigami(&pair[..3])).collect();
        let b: Vec<f64> = pairs.iter().map(|pair| ishigami(&pair[3..])).collect();
        let expected = [[0.3139, 0.5576], [0.4424, 0.4424], [0.0, 0.2437]];
        for (key, expected) in expected.iter().enumerate() {
            let mixed: Vec<f64> = pairs
                .iter()
                .map(|pair| {
                    let mut row = pair[..3].to_vec();
                    row[key] = pair[3 + key];
                    ishigami(&row)
                })
                .collect();
            let values = Values {
                a: &a,
                b: &b,
                mixed: &mixed,
            };
            for (index, expected) in indices(&values, 1).iter().zip(expected) {
                assert!(
                    (index.value - expected).abs() < 0.02,
                    "{key}: {index:?} {expected}"
                );
                assert!(
                    index.low < *expected && *expected < index.high,
                    "{key}: {index:?}"
                );
            }
        }
    }
}
