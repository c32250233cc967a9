//! Products of the spectra of force and response, averaged over blocks.

use jounce_fft::Complex;

use super::{Estimator, FrequencyResponse, LeaveOneOutResponse, WindowBias};
use crate::spectral::SpectralError;

/// Maximum number of parts of the blocks for leave-one-out estimates.
const MAX_PARTS: usize = 16;

/// Sums of spectra of blocks of equal length and rate.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumAverages {
    all: SpectrumSums,
    /// Sums over consecutive blocks, equally many in each part except the last.
    parts: Vec<SpectrumSums>,
    /// Blocks per part.
    blocks_per_part: usize,
}

/// Sums of products of spectra.
#[derive(Debug, Clone, PartialEq)]
struct SpectrumSums {
    xx: Vec<f64>,
    yy: Vec<f64>,
    xy: Vec<Complex<f64>>,
    blocks: usize,
}

impl SpectrumSums {
    fn new(lines: usize) -> Self {
        Self {
            xx: vec![0.0; lines],
            yy: vec![0.0; lines],
            xy: vec![Complex::new(0.0, 0.0); lines],
            blocks: 0,
        }
    }

    fn add(&mut self, force: &[Complex<f64>], response: &[Complex<f64>]) {
        for (k, (x, y)) in force.iter().zip(response).enumerate() {
            self.xx[k] += x.norm_sqr();
            self.yy[k] += y.norm_sqr();
            self.xy[k] += x.conj() * y;
        }
        self.blocks += 1;
    }

    /// Adds or subtracts other sums.
    fn join(&mut self, other: &Self, sign: f64) {
        for k in 0..self.xx.len() {
            self.xx[k] += sign * other.xx[k];
            self.yy[k] += sign * other.yy[k];
            self.xy[k] += other.xy[k] * sign;
        }
    }

    fn values(&self, estimator: Estimator) -> Vec<Complex<f64>> {
        (0..self.xx.len())
            .map(|k| self.value(k, estimator))
            .collect()
    }

    fn value(&self, k: usize, estimator: Estimator) -> Complex<f64> {
        let (xx, yy, yx) = (self.xx[k], self.yy[k], self.xy[k].conj());
        match estimator {
            Estimator::H1 => self.xy[k] / xx,
            Estimator::H2 => yy / yx,
            Estimator::Hv { noise_ratio } => {
                let difference = noise_ratio * xx - yy;
                (yy - noise_ratio * xx
                    + (difference.powi(2) + 4.0 * noise_ratio * yx.norm_sqr()).sqrt())
                    / (2.0 * yx)
            }
        }
    }
}

impl SpectrumAverages {
    /// Returns empty sums for spectra of `lines` lines.
    pub fn new(lines: usize) -> Self {
        Self {
            all: SpectrumSums::new(lines),
            parts: Vec::new(),
            blocks_per_part: 1,
        }
    }

    /// Adds the transforms of one block of force and response.
    ///
    /// # Errors
    /// Another number of lines.
    pub fn add(
        &mut self,
        force: &[Complex<f64>],
        response: &[Complex<f64>],
    ) -> Result<(), SpectralError> {
        let lines = self.all.xx.len();
        if force.len() != lines || response.len() != lines {
            return Err(SpectralError::Lengths {
                force: force.len(),
                response: response.len(),
            });
        }
        self.all.add(force, response);
        if self
            .parts
            .last()
            .is_none_or(|part| part.blocks == self.blocks_per_part)
        {
            if self.parts.len() == 2 * MAX_PARTS {
                self.merge_pairs();
            }
            self.parts.push(SpectrumSums::new(lines));
        }
        if let Some(part) = self.parts.last_mut() {
            part.add(force, response);
        }
        Ok(())
    }

    /// Joins consecutive parts in pairs.
    fn merge_pairs(&mut self) {
        let mut parts = std::mem::take(&mut self.parts).into_iter();
        while let Some(mut part) = parts.next() {
            if let Some(next) = parts.next() {
                part.join(&next, 1.0);
                part.blocks += next.blocks;
            }
            self.parts.push(part);
        }
        self.blocks_per_part *= 2;
    }

    /// Computes the response at frequencies `frequency_hz` for blocks with a given window bias.
    ///
    /// # Errors
    /// No block was added.
    pub fn response(
        &self,
        frequency_hz: Vec<f64>,
        estimator: Estimator,
        window_bias: WindowBias,
    ) -> Result<FrequencyResponse, SpectralError> {
        let all = &self.all;
        if all.blocks == 0 {
            return Err(SpectralError::Nothing);
        }
        let coherence = (0..all.xx.len()).map(|k| {
            let product = all.xx[k] * all.yy[k];
            if product > 0.0 {
                (all.xy[k].norm_sqr() / product).min(1.0)
            } else {
                0.0
            }
        });
        let leave_one_out = |part: &SpectrumSums| {
            let mut remaining = all.clone();
            remaining.join(part, -1.0);
            LeaveOneOutResponse {
                share: part.blocks as f64 / all.blocks as f64,
                value: remaining.values(estimator),
            }
        };
        let parts = self.parts.iter().filter(|_| self.parts.len() > 1);
        let (coherence, leave_one_out) = (coherence.collect(), parts.map(leave_one_out).collect());
        Ok(FrequencyResponse {
            frequency_hz,
            value: all.values(estimator),
            coherence,
            blocks: all.blocks,
            window_bias,
            leave_one_out,
        })
    }
}

/// Responses of several averages over the same blocks.
pub(super) fn responses(
    averages: &[SpectrumAverages],
    frequency_hz: &[f64],
    estimator: Estimator,
    window_bias: WindowBias,
) -> Result<Vec<FrequencyResponse>, SpectralError> {
    averages
        .iter()
        .map(|average| average.response(frequency_hz.to_vec(), estimator, window_bias))
        .collect()
}
