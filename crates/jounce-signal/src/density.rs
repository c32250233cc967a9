//! Power spectral density of a complete record.

use super::spectrum::transform;
use super::{Samples, Window};

impl Samples<'_> {
    /// Returns the one-sided power spectral density at the frequencies `k / duration`, unit^2/Hz: a
    /// periodogram.
    ///
    /// `G_k = 2 |sum_n w_n x_n e^{-2 pi i k n / N}|^2 / (rate sum_n w_n^2)`, and half this value at
    /// 0 and at half the rate. With a rectangular window the lines sum to the mean square times the
    /// duration. For a random signal the standard deviation of each line equals its mean: average
    /// over records. Source: J. S. Bendat, A. G. Piersol, Random Data, 4th ed. (2010), section
    /// 11.5.
    pub fn density(&self, window: Window) -> Vec<f64> {
        let count = self.values().len();
        let weights = window.values(count);
        let power: f64 = weights.iter().map(|w| w * w).sum();
        // A record of one or two samples is too short for a window.
        let (weights, power) = if power > 0.0 {
            (weights, power)
        } else {
            (vec![1.0; count], count as f64)
        };
        let bins = transform(
            self.values()
                .iter()
                .zip(&weights)
                .map(|(x, w)| x * w)
                .collect(),
        );
        let factor = |k: usize| if k == 0 || 2 * k == count { 1.0 } else { 2.0 };
        bins.iter()
            .enumerate()
            .map(|(k, bin)| factor(k) * bin.norm_sqr() / (self.rate_hz() * power))
            .collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::RandomStream;

    /// White noise of variance 1 at 50 Hz has the mean density 2 / 50: over 8000 lines within 3 /
    /// sqrt(8000), 3 %. Parseval with the rectangular window.
    #[test]
    fn white_numbers_have_a_flat_density() {
        let mut stream = RandomStream::new(1, 2);
        let values: Vec<f64> = (0..8000).flat_map(|_| stream.normal_pair()).collect();
        let samples = Samples::new(&values, 50.0).unwrap();
        for window in [Window::Rectangular, Window::Hann] {
            let lines = samples.density(window);
            let mean = lines.iter().sum::<f64>() / lines.len() as f64;
            assert!((mean / 0.04 - 1.0).abs() < 0.03, "{window:?}: {mean}");
        }
        let sum = samples.density(Window::Rectangular).iter().sum::<f64>() / samples.duration_s();
        assert!((sum / samples.rms().powi(2) - 1.0).abs() < 1e-12);
    }
}
