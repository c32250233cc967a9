//! Correlations by the fast Fourier transform.

use jounce_fft::{Complex, ComplexToReal, RealToComplex};
use std::sync::Arc;

/// Correlations of blocks of one length, by FFT.
pub(super) struct Correlation {
    length: usize,
    lags: usize,
    padded: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

impl Correlation {
    pub fn new(length: usize, lags: usize) -> Self {
        let padded = (length + lags + 1).next_power_of_two();
        Self {
            length,
            lags,
            padded,
            forward: jounce_fft::forward(padded),
            inverse: jounce_fft::inverse(padded),
        }
    }

    /// Computes `sum_t output(t + k) reference(t) / length` for `t` in the block that starts at a
    /// sample.
    pub fn of(&self, output: &[f64], reference: &[f64], start: usize) -> Vec<f64> {
        let transform = |values: &[f64]| {
            let mut padded = values.to_vec();
            padded.resize(self.padded, 0.0);
            let mut bins = self.forward.make_output_vec();
            self.forward
                .process(&mut padded, &mut bins)
                .expect("the plan made the length");
            bins
        };
        let (x, y) = (
            transform(&reference[start..start + self.length]),
            transform(&output[start..start + self.length + self.lags]),
        );
        let mut bins: Vec<Complex<f64>> = x.iter().zip(&y).map(|(x, y)| x.conj() * y).collect();
        let last = bins.len() - 1;
        (bins[0].im, bins[last].im) = (0.0, 0.0);
        let mut values = self.inverse.make_output_vec();
        self.inverse
            .process(&mut bins, &mut values)
            .expect("the plan made the length");
        values[..=self.lags]
            .iter()
            .map(|sum| sum / (self.padded as f64 * self.length as f64))
            .collect()
    }
}

/// Autocorrelation of a decay from its amplitude spectrum, up to the length of the original record
/// over `max_lag_divisor`. The first amplitude is at line `first`, of `lines` lines from 0.
pub(super) fn autocorrelation(
    amplitude: &[f64],
    (first, lines): (usize, usize),
    max_lag_divisor: usize,
) -> Vec<f64> {
    let mut bins = vec![Complex::new(0.0, 0.0); lines];
    bins[first..]
        .iter_mut()
        .zip(amplitude)
        .skip(usize::from(first == 0))
        .for_each(|(bin, a)| bin.re = a * a);
    let length = 2 * (lines - 1);
    let plan = jounce_fft::inverse(length);
    let mut values = plan.make_output_vec();
    plan.process(&mut bins, &mut values)
        .expect("the plan made the length, and the bins are real");
    values.truncate(length / max_lag_divisor + 1);
    values
}
