//! Integrals of functions with sharp peaks at the ends of the interval by the double exponential
//! rule.
//!
//! ```text
//! x = (a + b) / 2 + (b - a) / 2 tanh((pi / 2) sinh t),      integral = h sum_k f(x(k h)) x'(k h)
//! ```
//!
//! Points cluster exponentially towards both ends, so a resonance of width `d` at an end costs as
//! `log(1 / d)`. The step is halved until two sums agree. Source: Takahasi and Mori, Publ. RIMS 9
//! (1974) 721.

use std::f64::consts::FRAC_PI_2;

/// Relative change between two steps at which the sum is accepted.
const QUADRATURE_TOLERANCE: f64 = 1e-11;
/// Largest number of halvings of the step.
const MAX_HALVINGS: u32 = 12;
/// Beyond this the points coincide with the ends.
const MAX_ABSCISSA: f64 = 4.0;

/// Returns the integral of `f` from `a` to `b`; `b` may be infinite where `a` is positive and `f`
/// falls at least like `1 / x^2`.
pub(super) fn integral(mut f: impl FnMut(f64) -> f64, a: f64, b: f64) -> f64 {
    if b.is_infinite() {
        // x = a / u
        return finite(
            |from_zero, _| {
                if from_zero > 0.0 {
                    f(a / from_zero) * a / (from_zero * from_zero)
                } else {
                    0.0
                }
            },
            1.0,
        );
    }
    finite(
        |from_a, from_b| {
            if from_a < from_b {
                f(a + from_a)
            } else {
                f(b - from_b)
            }
        },
        b - a,
    )
}

/// Returns the integral over an interval of this length of a function of the distances from both
/// ends, each exact near its own end.
fn finite(mut f: impl FnMut(f64, f64) -> f64, length: f64) -> f64 {
    let mut term = |t: f64| {
        let u = FRAC_PI_2 * t.sinh();
        // 1 / (1 + exp(2 u)) is the relative distance to the end.
        let (left, right) = (
            length / (1.0 + (-2.0 * u).exp()),
            length / (1.0 + (2.0 * u).exp()),
        );
        let weight = length * FRAC_PI_2 * t.cosh() / (2.0 * u.cosh() * u.cosh());
        if left > 0.0 && right > 0.0 && weight > 0.0 {
            weight * f(left, right)
        } else {
            0.0
        }
    };
    let mut step = 0.5;
    let count = (MAX_ABSCISSA / step) as i32;
    let mut sum: f64 = (-count..=count).map(|k| term(f64::from(k) * step)).sum();
    let mut before = sum * step;
    for _ in 0..MAX_HALVINGS {
        step *= 0.5;
        let count = (MAX_ABSCISSA / step) as i32;
        sum += (-count..=count)
            .filter(|k| k % 2 != 0)
            .map(|k| term(f64::from(k) * step))
            .sum::<f64>();
        let now = sum * step;
        if (now - before).abs() <= QUADRATURE_TOLERANCE * now.abs() {
            return now;
        }
        before = now;
    }
    before
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A peak of width 1e-5 at an end, its tail to infinity, and a root; measured 2e-13.
    #[test]
    fn sharp_peaks_and_tails_are_integrated() {
        let width = 1e-5_f64;
        let peak = |x: f64| width / ((x - 2.0).powi(2) + width * width);
        let exact = (1.0 / width).atan();
        assert!(
            (integral(peak, 1.0, 2.0) / exact - 1.0).abs() < 1e-10,
            "{}",
            integral(peak, 1.0, 2.0) / exact - 1.0
        );
        assert!((integral(peak, 2.0, f64::INFINITY) / FRAC_PI_2 - 1.0).abs() < 1e-10);
        assert!((integral(f64::sqrt, 0.0, 4.0) / (16.0 / 3.0) - 1.0).abs() < 1e-12);
    }
}
