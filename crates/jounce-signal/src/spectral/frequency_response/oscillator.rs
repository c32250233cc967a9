//! Oscillator with a known frequency response, for tests.

use crate::RandomStream;
use jounce_fft::Complex;
use std::f64::consts::TAU;

/// The bilinear recursion of an oscillator is linear and time-invariant: its response is known
/// at every frequency.
pub(super) struct Oscillator {
    b: [f64; 3],
    a: [f64; 2],
}

impl Oscillator {
    pub(super) fn new(frequency_hz: f64, damping_ratio: f64, rate_hz: f64) -> Self {
        let (w, c) = (TAU * frequency_hz, 2.0 * rate_hz);
        let a0 = c * c + 2.0 * damping_ratio * w * c + w * w;
        let a = [
            (2.0 * w * w - 2.0 * c * c) / a0,
            (c * c - 2.0 * damping_ratio * w * c + w * w) / a0,
        ];
        Self {
            b: [1.0 / a0, 2.0 / a0, 1.0 / a0],
            a,
        }
    }

    pub(super) fn simulate(&self, force: &[f64]) -> Vec<f64> {
        let (mut x, mut y) = ([0.0; 2], [0.0; 2]);
        let step = |f: &f64| {
            let output = self.b[0] * f + self.b[1] * x[0] + self.b[2] * x[1]
                - self.a[0] * y[0]
                - self.a[1] * y[1];
            (x, y) = ([*f, x[0]], [output, y[0]]);
            output
        };
        force.iter().map(step).collect()
    }

    /// Displacement per force for exp(+jwt), mass 1.
    pub(super) fn exact(&self, cycles_per_sample: f64) -> Complex<f64> {
        let z = Complex::from_polar(1.0, -TAU * cycles_per_sample);
        (self.b[0] + self.b[1] * z + self.b[2] * z * z) / (1.0 + self.a[0] * z + self.a[1] * z * z)
    }
}

/// Normal noise of deviation 1.
pub(super) fn noise(count: usize, seed: u64) -> Vec<f64> {
    let mut stream = RandomStream::new(seed, 0);
    (0..count / 2).flat_map(|_| stream.normal_pair()).collect()
}
