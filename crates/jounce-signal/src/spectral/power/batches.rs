//! Means of the power over consecutive batches of a record.

use std::ops::Range;

/// Voltages whose power is averaged.
pub(super) struct PowerSamples<'v> {
    pub voltage_v: &'v [f64],
    /// Voltage that is subtracted, V.
    pub offset_v: f64,
    pub resistance_ohm: f64,
}

impl PowerSamples<'_> {
    /// Mean power of consecutive samples, W.
    pub fn mean_w(&self, range: Range<usize>) -> f64 {
        let values = &self.voltage_v[range];
        values
            .iter()
            .map(|v| (v - self.offset_v).powi(2) / self.resistance_ohm)
            .sum::<f64>()
            / values.len() as f64
    }

    /// Mean powers of consecutive batches, W.
    pub fn batch_means_w(&self, batches: usize) -> Vec<f64> {
        let boundary = |k: usize| k * self.voltage_v.len() / batches;
        (0..batches)
            .map(|k| self.mean_w(boundary(k)..boundary(k + 1)))
            .collect()
    }
}
