//! Lyapunov equation of a plant, solved block by block.
//!
//! ```text
//! rows      A^T P + P A = -Q        what outputs make of a state: energies
//! columns   A P + P A^T = -Q        what inputs make of the state: covariances
//! ```
//!
//! `A` has blocks of one or two states, so each pair of blocks is a dense system of at most four
//! unknowns. `Q` does not act on the displacement of a free body, so that its velocity is alone.

use crate::plant::{BlockDiagonal, BlockPair};
use jounce_linalg::Mat;
use std::f64::consts::TAU;

/// Decay of a block, relative to its rate, below which it counts as undamped.
const UNDAMPED_RATIO: f64 = 1e-14;

/// Choice of the equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LyapunovSide {
    /// `A^T P + P A = -Q`.
    Rows,
    /// `A P + P A^T = -Q`.
    Columns,
}

/// Returns `P` for the symmetric `Q` whose entries `source` gives.
///
/// # Errors
/// Returns the frequency, Hz, of an undamped block on which `Q` acts.
pub fn lyapunov(
    block: &BlockDiagonal,
    side: LyapunovSide,
    source: impl Fn(usize, usize) -> f64,
) -> Result<Mat<f64>, f64> {
    let spans = spans(block, side);
    let mut solution = Mat::zeros(block.len(), block.len());
    for first in &spans {
        for second in &spans {
            let right = Mat::from_fn(first.size, second.size, |i, j| {
                -source(first.start + i, second.start + j)
            });
            if right.amax() == 0.0 {
                continue;
            }
            let local = sylvester(first, second, &right);
            let rate = (first.decay + second.decay).abs();
            if !local.amax().is_finite()
                || rate <= UNDAMPED_RATIO * (first.speed + second.speed)
                    && first.start == second.start
            {
                return Err(first.speed / TAU);
            }
            (0..first.size).for_each(|i| {
                (0..second.size)
                    .for_each(|j| solution[(first.start + i, second.start + j)] = local[(i, j)])
            });
        }
    }
    Ok(solution)
}

/// One block: its position and its matrix, transposed for columns.
struct BlockSpan {
    start: usize,
    size: usize,
    matrix: [f64; 4],
    decay: f64,
    speed: f64,
}

fn spans(block: &BlockDiagonal, side: LyapunovSide) -> Vec<BlockSpan> {
    let transformed = |[a, b, c, d]: [f64; 4]| {
        if side == LyapunovSide::Rows {
            [a, b, c, d]
        } else {
            [a, c, b, d]
        }
    };
    let single = |(start, rate): (usize, f64)| BlockSpan {
        start,
        size: 1,
        matrix: [rate, 0.0, 0.0, 0.0],
        decay: rate,
        speed: rate.abs(),
    };
    let pairs = block.pairs.iter().enumerate().flat_map(|(k, pair)| {
        if let BlockPair::FreeBody { rate } = *pair {
            return vec![single((2 * k, 0.0)), single((2 * k + 1, rate))];
        }
        let value = pair.eigenvalue();
        vec![BlockSpan {
            start: 2 * k,
            size: 2,
            matrix: transformed(pair.matrix()),
            decay: value.re,
            speed: value.norm(),
        }]
    });
    let first = 2 * block.pairs.len();
    let reals = block.reals.iter().enumerate();
    pairs
        .chain(reals.map(|(k, rate)| single((first + k, *rate))))
        .collect()
}

/// Solves `A1^T P + P A2 = source` for blocks of size 1 or 2.
fn sylvester(first: &BlockSpan, second: &BlockSpan, source: &Mat<f64>) -> Mat<f64> {
    let (m, n) = (first.size, second.size);
    let a1 = |i: usize, j: usize| first.matrix[2 * i + j];
    let a2 = |i: usize, j: usize| second.matrix[2 * i + j];
    let system = Mat::from_fn(m * n, m * n, |row, column| {
        let ((i, j), (k, l)) = ((row / n, row % n), (column / n, column % n));
        (if j == l { a1(k, i) } else { 0.0 }) + (if i == k { a2(l, j) } else { 0.0 })
    });
    let right = Mat::from_fn(m * n, 1, |row, _| source[(row / n, row % n)]);
    let solution = jounce_linalg::solve_fully_pivoted(&system, &right);
    Mat::from_fn(m, n, |i, j| solution[(i * n + j, 0)])
}
