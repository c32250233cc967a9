//! The best partition of a row of feature vectors into pieces of constant mean.

use jounce::march::Watch;

/// Where the pieces begin, in blocks. One block alone between two pieces is the mixture at a change: the change is put in its middle.
/// None where the watch stops it.
pub(super) fn changes(features: &[Vec<f64>], noise: &[f64], cost: f64, watch: &Watch) -> Option<Vec<f64>> {
    let mut starts = pieces(features, noise, cost, watch)?;
    starts.push(features.len());
    let mut changes = vec![0.0];
    for pair in starts.windows(2).filter(|pair| pair[0] > 0) {
        let alone = pair[1] == pair[0] + 1;
        let before = changes.last().copied().unwrap_or(0.0);
        match (alone, pair[1] == features.len()) {
            (true, true) => {}
            (true, false) => changes.push(pair[0] as f64 + 0.5),
            // The end of a block alone is no change of its own.
            (false, _) if before == pair[0] as f64 - 0.5 || (pair[0] == 1 && before == 0.0) => {}
            (false, _) => changes.push(pair[0] as f64),
        }
    }
    Some(changes)
}

/// First blocks of the pieces. `noise` is the deviation of each feature within a piece, `cost` what a piece more costs.
fn pieces(features: &[Vec<f64>], noise: &[f64], cost: f64, watch: &Watch) -> Option<Vec<usize>> {
    let count = features.len();
    let width = noise.len();
    // Sums and squared sums up to each block, of features over their noise.
    let mut sums = vec![vec![0.0; width]; count + 1];
    let mut squares = vec![0.0; count + 1];
    for (b, block) in features.iter().enumerate() {
        let scaled: Vec<f64> = block.iter().zip(noise).map(|(x, s)| x / s).collect();
        sums[b + 1] = sums[b].iter().zip(&scaled).map(|(sum, x)| sum + x).collect();
        squares[b + 1] = squares[b] + scaled.iter().map(|x| x * x).sum::<f64>();
    }
    let spread = |from: usize, to: usize| {
        let mean = sums[to].iter().zip(&sums[from]).map(|(b, a)| (b - a).powi(2)).sum::<f64>() / (to - from) as f64;
        squares[to] - squares[from] - mean
    };
    let mut best = vec![(f64::INFINITY, 0); count + 1];
    best[0].0 = 0.0;
    for to in 1..=count {
        if watch.is_stopped() {
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

/// Deviation of each feature between neighbouring blocks, by the median, so that a few changes do not count.
pub(super) fn noise(features: &[Vec<f64>]) -> Vec<f64> {
    let width = features.first().map_or(0, Vec::len);
    let of = |k: usize| {
        let mut steps: Vec<f64> = features.windows(2).map(|pair| (pair[1][k] - pair[0][k]).abs()).collect();
        let middle = steps.len() / 2;
        let median = if steps.is_empty() { 0.0 } else { *steps.select_nth_unstable_by(middle, f64::total_cmp).1 };
        // A difference of two has sqrt 2 times the deviation; the median of a normal number's size is 0.6745 of it.
        median / (0.674_489_75 * std::f64::consts::SQRT_2)
    };
    (0..width).map(of).collect()
}
