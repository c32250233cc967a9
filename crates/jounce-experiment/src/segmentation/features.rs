//! Features of a block of the record.

use jounce_linalg::c64;
use jounce_signal::Samples;
use std::f64::consts::TAU;

/// Drive cycles of a block: complete periods of solutions of one, two, three and six cycles.
pub(super) const CYCLES_PER_BLOCK: f64 = 6.0;
const ORDERS: [f64; 5] = [1.0 / 3.0, 0.5, 1.0, 2.0, 3.0];

/// Computes the features of the block of `count` samples from `start`: RMS about the mean, then
/// amplitudes at the orders.
pub(super) fn block_features(
    samples: &Samples<'_>,
    drive_hz: f64,
    start: usize,
    count: usize,
) -> Vec<f64> {
    let values = &samples.values()[start..start + count];
    let mean = values.iter().sum::<f64>() / count as f64;
    let mut features =
        vec![(values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count as f64).sqrt()];
    let lines = block_lines(samples, drive_hz, start, count);
    features.extend(lines.iter().map(|line| line.norm()));
    features
}

/// Computes the lines of the block of `count` samples from `start`, at the orders.
pub(super) fn block_lines(
    samples: &Samples<'_>,
    drive_hz: f64,
    start: usize,
    count: usize,
) -> Vec<c64> {
    let values = &samples.values()[start..start + count];
    let mean = values.iter().sum::<f64>() / count as f64;
    let orders = ORDERS
        .into_iter()
        .filter(|order| order * drive_hz < samples.rate_hz() / 2.0);
    orders
        .map(|order| line(values, mean, order * drive_hz / samples.rate_hz()))
        .collect()
}

/// Computes `2 / N sum (x_n - mean) exp(-2 pi i n cycles_per_sample)`: the line of a block of
/// nearly complete periods, peak.
pub(super) fn line(values: &[f64], mean: f64, cycles_per_sample: f64) -> c64 {
    // A rotation by recurrence is exact enough over one block, and fast.
    let (sin, cos) = (TAU * cycles_per_sample).sin_cos();
    let (mut c, mut s, mut re, mut im) = (1.0, 0.0, 0.0, 0.0);
    for x in values {
        re += (x - mean) * c;
        im += (x - mean) * s;
        (c, s) = (c * cos - s * sin, s * cos + c * sin);
    }
    c64::new(re, -im) * (2.0 / values.len() as f64)
}
