//! Repeated integrals of a signal that is linear in time, `u + s t`.

use jounce_model::plant::{LOCAL_TERMS, SignalSample};

/// `1 / k!`.
const INVERSE_FACTORIALS: [f64; LOCAL_TERMS + 2] = {
    let mut shares = [1.0; LOCAL_TERMS + 2];
    let mut k = 1;
    while k < shares.len() {
        shares[k] = shares[k - 1] / k as f64;
        k += 1;
    }
    shares
};

/// `U_k(t) = u t^k / k! + s t^(k+1) / (k+1)!`.
#[inline(always)]
pub fn repeated([u, s]: SignalSample, k: usize, t: f64) -> f64 {
    t.powi(k as i32) * INVERSE_FACTORIALS[k] * (u + s * t / (k + 1) as f64)
}

/// `int_0^h U_k (v + z t) dt`.
#[inline(always)]
pub fn repeated_product([u, s]: SignalSample, [v, z]: SignalSample, k: usize, h: f64) -> f64 {
    let (n, share) = (k as f64, h.powi(k as i32 + 1) * INVERSE_FACTORIALS[k]);
    share
        * (u * v / (n + 1.0)
            + h * (u * z + s * v / (n + 1.0)) / (n + 2.0)
            + h * h * s * z / ((n + 1.0) * (n + 3.0)))
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
            assert!(
                (repeated_product([u, s], [v, z], k, h) - product).abs() < 1e-13,
                "{k}"
            );
        }
    }
}
