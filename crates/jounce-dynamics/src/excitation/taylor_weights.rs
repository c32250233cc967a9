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

/// `1 / (j + 1)!` and `(j + 1) / (j + 2)!`.
const FACTORS: [[f64; 2]; TERMS] = {
    let (mut factors, mut factorial, mut j) = ([[0.0; 2]; TERMS], 1.0, 0);
    while j < factors.len() {
        factorial *= (j + 1) as f64;
        factors[j] = [
            1.0 / factorial,
            (j + 1) as f64 / (factorial * (j + 2) as f64),
        ];
        j += 1;
    }
    factors
};

/// Returns `h, h^2, h^3, ...`, without a long chain of products.
#[inline(always)]
fn powers(h: f64) -> [f64; TERMS + 1] {
    let (two, four) = (h * h, (h * h) * (h * h));
    let eight = four * four;
    let first = [
        h,
        two,
        two * h,
        four,
        four * h,
        four * two,
        four * (two * h),
        eight,
    ];
    let factors = [1.0, eight, eight * eight];
    std::array::from_fn(|k| first[k % first.len()] * factors[k / first.len()])
}

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
        let (powers, mut weights) = (powers(length_s), [[0.0; 2]; TERMS]);
        for (j, ([first, second], factors)) in weights.iter_mut().zip(&FACTORS).enumerate() {
            (*first, *second) = (powers[j] * factors[0], powers[j + 1] * factors[1]);
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
#[inline(always)]
pub fn orders(size: f64) -> usize {
    let more = LARGEST_SIZES.iter().filter(|largest| size > **largest);
    MIN_ORDERS + more.count()
}

/// Smallest number of terms.
const MIN_ORDERS: usize = 2;

/// For each number of terms from [`MIN_ORDERS`] to one below [`LOCAL_TERMS`], the largest size for
/// which it is enough.
///
/// Term `n` of a double rate, the slowest to converge, is at most `2 (n - 1) x^(n-2) / n!` of the
/// second, which is the first in a state without a force of its own.
const LARGEST_SIZES: [f64; LOCAL_TERMS - MIN_ORDERS] = {
    let mut largest = [0.0; LOCAL_TERMS - MIN_ORDERS];
    let mut index = 0;
    while index < largest.len() {
        let orders = index + MIN_ORDERS;
        let (mut low, mut high) = (0.0, 1.0);
        let mut bisection = 0;
        while bisection < 100 {
            let middle = 0.5 * (low + high);
            if first_omitted(middle, orders) <= NEGLIGIBLE_TERM {
                low = middle;
            } else {
                high = middle;
            }
            bisection += 1;
        }
        largest[index] = low;
        index += 1;
    }
    largest
};

/// Returns the first omitted term after a number of terms.
const fn first_omitted(size: f64, orders: usize) -> f64 {
    let (mut omitted, mut n) = (2.0 / 3.0 * size, MIN_ORDERS);
    while n < orders {
        omitted *= (n + 1) as f64 * size / (n * (n + 2)) as f64;
        n += 1;
    }
    omitted
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
