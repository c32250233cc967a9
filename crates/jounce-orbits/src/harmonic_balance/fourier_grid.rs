//! Fourier transforms between samples and harmonics of a period.

use jounce_fft::{ComplexToReal, RealToComplex};
use jounce_linalg::c64;
use std::sync::Arc;

/// Fourier transforms of one length.
#[derive(Clone)]
pub struct FourierGrid {
    /// Samples per period.
    pub samples: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
}

impl std::fmt::Debug for FourierGrid {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "Grid({})", self.samples)
    }
}

impl FourierGrid {
    /// Creates a grid with an even number of samples.
    pub fn new(samples: usize) -> Self {
        Self {
            samples,
            forward: jounce_fft::forward(samples),
            backward: jounce_fft::inverse(samples),
        }
    }

    /// Returns the coefficients `f_n`, `n = 0..=samples / 2`, of `sum_n f_n e^{i n x}` over all
    /// integers; those below zero are conjugate.
    pub fn coefficients(&self, values: &[f64]) -> Vec<c64> {
        let mut input = values.to_vec();
        let mut output = self.forward.make_output_vec();
        // The lengths come from the plan: no error is possible.
        let _ = self.forward.process(&mut input, &mut output);
        output
            .iter()
            .map(|value| *value / self.samples as f64)
            .collect()
    }

    /// Returns the values of such a sum on the grid.
    pub fn values(&self, coefficients: &[c64]) -> Vec<f64> {
        let mut input = coefficients.to_vec();
        // Both ends of the spectrum hold cosines only.
        let last = input.len() - 1;
        input[0].im = 0.0;
        input[last].im = 0.0;
        let mut output = self.backward.make_output_vec();
        let _ = self.backward.process(&mut input, &mut output);
        output
    }
}
