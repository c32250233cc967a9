//! Cuts a record into windowed, transformed segments.

use std::sync::Arc;

use crate::{Samples, Window};
use jounce_fft::Complex;
use jounce_fft::RealToComplex;

use crate::spectral::SpectralError;

/// Minimum number of samples of a segment.
pub const MIN_SEGMENT_SAMPLES: usize = 8;

/// Division of records into overlapping segments of equal length and window.
#[derive(Clone)]
pub struct Segments {
    length: usize,
    step: usize,
    weights: Vec<f64>,
    plan: Arc<dyn RealToComplex<f64>>,
}

impl std::fmt::Debug for Segments {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            to,
            "Segments {{ length: {}, step: {} }}",
            self.length, self.step
        )
    }
}

impl Segments {
    /// Returns segments of `length` samples, each `1 - overlap` of a length after the previous one.
    ///
    /// # Errors
    /// Fewer than 8 samples, an overlap outside 0 to 0.95.
    pub fn new(length: usize, overlap: f64, window: Window) -> Result<Self, SpectralError> {
        if length < MIN_SEGMENT_SAMPLES {
            return Err(SpectralError::Few { samples: length });
        }
        if !(0.0..=0.95).contains(&overlap) {
            return Err(SpectralError::Overlap { overlap });
        }
        let step = ((length as f64 * (1.0 - overlap)).round() as usize).max(1);
        Ok(Self {
            length,
            step,
            weights: window.values(length),
            plan: jounce_fft::forward(length),
        })
    }

    /// Samples of a segment.
    pub fn length(&self) -> usize {
        self.length
    }

    /// Samples from one segment to the next.
    pub fn step(&self) -> usize {
        self.step
    }

    /// Sum of the squared weights.
    pub fn power(&self) -> f64 {
        self.weights.iter().map(|w| w * w).sum()
    }

    /// Window weights of the samples of a segment.
    pub(super) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Sum of the weights.
    pub fn gain(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// First samples of the segments of a record.
    ///
    /// # Errors
    /// A record shorter than one segment.
    pub fn starts(
        &self,
        samples: usize,
    ) -> Result<impl Iterator<Item = usize> + use<>, SpectralError> {
        if samples < MIN_SEGMENT_SAMPLES {
            return Err(SpectralError::Few { samples });
        }
        if samples < self.length {
            return Err(SpectralError::Segment {
                segment: self.length,
                samples,
            });
        }
        Ok((0..=samples - self.length).step_by(self.step))
    }

    /// Transforms the segment that starts at a sample, after subtracting `mean`.
    pub fn transform(&self, samples: &Samples<'_>, start: usize, mean: f64) -> Vec<Complex<f64>> {
        let values = &samples.values()[start..start + self.length];
        let mut weighted: Vec<f64> = values
            .iter()
            .zip(&self.weights)
            .map(|(x, w)| (x - mean) * w)
            .collect();
        let mut bins = self.plan.make_output_vec();
        self.plan
            .process(&mut weighted, &mut bins)
            .expect("the plan made both buffers' lengths");
        bins
    }

    /// Frequencies of the lines at a sample rate, Hz.
    pub fn frequency_hz(&self, rate_hz: f64) -> Vec<f64> {
        (0..=self.length / 2)
            .map(|k| k as f64 * rate_hz / self.length as f64)
            .collect()
    }

    /// Largest density that rounding alone gives a line of a record whose largest magnitude is
    /// `peak`, unit^2/Hz.
    ///
    /// A sample is a double, to `u |x|`, and each of the `log2 N` stages of the transform adds at most
    /// `(1 + 4 sqrt(2)) u` of its terms. Source: N. J. Higham, Accuracy and Stability of Numerical
    /// Algorithms, 2nd ed. (2002), theorem 24.2.
    pub fn roundoff_density(&self, peak: f64, rate_hz: f64) -> f64 {
        let unit_roundoff = 0.5 * f64::EPSILON;
        let stages = (self.length as f64).log2();
        let relative = unit_roundoff * (1.0 + stages * (1.0 + 4.0 * std::f64::consts::SQRT_2));
        let line = relative * peak * self.weights.iter().map(|w| w.abs()).sum::<f64>();
        2.0 * line * line / (rate_hz * self.power())
    }

    /// 2 for lines that represent two frequencies, 1 at zero and at half the rate.
    pub fn side_count(&self, line: usize) -> f64 {
        if line == 0 || 2 * line == self.length {
            1.0
        } else {
            2.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_few_samples_are_reported_with_their_number() {
        let message = |error: SpectralError| error.to_string();
        let error_message = Segments::new(3, 0.5, Window::Hann)
            .map_err(message)
            .err()
            .unwrap_or_default();
        assert_eq!(
            error_message,
            "a segment of 3 samples is too short for a spectrum; it needs at least 8 samples: use a longer record"
        );
        let record = Segments::new(8, 0.5, Window::Hann)
            .and_then(|segments| segments.starts(3).map(Iterator::count));
        assert_eq!(record, Err(SpectralError::Few { samples: 3 }));
    }
}
