//! Finds the optimal partition of a sequence of feature vectors into pieces, each with its own
//! mean, trend and deviation.
//!
//! The deviation of a piece is at least that between neighbouring blocks of the complete record. A
//! quieter part is therefore not a separate piece, and an irregular part remains one piece.

use jounce_core::integrate::Control;

/// Returns the starts of the pieces, in blocks. A single block between two pieces is the mixture at
/// a change, which is placed in its middle. `None` if cancelled.
pub(super) fn changes(
    features: &[Vec<f64>],
    noise: &[f64],
    cost: f64,
    control: &Control,
) -> Option<Vec<f64>> {
    let mut starts = pieces(features, noise, cost, control)?;
    starts.push(features.len());
    let mut changes = vec![0.0];
    for pair in starts.windows(2).filter(|pair| pair[0] > 0) {
        let alone = pair[1] == pair[0] + 1;
        let before = changes.last().copied().unwrap_or(0.0);
        match (alone, pair[1] == features.len()) {
            (true, true) => {}
            (true, false) => changes.push(pair[0] as f64 + 0.5),
            // The end of a single block is not a separate change.
            (false, _) if before == pair[0] as f64 - 0.5 || (pair[0] == 1 && before == 0.0) => {}
            (false, _) => changes.push(pair[0] as f64),
        }
    }
    Some(changes)
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
    fn rest(self, before: Self, (from, to): (usize, usize)) -> f64 {
        let count = (to - from) as f64;
        let (sum, middle) = (self.x - before.x, (from + to - 1) as f64 / 2.0);
        let mut rest = self.xx - before.xx - sum * sum / count;
        if to - from >= MIN_TREND_BLOCKS {
            let along = self.tx - before.tx - middle * sum;
            rest -= along * along / (count * (count * count - 1.0) / 12.0);
        }
        rest.max(0.0)
    }
}

/// First blocks of the pieces. `noise` is the minimum deviation of each feature within a piece,
/// `cost` the cost of another piece.
fn pieces(
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
    let spread = |from: usize, to: usize| {
        let length = (to - from) as f64;
        let of = |(to_here, before): (&FeatureSums, &FeatureSums)| {
            let rest = to_here.rest(*before, (from, to));
            let variance = (rest / length).max(1.0);
            length * variance.ln() + rest / variance
        };
        sums[to].iter().zip(&sums[from]).map(of).sum::<f64>()
    };
    let mut best = vec![(f64::INFINITY, 0); count + 1];
    best[0].0 = 0.0;
    for to in 1..=count {
        if control.is_stopped() {
            return None;
        }
        let total = |from: usize| best[from].0 + spread(from, to) + cost;
        let tried = (0..to).map(|from| (total(from), from));
        best[to] = tried.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, 0));
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
    let of = |k: usize| {
        let mut steps: Vec<f64> = features
            .windows(2)
            .map(|pair| (pair[1][k] - pair[0][k]).abs())
            .collect();
        let middle = steps.len() / 2;
        let median = if steps.is_empty() {
            0.0
        } else {
            *steps.select_nth_unstable_by(middle, f64::total_cmp).1
        };
        // A difference of two has sqrt 2 times the deviation; the median of a normal number's size
        // is 0.6745 of it.
        median / (0.674_489_75 * std::f64::consts::SQRT_2)
    };
    (0..width).map(of).collect()
}
