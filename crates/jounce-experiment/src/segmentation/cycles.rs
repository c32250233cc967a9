//! Record as rows of values at equal phases of its drive, and its residual after folding.

use jounce_signal::Samples;

/// Cycles of a window, and the total number of values used, with a minimum per cycle.
const WINDOW_CYCLES: usize = 144;
const MAX_VALUES: usize = 1 << 18;
const MIN_VALUES_PER_CYCLE: usize = 8;
/// Difference of residuals that is always insignificant, relative to the RMS, and maximum ratio of
/// residuals that can be insignificant.
const EXACT_RESIDUAL_SHARE: f64 = 0.01;
const RESIDUAL_RATIO: f64 = 2.0;
/// Number of neighbours on both sides used to estimate the residual of slow noise.
const NEIGHBOUR_COUNT: usize = 3;
/// Number of batches of rows, minimum rows per batch, and Student's quantile for 15 of them that
/// noise hardly ever exceeds (2e-4 on one side).
const BATCHES: usize = 16;
const MIN_ROWS_PER_BATCH: usize = 4;
const STUDENT_QUANTILE: f64 = 4.5;
/// Record at equal phases of its drive, about its mean.
pub(super) struct Cycles {
    /// Row by row.
    values: Vec<f64>,
    /// Values per row.
    width: usize,
    /// Mean square.
    pub mean_square: f64,
}

impl Cycles {
    pub fn of(samples: &Samples<'_>, drive_hz: f64) -> Self {
        let (signal, length) = (samples.values(), samples.rate_hz() / drive_hz);
        // The cubic needs one sample before its position and two after.
        let count = (signal.len().saturating_sub(4) as f64 / length) as usize;
        let width = (length.ceil() as usize)
            .min(MAX_VALUES / count.max(1))
            .max(MIN_VALUES_PER_CYCLE);
        let at = |k: usize| {
            let position = 1.0 + k as f64 * length / width as f64;
            let index = position.floor() as usize;
            cubic(&signal[index - 1..index + 3], position.fract())
        };
        let mut values: Vec<f64> = (0..count * width).map(at).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter_mut().for_each(|x| *x -= mean);
        let mean_square = values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64;
        Self {
            values,
            width,
            mean_square,
        }
    }

    fn count(&self) -> usize {
        self.values.len() / self.width
    }

    fn row(&self, cycle: usize) -> &[f64] {
        &self.values[cycle * self.width..(cycle + 1) * self.width]
    }

    pub fn windows(&self) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let (count, windows) = (self.count(), (self.count() / WINDOW_CYCLES).max(1));
        (0..windows).map(move |k| k * count / windows..(k + 1) * count / windows)
    }

    /// Mean row of a class of cycles, and the number of cycles.
    fn class_mean(&self, class: impl Iterator<Item = usize> + Clone) -> (Vec<f64>, f64) {
        let members = class.clone().count() as f64;
        let mut mean = vec![0.0; self.width];
        class.for_each(|cycle| {
            mean.iter_mut()
                .zip(self.row(cycle))
                .for_each(|(sum, x)| *sum += x / members)
        });
        (mean, members)
    }

    /// Mean square of each row relative to its class.
    pub fn fold_residuals(&self, n: usize) -> Vec<f64> {
        let mut residuals = vec![0.0; self.count()];
        for window in self.windows() {
            for first in window.clone().take(n) {
                let class = || (first..window.end).step_by(n);
                let (class_mean, members) = self.class_mean(class());
                for cycle in class() {
                    let squared_error: f64 = self
                        .row(cycle)
                        .iter()
                        .zip(&class_mean)
                        .map(|(x, mean)| (x - mean).powi(2))
                        .sum();
                    residuals[cycle] =
                        squared_error / self.width as f64 * members / (members - 1.0);
                }
            }
        }
        residuals
    }

    /// Residual after subtracting the classes of `n` cycles.
    pub fn without_period(&self, n: usize) -> Self {
        let mut values = self.values.clone();
        for window in self.windows() {
            for first in window.clone().take(n) {
                let class = || (first..window.end).step_by(n);
                let (class_mean, _) = self.class_mean(class());
                for cycle in class() {
                    let row = &mut values[cycle * self.width..(cycle + 1) * self.width];
                    row.iter_mut()
                        .zip(&class_mean)
                        .for_each(|(x, mean)| *x -= mean);
                }
            }
        }
        Self { values, ..*self }
    }

    /// True where `n` cycles leave no less than the neighbours of `n`.
    pub fn is_smooth_at(&self, n: usize, longest_period: usize) -> bool {
        let neighbours: Vec<Vec<f64>> = (n.saturating_sub(NEIGHBOUR_COUNT)..=n + NEIGHBOUR_COUNT)
            .filter(|k| *k != n && (1..=longest_period).contains(k))
            .map(|k| self.fold_residuals(k))
            .collect();
        let mean = |row: usize| {
            neighbours.iter().map(|rows| rows[row]).sum::<f64>() / neighbours.len() as f64
        };
        let floor: Vec<f64> = (0..self.count()).map(mean).collect();
        !neighbours.is_empty()
            && FoldResidual::of(&floor)
                .fits_as_well_as(&FoldResidual::of(&self.fold_residuals(n)), self.mean_square)
    }

    pub fn mismatch(&self, n: usize) -> f64 {
        let shifted = &self.values[n * self.width..];
        let squared_difference: f64 = shifted
            .iter()
            .zip(&self.values)
            .map(|(a, b)| (a - b).powi(2))
            .sum();
        (squared_difference / shifted.len() as f64 / 2.0 / self.mean_square).sqrt()
    }
}

/// Residual of a record folded at some number of cycles.
pub(super) struct FoldResidual {
    pub mean: f64,
    /// Residual of each batch of rows.
    batches: Vec<f64>,
}

impl FoldResidual {
    pub fn of(rows: &[f64]) -> Self {
        let batches = BATCHES.min(rows.len() / MIN_ROWS_PER_BATCH).max(2);
        let mean = |rows: &[f64]| rows.iter().sum::<f64>() / rows.len() as f64;
        let boundary = |k: usize| k * rows.len() / batches;
        Self {
            mean: mean(rows),
            batches: (0..batches)
                .map(|k| mean(&rows[boundary(k)..boundary(k + 1)]))
                .collect(),
        }
    }

    /// True where the best of all leaves no less, for a record with a given mean square.
    pub fn fits_as_well_as(&self, best: &Self, mean_square: f64) -> bool {
        let count = self.batches.len() as f64;
        let differences: Vec<f64> = self
            .batches
            .iter()
            .zip(&best.batches)
            .map(|(a, b)| a - b)
            .collect();
        let mean_difference = differences.iter().sum::<f64>() / count;
        let variance = differences
            .iter()
            .map(|x| (x - mean_difference).powi(2))
            .sum::<f64>()
            / (count - 1.0);
        let excess = self.mean - best.mean;
        excess <= EXACT_RESIDUAL_SHARE.powi(2) * mean_square
            || (excess <= STUDENT_QUANTILE * (variance / count).sqrt()
                && self.mean <= RESIDUAL_RATIO * best.mean)
    }
}

/// Lagrange's cubic through four samples, between the middle two.
pub(super) fn cubic(y: &[f64], t: f64) -> f64 {
    let [a, b, c, d] = [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ];
    a * y[0] + b * y[1] + c * y[2] + d * y[3]
}
