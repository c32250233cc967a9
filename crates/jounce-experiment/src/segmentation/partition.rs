//! Finds the optimal partition of a sequence of feature vectors into pieces, each with its own
//! mean, trend and deviation.
//!
//! The deviation of a piece is at least that between neighbouring blocks of the complete record. A
//! quieter part is therefore not a separate piece, and an irregular part remains one piece.

use jounce_control::Control;
use jounce_signal::NORMAL_QUARTILE;

/// Returns the starts of the pieces, in blocks. A single block between two pieces is the mixture at
/// a change, which is placed in its middle. `None` if cancelled.
pub(super) fn change_points(
    features: &[Vec<f64>],
    noise: &[f64],
    cost: f64,
    control: &Control,
) -> Option<Vec<f64>> {
    let mut starts = segment_starts(features, noise, cost, control)?;
    starts.push(features.len());
    let mut change_points = vec![0.0];
    for pair in starts.windows(2).filter(|pair| pair[0] > 0) {
        let is_single_block = pair[1] == pair[0] + 1;
        let previous = change_points.last().copied().unwrap_or(0.0);
        match (is_single_block, pair[1] == features.len()) {
            (true, true) => {}
            (true, false) => change_points.push(pair[0] as f64 + 0.5),
            // The end of a single block is not a separate change.
            (false, _) if previous == pair[0] as f64 - 0.5 || (pair[0] == 1 && previous == 0.0) => {
            }
            (false, _) => change_points.push(pair[0] as f64),
        }
    }
    Some(change_points)
}

/// Minimum number of blocks of a piece with a trend.
const MIN_TREND_BLOCKS: usize = 4;

/// Sums of one feature over its noise up to a block: values, values times their block, squares.
#[derive(Clone, Copy, Default)]
struct FeatureSums {
    x: f64,
    tx: f64,
    xx: f64,
}

impl FeatureSums {
    fn with(self, block: usize, x: f64) -> Self {
        Self {
            x: self.x + x,
            tx: self.tx + block as f64 * x,
            xx: self.xx + x * x,
        }
    }

    /// Residual of the squares between two blocks after a mean, and in a sufficiently long piece a
    /// trend.
    fn residual_sum(self, start_sums: Self, (from, to): (usize, usize)) -> f64 {
        let count = (to - from) as f64;
        let (sum, mean_index) = (self.x - start_sums.x, (from + to - 1) as f64 / 2.0);
        let mut residual = self.xx - start_sums.xx - sum * sum / count;
        if to - from >= MIN_TREND_BLOCKS {
            let trend = self.tx - start_sums.tx - mean_index * sum;
            residual -= trend * trend / (count * (count * count - 1.0) / 12.0);
        }
        residual.max(0.0)
    }
}

/// First blocks of the pieces. `noise` is the minimum deviation of each feature within a piece,
/// `cost` the cost of another piece.
fn segment_starts(
    features: &[Vec<f64>],
    noise: &[f64],
    cost: f64,
    control: &Control,
) -> Option<Vec<usize>> {
    let count = features.len();
    let mut sums = vec![vec![FeatureSums::default(); noise.len()]; count + 1];
    for (b, block) in features.iter().enumerate() {
        sums[b + 1] = sums[b]
            .iter()
            .zip(block.iter().zip(noise))
            .map(|(sums, (x, s))| sums.with(b, x / s))
            .collect();
    }
    let segment_cost = |from: usize, to: usize| {
        let length = (to - from) as f64;
        let feature_cost = |(end_sums, start_sums): (&FeatureSums, &FeatureSums)| {
            let residual = end_sums.residual_sum(*start_sums, (from, to));
            let variance = (residual / length).max(1.0);
            length * variance.ln() + residual / variance
        };
        sums[to]
            .iter()
            .zip(&sums[from])
            .map(feature_cost)
            .sum::<f64>()
    };
    let mut best = vec![(f64::INFINITY, 0); count + 1];
    best[0].0 = 0.0;
    for to in 1..=count {
        if control.is_stopped() {
            return None;
        }
        let total = |from: usize| best[from].0 + segment_cost(from, to) + cost;
        let candidates = (0..to).map(|from| (total(from), from));
        best[to] = candidates
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, 0));
    }
    let (mut starts, mut at) = (Vec::new(), count);
    while at > 0 {
        at = best[at].1;
        starts.push(at);
    }
    starts.reverse();
    Some(starts)
}

/// Deviation of each feature between neighbouring blocks, by the median, so that a few changes have
/// no effect.
pub(super) fn noise(features: &[Vec<f64>]) -> Vec<f64> {
    let width = features.first().map_or(0, Vec::len);
    let feature_noise = |k: usize| {
        let mut steps: Vec<f64> = features
            .windows(2)
            .map(|pair| (pair[1][k] - pair[0][k]).abs())
            .collect();
        let median_index = steps.len() / 2;
        let median = if steps.is_empty() {
            0.0
        } else {
            *steps.select_nth_unstable_by(median_index, f64::total_cmp).1
        };
        // A difference of two has sqrt 2 times the deviation; the median of a normal number's size
        // is 0.6745 of it.
        median / (NORMAL_QUARTILE * std::f64::consts::SQRT_2)
    };
    (0..width).map(feature_noise).collect()
}
