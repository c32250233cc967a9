//! Averages over the blocks of a hammer test, one for each hit.

use crate::Samples;
use jounce_fft::Complex;

use super::averages::responses;
use super::pre_trigger_check::ringing;
use super::{
    FrequencyResponse, Hit, ImpactHit, ImpactRecord, ImpactSettings, SpectrumAverages, WindowBias,
    exponential_window, force_window,
};
use crate::spectral::{Segments, SpectralError};

/// Share of a block before its hit.
const PRE_TRIGGER_SHARE: f64 = 0.01;
/// Length of the slope of the force window relative to the pulse.
const WINDOW_SLOPE_RATIO: f64 = 1.0;

/// Averages over the blocks of hits.
pub(super) struct HitBlocks<'s> {
    settings: &'s ImpactSettings,
    rate_hz: f64,
    segments: Segments,
    /// Exponential window; 1 without one.
    decay: Vec<f64>,
    /// Damping that the window adds to every mode, 1/s.
    pub window_decay_per_s: f64,
    averages: Vec<SpectrumAverages>,
    pub hits: Vec<ImpactHit>,
    /// Time from each peak to the end of its block, s.
    tails_s: Vec<f64>,
}

impl<'s> HitBlocks<'s> {
    /// Empty averages for a number of responses.
    pub fn new(
        settings: &'s ImpactSettings,
        segments: Segments,
        rate_hz: f64,
        responses: usize,
    ) -> Self {
        let length = segments.length();
        let (decay, window_decay_per_s) = match settings.end_ratio {
            Some(end_ratio) => exponential_window(length, rate_hz, end_ratio),
            None => (vec![1.0; length], 0.0),
        };
        Self {
            settings,
            rate_hz,
            segments,
            decay,
            window_decay_per_s,
            averages: vec![SpectrumAverages::new(length / 2 + 1); responses],
            hits: Vec::new(),
            tails_s: Vec::new(),
        }
    }

    /// Adds the blocks of the hits of a record.
    pub fn add(
        &mut self,
        number: usize,
        record: &ImpactRecord<'_>,
        hits: Vec<Hit>,
    ) -> Result<(), SpectralError> {
        let (length, samples) = (self.decay.len(), record.force.values().len());
        let is_full_record = hits.len() == 1 && samples == length;
        for mut hit in hits {
            let start = if is_full_record {
                0
            } else {
                hit.start
                    .saturating_sub((PRE_TRIGGER_SHARE * length as f64) as usize)
            };
            let used = start + length <= samples;
            if used {
                let tail = start + length - hit.peak;
                self.tails_s.push(tail as f64 / self.rate_hz);
                hit.warnings
                    .extend(ringing(&record.responses, (start, hit.start), length));
                self.average(record, &hit, start)?;
            }
            self.hits.push(ImpactHit {
                record: number,
                hit,
                used,
            });
        }
        Ok(())
    }

    /// Adds the transforms of the block of a hit, which starts at a sample.
    fn average(
        &mut self,
        record: &ImpactRecord<'_>,
        hit: &Hit,
        start: usize,
    ) -> Result<(), SpectralError> {
        let (segments, decay) = (&self.segments, &self.decay);
        let weights = force_weights(self.settings, hit, start, decay);
        let force = transform(segments, &record.force, start, &weights)?;
        for (average, response) in self.averages.iter_mut().zip(&record.responses) {
            average.add(&force, &transform(segments, response, start, decay)?)?;
        }
        Ok(())
    }

    /// Responses from all blocks added.
    pub fn responses(&self) -> Result<Vec<FrequencyResponse>, SpectralError> {
        let frequency_hz = self.segments.frequency_hz(self.rate_hz);
        let window_bias = WindowBias::Cut {
            length_s: self.tails_s.iter().sum::<f64>() / self.tails_s.len().max(1) as f64,
        };
        responses(
            &self.averages,
            &frequency_hz,
            self.settings.estimator,
            window_bias,
        )
    }
}

fn force_weights(settings: &ImpactSettings, hit: &Hit, start: usize, decay: &[f64]) -> Vec<f64> {
    if !settings.force_window {
        return decay.to_vec();
    }
    let slope = (WINDOW_SLOPE_RATIO * (hit.end - hit.start) as f64).ceil() as usize;
    force_window(decay.len(), hit.end - start, slope)
        .iter()
        .zip(decay)
        .map(|(a, b)| a * b)
        .collect()
}

fn transform(
    segments: &Segments,
    samples: &Samples<'_>,
    start: usize,
    weights: &[f64],
) -> Result<Vec<Complex<f64>>, SpectralError> {
    let weighted: Vec<f64> = samples.values()[start..start + weights.len()]
        .iter()
        .zip(weights)
        .map(|(x, w)| x * w)
        .collect();
    Ok(segments.transform(&Samples::new(&weighted, samples.rate_hz())?, 0, 0.0))
}
