//! Weights of the Taylor series of local blocks in the integrals over a step.

use jounce_model::plant::{LOCAL_TERMS, NEGLIGIBLE_TERM};
use jounce_simd::LANES;

/// Largest number of terms: the series of a slope begins with the third.
const TERMS: usize = LOCAL_TERMS + 2;

/// `1 / j`, 0 for `j = 0`.
const INVERSES: [f64; TERMS + 2] = {
    let mut inverses = [0.0; TERMS + 2];
    let mut j = 1;
    while j < inverses.len() {
        inverses[j] = 1.0 / j as f64;
        j += 1;
    }
    inverses
};

/// For each term, its weights in `X_0` and in `X_1` (see [`super::local_blocks`]).
pub struct TaylorWeights {
    weights: [[f64; 2]; TERMS],
    count: usize,
}

impl TaylorWeights {
    /// Returns the weights for a step and blocks of at most some `|eigenvalue|`.
    #[inline(always)]
    pub fn of(fastest_rad_s: f64, length_s: f64) -> Self {
        let count = orders(fastest_rad_s * length_s) + 2;
        let (mut weights, mut power) = ([[0.0; 2]; TERMS], length_s);
        for (j, weights) in weights.iter_mut().enumerate() {
            let next = power * length_s * INVERSES[j + 2];
            *weights = [power, (j + 1) as f64 * next];
            power = next;
        }
        Self { weights, count }
    }

    /// Returns the weights of the terms that count.
    #[inline(always)]
    pub fn terms(&self) -> &[[f64; 2]] {
        &self.weights[..self.count]
    }

    /// Returns the weights of the response to impulses at times of a step.
    #[inline(always)]
    pub fn of_impulses(
        length_s: f64,
        times_s: &[f64; LANES],
        impulses: &[f64; LANES],
    ) -> [[f64; 2]; TERMS] {
        let mut weights = [[0.0; 2]; TERMS];
        for (time_s, impulse) in times_s.iter().zip(impulses) {
            let rest_s = length_s - time_s;
            let mut power = impulse * rest_s;
            for (j, [first, second]) in weights.iter_mut().enumerate() {
                let next = power * rest_s * INVERSES[j + 2];
                *first += power;
                *second += time_s * power + (j + 1) as f64 * next;
                power = next;
            }
        }
        weights
    }
}

/// Returns the number of terms after which the series is complete, for blocks whose `|eigenvalue|`
/// times the length of the step is at most `size`.
///
/// Term `n` of a double rate, the slowest to converge, is at most `2 (n - 1) x^(n-2) / n!` of the
/// second, which is the first in a state without a force of its own.
#[inline(always)]
pub fn orders(size: f64) -> usize {
    let (mut orders, mut omitted) = (2, 2.0 / 3.0 * size);
    while omitted > NEGLIGIBLE_TERM && orders < LOCAL_TERMS {
        let n = orders as f64;
        omitted *= (n + 1.0) * size / (n * (n + 2.0));
        orders += 1;
    }
    orders
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Simpson's rule with 2000 panels.
    fn simpson(of: &dyn Fn(f64) -> f64, end: f64) -> f64 {
        let step = end / 2000.0;
        (0..2000)
            .map(|k| f64::from(k) * step)
            .map(|t| step / 6.0 * (of(t) + 4.0 * of(t + 0.5 * step) + of(t + step)))
            .sum()
    }

    /// Term `j` is `t^j / j!`; that of an impulse at `t_0` is `(t - t_0)^j / j!` after it.
    #[test]
    fn weights_are_the_integrals_of_the_terms() {
        let (h, at_s, impulse) = (0.9, 0.3, 1.7);
        let weights = TaylorWeights::of(0.5, h).weights;
        let (mut times_s, mut impulses) = ([0.0; LANES], [0.0; LANES]);
        (times_s[4], impulses[4]) = (at_s, impulse);
        let of_impulse = TaylorWeights::of_impulses(h, &times_s, &impulses);
        let mut factorial = 1.0;
        for j in 0..6 {
            factorial *= f64::from(j.max(1));
            let term = |t: f64| t.powi(j) / factorial;
            let wanted = [simpson(&term, h), simpson(&|t| t * term(t), h)];
            let rest_s = h - at_s;
            let after = [
                impulse * simpson(&term, rest_s),
                impulse * simpson(&|t| (at_s + t) * term(t), rest_s),
            ];
            for m in 0..2 {
                let index = j as usize;
                assert!((weights[index][m] - wanted[m]).abs() < 1e-13, "{j} {m}");
                assert!((of_impulse[index][m] - after[m]).abs() < 1e-13, "{j} {m}");
            }
        }
    }

    #[test]
    fn the_series_ends_where_its_terms_no_longer_count() {
        let omitted = |size: f64, orders: usize| {
            let factorial: f64 = (1..=orders + 1).map(|n| n as f64).product();
            2.0 * orders as f64 * size.powi(orders as i32 - 1) / factorial
        };
        for size in [0.5, 0.2, 1e-3] {
            let count = orders(size);
            assert!(
                omitted(size, count) <= NEGLIGIBLE_TERM
                    && omitted(size, count - 1) > NEGLIGIBLE_TERM,
                "{size}: {count}"
            );
        }
        assert_eq!(orders(0.0), 2);
        assert!(orders(0.5) <= LOCAL_TERMS);
    }
}
