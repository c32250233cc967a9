//! Bias of a free decay by the blocks of a spectral estimate.
//!
//! A response function from blocks of finite length is the transform of the impulse response `h`
//! times the weight `r` of the blocks:
//!
//! ```text
//! H(w) = integral of h(t) r(t) exp(-j w t) dt,   exp(p t) becomes G(s) = integral of r(t) exp(-s t) dt,  s = j w - p
//! ```
//!
//! With one hit at the start of a block of length `T`, `r = 1` up to `T`: `G = (1 - exp(-s T)) /
//! s`. Under noise of a smooth density `r` is the correlation of the window with itself, and the
//! expectation of `S_xy / S_xx` that of `h r`. For a Hann window of length `T`, with `u = t / T`,
//!
//! ```text
//! r = (1 - u) (2 + cos 2 pi u) / 3 + sin(2 pi u) / (2 pi),   0 <= u <= 1
//! ```
//!
//! Source: J. Bendat, A. Piersol, Random Data, 4th ed. (2010), section 8.5 (bias by the window);
//! the correlation by integration of `sin^2(pi t / T) sin^2(pi (t + u T) / T)`.

use jounce_fft::Complex;
use std::f64::consts::TAU;

/// Weight of the blocks on an impulse response.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum WindowBias {
    /// No bias: the complete decay.
    #[default]
    Whole,
    /// Complete up to a time, zero beyond.
    Cut {
        /// Time from the hit to the end of its block, s.
        length_s: f64,
    },
    /// Weight of Hann windows.
    Hann {
        /// Length of a block, s.
        length_s: f64,
    },
}

/// Magnitude of `s T` below which series are used, where closed forms lose digits.
const MAX_SERIES_ARGUMENT: f64 = 0.5;
const SERIES_TERMS: u32 = 16;

impl WindowBias {
    /// `G` and its derivative by `s`, for a real part of `s` above 0.
    pub fn transform(self, s: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
        self.transform_from(s, self.end(s))
    }

    /// `exp(-s T)`, a product for a sum of arguments; 0 without window bias.
    pub fn end(self, s: Complex<f64>) -> Complex<f64> {
        match self {
            Self::Whole => Complex::new(0.0, 0.0),
            Self::Cut { length_s } | Self::Hann { length_s } => (-s * length_s).exp(),
        }
    }

    /// Computes [`WindowBias::transform`] from a known `exp(-s T)`.
    pub fn transform_from(
        self,
        s: Complex<f64>,
        end: Complex<f64>,
    ) -> (Complex<f64>, Complex<f64>) {
        match self {
            Self::Whole => {
                let inverse = s.inv();
                (inverse, -inverse * inverse)
            }
            Self::Cut { length_s } => constant(s, length_s, end),
            Self::Hann { length_s } => {
                // A full turn over the length of a block does not change the end.
                let line_shift = Complex::new(0.0, TAU / length_s);
                let linear_and_constant =
                    |s: Complex<f64>| (linear(s, length_s, end), constant(s, length_s, end));
                let (centre, (lower, one), (upper, two)) = (
                    linear(s, length_s, end),
                    linear_and_constant(s - line_shift),
                    linear_and_constant(s + line_shift),
                );
                let sine = Complex::new(0.0, -1.0 / (2.0 * TAU));
                let sum = |centre, lower, upper, one, two| {
                    centre * (2.0 / 3.0) + (lower + upper) / 6.0 + (one - two) * sine
                };
                (
                    sum(centre.0, lower.0, upper.0, one.0, two.0),
                    sum(centre.1, lower.1, upper.1, one.1, two.1),
                )
            }
        }
    }
}

/// The integral of `exp(-s t)` from 0 to `T`, and its derivative by `s`.
fn constant(s: Complex<f64>, t: f64, end: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
    if is_small(s, t) {
        return series(s, t, 1);
    }
    let inverse = s.inv();
    let value = (1.0 - end) * inverse;
    (value, (end * t - value) * inverse)
}

/// The integral of `(1 - t / T) exp(-s t)` from 0 to `T`, and its derivative by `s`.
fn linear(s: Complex<f64>, t: f64, end: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
    if is_small(s, t) {
        return series(s, t, 2);
    }
    let (inverse, decayed) = (s.inv(), 1.0 - end);
    let inverse_squared = inverse * inverse;
    (
        inverse - decayed * inverse_squared / t,
        decayed * inverse_squared * inverse * (2.0 / t) - inverse_squared - end * inverse_squared,
    )
}

fn is_small(s: Complex<f64>, t: f64) -> bool {
    s.norm_sqr() * t * t < MAX_SERIES_ARGUMENT * MAX_SERIES_ARGUMENT
}

/// `T sum (-s T)^n / (n + order)!` and its derivative.
fn series(s: Complex<f64>, t: f64, order: u32) -> (Complex<f64>, Complex<f64>) {
    let x = -s * t;
    let (mut value, mut slope) = (Complex::new(0.0, 0.0), Complex::new(0.0, 0.0));
    let mut factorial: f64 = (1..=order).map(f64::from).product();
    let (mut power, mut previous_power) = (Complex::new(1.0, 0.0), Complex::new(0.0, 0.0));
    for n in 0..SERIES_TERMS {
        value += power / factorial;
        slope += previous_power * (f64::from(n) / factorial);
        (previous_power, power) = (power, power * x);
        factorial *= f64::from(n + 1 + order);
    }
    (value * t, slope * (-t * t))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH_S: f64 = 2.0;
    const SAMPLES: usize = 4000;

    /// Autocorrelation of a Hann window, summed from its samples.
    fn hann_autocorrelation() -> Vec<f64> {
        let window: Vec<f64> = (0..=SAMPLES)
            .map(|k| {
                (std::f64::consts::PI * k as f64 / SAMPLES as f64)
                    .sin()
                    .powi(2)
            })
            .collect();
        let power: f64 = window.iter().map(|w| w * w).sum();
        (0..=SAMPLES)
            .map(|lag| {
                window[lag..]
                    .iter()
                    .zip(&window)
                    .map(|(a, b)| a * b)
                    .sum::<f64>()
                    / power
            })
            .collect()
    }

    /// Integral of `(-t)^moment r(t) exp(-s t)` by Simpson's rule.
    fn integral(kernel: &[f64], s: Complex<f64>, moment: i32) -> Complex<f64> {
        let step = LENGTH_S / SAMPLES as f64;
        let at = |k: usize| {
            (-(k as f64) * step).powi(moment) * kernel[k] * (-s * (k as f64 * step)).exp()
        };
        let weight = |k: usize| {
            if k == 0 || k == SAMPLES {
                1.0
            } else {
                2.0 + 2.0 * (k % 2) as f64
            }
        };
        (0..=SAMPLES)
            .map(|k| at(k) * weight(k))
            .sum::<Complex<f64>>()
            * (step / 3.0)
    }

    #[test]
    fn transforms_are_those_of_the_windows() {
        let length_s = LENGTH_S;
        let numbers = [
            (0.3, 0.05),
            (0.1, 4.0),
            (2.0, -30.0),
            (0.02, 3.15),
            (5.0, 0.0),
        ]
        .map(|(re, im)| Complex::new(re, im));
        for (window_bias, kernel) in [
            (WindowBias::Hann { length_s }, hann_autocorrelation()),
            (WindowBias::Cut { length_s }, vec![1.0; SAMPLES + 1]),
        ] {
            for s in numbers {
                let (value, slope) = window_bias.transform(s);
                let errors = [
                    (value - integral(&kernel, s, 0)).norm() / value.norm(),
                    (slope - integral(&kernel, s, 1)).norm() / slope.norm(),
                ];
                assert!(
                    errors[0] < 1e-6 && errors[1] < 1e-6,
                    "{window_bias:?} {s}: {errors:?}"
                );
            }
        }
    }

    #[test]
    fn series_and_closed_form_agree() {
        let length_s = LENGTH_S;
        for window_bias in [WindowBias::Hann { length_s }, WindowBias::Cut { length_s }] {
            let (below, above) = (Complex::new(0.2, 0.149_999), Complex::new(0.2, 0.150_001));
            let ((a, da), (b, db)) = (window_bias.transform(below), window_bias.transform(above));
            let slope = Complex::new(0.0, 2e-6) * da;
            assert!(
                (b - a - slope).norm() < 1e-10 && (db - da).norm() < 1e-4,
                "{window_bias:?}"
            );
        }
    }
}
