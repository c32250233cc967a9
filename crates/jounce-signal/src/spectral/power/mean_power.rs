//! Mean power with a confidence interval that accounts for correlation.
//!
//! The power record is divided into 16 batches; the interval is Student's over their means (batch
//! means, Law and Kelton). It is valid if a batch is much longer than the correlation time of the
//! power. If neighbouring batches are still correlated, 8 longer ones are used; if these are too, a
//! flag is set.
//!
//! A correlation time comparable to the record length does not appear in the correlation of few
//! batches. The number of independent values is therefore estimated from the autoregressive process
//! fitted to 256 consecutive means (or to the samples if there are fewer). Below 128 independent
//! values, the wider of the two intervals is used. Below 12, the interval is rough and a flag is
//! set. A power that is low by chance also has a small spread, so that an interval proportional to
//! the mean would be as wide above it as below. The mean of the square of a normal voltage is
//! distributed as `chi^2 / n`. With the relative half-width `h = 1.96 sqrt(2 / n)` of the symmetric
//! interval, the upper end of the one for its expectation is, in the cube-root form of that
//! distribution (Wilson and Hilferty),
//!
//! ```text
//! mean / (1 - h / 3 - h^2 / (9 1.96^2))^3 = mean (1 + h + (2/3 + 1 / (3 1.96^2)) h^2 + ..)
//! ```
//!
//! The interval is widened to reach that far on both sides, in proportion where `h` is above one:
//! then there are fewer than eight independent values, and the series is invalid.
//!
//! A coupling capacitor blocks the mean of the voltage, so the mean may be retained or subtracted.

use crate::Samples;
use serde::Serialize;

use super::batches::PowerSamples;
use super::long_run_variance::long_run;
use crate::spectral::SpectralError;

/// Mean power with its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeanPower {
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Half-width of its 95 % confidence interval, W.
    pub half_width_w: f64,
    /// Batches used for the interval.
    pub batches: usize,
    /// Correlation between consecutive batches: near 0 for a valid interval.
    pub batch_correlation: f64,
    /// Number of independent values in the record, 256 at most.
    pub effective_samples: f64,
    /// True for fewer than 12 independent values or correlated batches: the record is too short,
    /// and the interval may be too narrow.
    pub correlated: bool,
    /// Mean of the voltage over the record, V.
    pub mean_voltage_v: f64,
}

/// Numbers of batches, each with the quantile of Student's distribution for a two-sided interval of
/// 95 % (Abramowitz and Stegun, table 26.10).
const BATCHES: [(usize, f64); 2] = [(16, 2.131_450), (8, 2.364_624)];
/// Number of means for the correlation time, and the minimum number of independent values of an
/// interval.
const MEMORY_MEANS: usize = 256;
const MIN_INDEPENDENT_VALUES: f64 = 12.0;
/// Number of independent values above which batch means suffice.
const MANY_INDEPENDENT_VALUES: f64 = 128.0;
/// Coefficient of the squared relative half-width in its increase: `2/3 + 1 / (3 1.96^2)`.
const SKEW_FACTOR: f64 = 0.753_4;
const POWER_ROUNDOFF: f64 = 1e-9;
/// Minimum number of samples of a batch.
const MIN_BATCH_SAMPLES: usize = 4;
/// Significance limit of the correlation of neighbours, in standard deviations (1/sqrt of their
/// number): 5 % on one side.
const SIGNIFICANT_DEVIATIONS: f64 = 1.645;

/// Computes the mean power of a voltage across a resistance, `mean(v^2) / R`, with the mean voltage
/// subtracted first if `remove_mean`.
///
/// # Errors
/// A record too short for batches.
pub fn mean_power(
    voltage: &Samples<'_>,
    resistance_ohm: f64,
    remove_mean: bool,
) -> Result<MeanPower, SpectralError> {
    let mean_voltage_v = voltage.mean();
    let samples = voltage.values();
    let too_short = SpectralError::Short {
        samples: samples.len(),
        needed: BATCHES[0].0 * MIN_BATCH_SAMPLES,
    };
    if samples.len() < BATCHES[0].0 * MIN_BATCH_SAMPLES {
        return Err(too_short);
    }
    let power = PowerSamples {
        voltage_v: samples,
        offset_v: if remove_mean { mean_voltage_v } else { 0.0 },
        resistance_ohm,
    };
    let mean_power_w = power.mean_w(0..samples.len());
    let with_batches = |(batches, quantile): (usize, f64)| {
        let means = power.batch_means_w(batches);
        let (batch_mean, count) = (mean(&means), batches as f64);
        let variance = means.iter().map(|x| (x - batch_mean).powi(2)).sum::<f64>() / (count - 1.0);
        let batch_correlation = correlation(&means);
        MeanPower {
            mean_power_w,
            half_width_w: quantile * (variance / count).sqrt(),
            batches,
            batch_correlation,
            effective_samples: MEMORY_MEANS as f64,
            // Means that differ only by roundoff are from a periodic record, and their correlation
            // is meaningless.
            correlated: batch_correlation > SIGNIFICANT_DEVIATIONS / count.sqrt()
                && variance > (POWER_ROUNDOFF * batch_mean).powi(2),
            mean_voltage_v,
        }
    };
    let candidates = BATCHES.map(with_batches);
    let result = candidates
        .into_iter()
        .find(|result| !result.correlated)
        .or(candidates.last().copied())
        .ok_or(too_short)?;
    Ok(with_memory(result, &power))
}

/// Widens the interval of batch means where the record has few independent values.
fn with_memory(result: MeanPower, power: &PowerSamples<'_>) -> MeanPower {
    let count = MEMORY_MEANS.min(power.voltage_v.len());
    let long_run_variance = long_run(&power.batch_means_w(count));
    let effective_samples = long_run_variance.effective_count;
    if effective_samples >= MANY_INDEPENDENT_VALUES
        || long_run_variance.variance <= (POWER_ROUNDOFF * result.mean_power_w).powi(2)
    {
        return MeanPower {
            effective_samples,
            ..result
        };
    }
    let relative = long_run_variance.half_width / result.mean_power_w;
    let half_width_w = long_run_variance.half_width * (1.0 + SKEW_FACTOR * relative.min(1.0));
    MeanPower {
        effective_samples,
        half_width_w: result.half_width_w.max(half_width_w),
        correlated: result.correlated || effective_samples < MIN_INDEPENDENT_VALUES,
        ..result
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Correlation between consecutive values.
fn correlation(values: &[f64]) -> f64 {
    let mean = mean(values);
    let variance: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    let lag_product: f64 = values
        .windows(2)
        .map(|pair| (pair[0] - mean) * (pair[1] - mean))
        .sum();
    if variance > 0.0 {
        lag_product / variance
    } else {
        0.0
    }
}

/// Computes the mean power of a part of a record; `None` if it is too short for an interval.
///
/// # Errors
/// Those of [`mean_power`] except for a record too short.
pub fn mean_power_if_long(
    samples: &Samples<'_>,
    resistance_ohm: f64,
    remove_mean: bool,
) -> Result<Option<MeanPower>, SpectralError> {
    match mean_power(samples, resistance_ohm, remove_mean) {
        Err(SpectralError::Short { .. }) => Ok(None),
        result => result.map(Some),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
