//! A record cut into windowed, transformed segments.

use std::sync::Arc;

use jounce::signal::{Samples, Window};
use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

use super::SpectralError;

/// How records are cut: equally long segments that overlap, each with the same weights.
#[derive(Clone)]
pub struct Segments {
    length: usize,
    step: usize,
    weights: Vec<f64>,
    plan: Arc<dyn RealToComplex<f64>>,
}

impl std::fmt::Debug for Segments {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(to, "Segments {{ length: {}, step: {} }}", self.length, self.step)
    }
}

impl Segments {
    /// Segments of `length` samples, the next one `1 - overlap` of a length later.
    ///
    /// # Errors
    /// Fewer than 8 samples, an overlap outside 0 to 0.95.
    pub fn new(length: usize, overlap: f64, window: Window) -> Result<Self, SpectralError> {
        if length < 8 {
            return Err(SpectralError::Segment { segment: length, samples: usize::MAX });
        }
        if !(0.0..=0.95).contains(&overlap) {
            return Err(SpectralError::Overlap { overlap });
        }
        let step = ((length as f64 * (1.0 - overlap)).round() as usize).max(1);
        Ok(Self { length, step, weights: window.values(length), plan: RealFftPlanner::new().plan_fft_forward(length) })
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

    /// Sum of the weights.
    pub fn gain(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// First samples of the segments of a record.
    ///
    /// # Errors
    /// A record shorter than one segment.
    pub fn starts(&self, samples: usize) -> Result<impl Iterator<Item = usize> + use<>, SpectralError> {
        if samples < self.length {
            return Err(SpectralError::Segment { segment: self.length, samples });
        }
        Ok((0..=samples - self.length).step_by(self.step))
    }

    /// The transform of the segment that starts at a sample, `mean` taken away first.
    pub fn transform(&self, samples: &Samples<'_>, start: usize, mean: f64) -> Vec<Complex<f64>> {
        let values = &samples.values()[start..start + self.length];
        let mut weighted: Vec<f64> = values.iter().zip(&self.weights).map(|(x, w)| (x - mean) * w).collect();
        let mut bins = self.plan.make_output_vec();
        self.plan.process(&mut weighted, &mut bins).expect("the plan made both buffers' lengths");
        bins
    }

    /// Frequencies of the lines at a sample rate, Hz.
    pub fn frequency_hz(&self, rate_hz: f64) -> Vec<f64> {
        (0..=self.length / 2).map(|k| k as f64 * rate_hz / self.length as f64).collect()
    }

    /// 2 for lines that stand for two frequencies, 1 at zero and at half the rate.
    pub fn sides(&self, line: usize) -> f64 {
        if line == 0 || 2 * line == self.length { 1.0 } else { 2.0 }
    }
}
