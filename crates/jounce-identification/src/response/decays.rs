//! Decays of a structure, free or from correlations under noise.
//!
//! ```text
//! x_o(t)              = sum_r re (a_or exp(p_r t))        free decay of output o
//! E[x_o(t + k) x_i(t)] = sum_r re (b_oir exp(p_r k))       correlation under white noise, k > 0
//! |X(f)|^2             -> sum_r re (c_or exp(p_r k))       autocorrelation of a decay, from its amplitude spectrum alone
//! ```
//!
//! All three are sums of the same exponentials, with the poles `p_r` of the structure. Correlations
//! are unbiased, over every pair of samples whose first one lies in a block; the blocks give the
//! scatter of a correlation.
//!
//! Source: G. James, T. Carne, J. Lauffer, The natural excitation technique (NExT), Sandia
//! SAND92-1666 (1993).

use super::ResponseError;
use super::correlation::{Correlation, autocorrelation};
use jounce_data::recording::{Channel, Issue, Over, Recording};
use jounce_signal::spectral::{SpectralError, signal};

/// Decays of outputs, one for each record or for each reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Decays {
    /// Name of each output.
    pub outputs: Vec<String>,
    /// Name of each reference, or of each record.
    pub references: Vec<String>,
    /// Samples per second.
    pub rate_hz: f64,
    /// Decay of output `o` for reference `i` at `o * references + i`: samples from 0, equally many.
    pub values: Vec<Vec<f64>>,
    /// Decays from each block alone; empty for free decays and spectra.
    pub blocks: Vec<Vec<Vec<f64>>>,
    /// Data-quality issues of the recordings.
    pub issues: Vec<Issue>,
}

/// Channels of an ambient record, and the maximum lag of correlations.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AmbientSettings {
    /// Responses; empty for all channels.
    pub responses: Vec<String>,
    /// References; empty for all responses.
    pub references: Vec<String>,
    /// Maximum lag, s; by default a sixty-fourth of the record, at least 512 samples.
    pub lags_s: Option<f64>,
}

/// Number of blocks of a record.
const RECORD_BLOCKS: usize = 16;
/// Minimum number of samples of a decay.
const MIN_DECAY_SAMPLES: usize = 32;
/// Maximum lag of an autocorrelation from a spectrum, relative to the length of the original
/// record: the wrap-around error is small there.
const MAX_LAG_DIVISOR: usize = 4;

impl Decays {
    /// Free decays of the same channels of each record, between two times after its first sample;
    /// by default from the peak of the first response.
    ///
    /// # Errors
    /// No record, a channel that does not exist, unequal rates, fewer than 32 samples.
    pub fn free(
        records: &[Recording],
        responses: &[String],
        span_s: Option<(f64, f64)>,
    ) -> Result<Self, ResponseError> {
        let first = records.first().ok_or(ResponseError::Nothing)?;
        let (outputs, rate_hz) = (selected_names(first, responses)?, first.rate());
        let mut of_records = Vec::new();
        for record in records {
            if (record.rate() / rate_hz - 1.0).abs() > 1e-6 {
                return Err(SpectralError::Rates {
                    first_hz: rate_hz,
                    other_hz: record.rate(),
                }
                .into());
            }
            let channels = channels(record, &outputs)?;
            let samples = channels[0].len();
            let (from, to) = match span_s {
                Some((from_s, to_s)) => (
                    (from_s * rate_hz).round() as usize,
                    ((to_s * rate_hz).round() as usize + 1).min(samples),
                ),
                None => (largest_index(channels[0]), samples),
            };
            if from + MIN_DECAY_SAMPLES > to {
                return Err(ResponseError::Short {
                    recording: record.name.clone(),
                    samples: to.saturating_sub(from),
                    needed: MIN_DECAY_SAMPLES,
                });
            }
            of_records.push(
                channels
                    .into_iter()
                    .map(|values| values[from..to].to_vec())
                    .collect::<Vec<_>>(),
            );
        }
        let least_length = of_records.iter().flatten().map(Vec::len).min().unwrap_or(0);
        let of_output = |o: usize| {
            of_records
                .iter()
                .map(move |record| record[o][..least_length].to_vec())
        };
        Ok(Self {
            values: (0..outputs.len()).flat_map(of_output).collect(),
            references: records.iter().map(|record| record.name.clone()).collect(),
            outputs,
            rate_hz,
            blocks: Vec::new(),
            issues: record_issues(records),
        })
    }

    /// Correlations of a record under noise.
    ///
    /// # Errors
    /// A channel that does not exist, lags of more than a quarter of the record or of fewer than 32
    /// samples.
    pub fn ambient(record: &Recording, settings: &AmbientSettings) -> Result<Self, ResponseError> {
        let outputs = selected_names(record, &settings.responses)?;
        let references = if settings.references.is_empty() {
            outputs.clone()
        } else {
            selected_names(record, &settings.references)?
        };
        let (samples, rate_hz) = (record.grid.len(), record.rate());
        let lags = checked_lags(record, settings.lags_s)?;
        let output_values = centred_channels(record, &outputs)?;
        let reference_values = centred_channels(record, &references)?;
        let length = (samples - lags) / RECORD_BLOCKS;
        let pairs = || {
            output_values.iter().flat_map(|output| {
                reference_values
                    .iter()
                    .map(move |reference| (output, reference))
            })
        };
        let correlation = Correlation::new(length, lags);
        let block = |b: usize| {
            pairs()
                .map(|(output, reference)| correlation.of(output, reference, b * length))
                .collect::<Vec<_>>()
        };
        let blocks: Vec<Vec<Vec<f64>>> = (0..RECORD_BLOCKS).map(block).collect();
        let mean = |f: usize| {
            (0..=lags)
                .map(|k| blocks.iter().map(|block| block[f][k]).sum::<f64>() / RECORD_BLOCKS as f64)
                .collect()
        };
        Ok(Self {
            values: (0..outputs.len() * references.len()).map(mean).collect(),
            outputs,
            references,
            rate_hz,
            blocks,
            issues: record.issues.clone(),
        })
    }

    /// Autocorrelations from amplitude spectra over uniformly spaced frequencies that begin at 0,
    /// or a few lines above it.
    ///
    /// # Errors
    /// A channel that does not exist, a recording over time, uneven lines, too few lines.
    pub fn of_spectrum(spectrum: &Recording, responses: &[String]) -> Result<Self, ResponseError> {
        let outputs = selected_names(spectrum, responses)?;
        let (first, step_hz) = even_lines(spectrum)?;
        let lines = first + spectrum.grid.len();
        if lines < MIN_DECAY_SAMPLES * MAX_LAG_DIVISOR {
            return Err(ResponseError::Short {
                recording: spectrum.name.clone(),
                samples: lines,
                needed: MIN_DECAY_SAMPLES * MAX_LAG_DIVISOR,
            });
        }
        Ok(Self {
            values: channels(spectrum, &outputs)?
                .into_iter()
                .map(|amplitude| autocorrelation(amplitude, (first, lines), MAX_LAG_DIVISOR))
                .collect(),
            references: vec![spectrum.name.clone()],
            outputs,
            rate_hz: 2.0 * (lines - 1) as f64 * step_hz,
            blocks: Vec::new(),
            issues: spectrum.issues.clone(),
        })
    }

    /// Name of each decay.
    pub fn names(&self) -> Vec<String> {
        let names_of_output = |output: &String| {
            let name = |reference: &String| {
                if self.references.len() > 1 {
                    format!("{output} by {reference}")
                } else {
                    output.clone()
                }
            };
            self.references.iter().map(name).collect::<Vec<_>>()
        };
        self.outputs.iter().flat_map(names_of_output).collect()
    }
}

fn selected_names(
    recording: &Recording,
    requested: &[String],
) -> Result<Vec<String>, ResponseError> {
    if requested.is_empty() {
        return Ok(recording
            .channels
            .iter()
            .map(|channel| channel.name.clone())
            .collect());
    }
    requested
        .iter()
        .map(|name| Ok(recording.channel(name)?.name.clone()))
        .collect()
}

fn channels<'r>(
    recording: &'r Recording,
    names: &[String],
) -> Result<Vec<&'r [f64]>, ResponseError> {
    names
        .iter()
        .map(|name| Ok(signal(recording.channel(name)?, recording.rate())?.values()))
        .collect()
}

fn record_issues(records: &[Recording]) -> Vec<Issue> {
    records
        .iter()
        .flat_map(|record| record.issues.clone())
        .collect()
}

/// Channels about their means.
fn centred_channels(record: &Recording, names: &[String]) -> Result<Vec<Vec<f64>>, ResponseError> {
    let centred = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|x| x - mean).collect::<Vec<f64>>()
    };
    Ok(channels(record, names)?.into_iter().map(centred).collect())
}

/// Maximum lag in samples, from 32 samples to a quarter of the record.
fn checked_lags(record: &Recording, lags_s: Option<f64>) -> Result<usize, ResponseError> {
    let (samples, rate_hz) = (record.grid.len(), record.rate());
    let lags = lags_s.map_or_else(
        || default_lags(samples),
        |lags_s| (lags_s * rate_hz).round() as usize,
    );
    if lags < MIN_DECAY_SAMPLES {
        return Err(ResponseError::Short {
            recording: record.name.clone(),
            samples: lags,
            needed: MIN_DECAY_SAMPLES,
        });
    }
    if lags > samples / 4 {
        return Err(ResponseError::Lags {
            recording: record.name.clone(),
            lags_s: lags as f64 / rate_hz,
            most_s: (samples / 4) as f64 / rate_hz,
        });
    }
    Ok(lags)
}

/// Long lags add more noise than information: use a short part of the record, but enough lines.
fn default_lags(samples: usize) -> usize {
    (samples / 64).max(512).min(samples / 4)
}

/// Number of the first line of an amplitude spectrum, and the spacing of its lines (Hz), which are
/// at multiples of it.
fn even_lines(spectrum: &Recording) -> Result<(usize, f64), ResponseError> {
    let not_amplitude = |reason: &'static str| ResponseError::NotAmplitude {
        recording: spectrum.name.clone(),
        reason,
    };
    let is_complex = |channel: &Channel| channel.imaginary.is_some();
    if spectrum.over != Over::Frequency || spectrum.channels.iter().any(is_complex) {
        return Err(not_amplitude("it must contain amplitudes over frequency"));
    }
    let places = spectrum.grid.places();
    let step_hz = (places[places.len() - 1] - places[0]) / (places.len().max(2) - 1) as f64;
    let lines_below = (places[0] / step_hz).round();
    let is_irregular = |(k, frequency): (usize, &f64)| {
        ((frequency - step_hz * (lines_below + k as f64)) / step_hz).abs() > 0.05
    };
    if step_hz.is_nan()
        || step_hz <= 0.0
        || !(0.0..1e6).contains(&lines_below)
        || places.iter().enumerate().any(is_irregular)
    {
        return Err(not_amplitude(
            "its lines must be uniformly spaced, at multiples of their spacing",
        ));
    }
    Ok((lines_below as usize, step_hz))
}

fn largest_index(values: &[f64]) -> usize {
    values
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
        .map_or(0, |(k, _)| k)
}
