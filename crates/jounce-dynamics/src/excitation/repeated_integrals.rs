//! Repeated integrals of a signal that is linear in time, `u + s t`.

use jounce_model::plant::{LOCAL_TERMS, NEGLIGIBLE_TERM, SignalSample};

/// Number of powers that the integrals of all orders need.
const POWERS: usize = LOCAL_TERMS + 2;

/// `1 / k!`.
const INVERSE_FACTORIALS: [f64; POWERS] = {
    let mut shares = [1.0; POWERS];
    let mut k = 1;
    while k < shares.len() {
        shares[k] = shares[k - 1] / k as f64;
        k += 1;
    }
    shares
};

/// `1 / k`, 0 for `k = 0`.
const INVERSES: [f64; POWERS + 2] = {
    let mut inverses = [0.0; POWERS + 2];
    let mut k = 1;
    while k < inverses.len() {
        inverses[k] = 1.0 / k as f64;
        k += 1;
    }
    inverses
};

/// `h^k / k!` for `k = 0, 1, ...`.
#[inline(always)]
pub fn powers(h: f64) -> [f64; POWERS] {
    let (mut powers, mut power) = ([1.0; POWERS], 1.0);
    for (out, share) in powers.iter_mut().zip(&INVERSE_FACTORIALS) {
        *out = power * share;
        power *= h;
    }
    powers
}

/// `U_k(t) = u t^k / k! + s t^(k+1) / (k+1)!`.
#[inline(always)]
pub fn repeated([u, s]: SignalSample, k: usize, t: f64) -> f64 {
    t.powi(k as i32) * INVERSE_FACTORIALS[k] * (u + s * t / (k + 1) as f64)
}

/// `U_k(h)`, and `int_0^h U_k dt` and `int_0^h U_k t dt`, from the [`powers`] of `h`; `k` is at most
/// [`LOCAL_TERMS`].
#[inline(always)]
pub fn repeated_products(
    [u, s]: SignalSample,
    powers: &[f64; POWERS],
    k: usize,
    h: f64,
) -> [f64; 3] {
    let change = s * h;
    [
        powers[k] * (u + change * INVERSES[k + 1]),
        powers[k + 1] * (u + change * INVERSES[k + 2]),
        powers[k + 1] * h * (u * (k + 1) as f64 * INVERSES[k + 2] + change * INVERSES[k + 3]),
    ]
}

/// Returns the number of terms after which both sums are complete, for blocks whose `|eigenvalue|`
/// times the length of the step is at most `size`.
///
/// Term `n` of a double rate, the slowest to converge, is at most `2 (n - 1) x^(n-2) / n!` of the
/// second, which is the first in a state without a force of its own.
#[inline(always)]
pub(super) fn orders(size: f64) -> usize {
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
    #[test]
    fn repeated_integrals_are_those_of_the_line() {
        let ([u, s], [v, z], h) = ([0.7, -1.3], [-0.4, 2.1], 0.9);
        let simpson = |f: &dyn Fn(f64) -> f64, end: f64| -> f64 {
            let panels = 2000;
            let step = end / f64::from(panels);
            (0..panels)
                .map(|k| f64::from(k) * step)
                .map(|t| step / 6.0 * (f(t) + 4.0 * f(t + 0.5 * step) + f(t + step)))
                .sum()
        };
        assert!((repeated([u, s], 1, h) - simpson(&|t| u + s * t, h)).abs() < 1e-14);
        for k in 1..5 {
            assert!(
                (repeated([u, s], k + 1, h) - simpson(&|t| repeated([u, s], k, t), h)).abs()
                    < 1e-13
            );
            let product = simpson(&|t| repeated([u, s], k, t) * (v + z * t), h);
            let [at_end, by_value, by_slope] = repeated_products([u, s], &powers(h), k, h);
            assert!((v * by_value + z * by_slope - product).abs() < 1e-13, "{k}");
            assert!((at_end - repeated([u, s], k, h)).abs() < 1e-15, "{k}");
        }
    }
}
