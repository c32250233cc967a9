//! Pairs of nearly equal eigenvalues with nearly parallel eigenvectors.

use super::component::PieceBlock;
use crate::plant::BlockPair;

/// Sine of the angle between two eigenvectors below which their pair is nearly defective.
const NEARLY_PARALLEL: f64 = 0.1;

/// Marks the blocks of nearly equal eigenvalues with nearly parallel eigenvectors: a mode near
/// critical damping.
///
/// The eigenvalues of the solver and their vectors solve `A T = T J` up to roundoff. A correction of
/// the eigenvalues alone adds an error of the square of the inverse sine.
pub(super) fn nearly_defective(blocks: &[PieceBlock]) -> Vec<bool> {
    let dot = |u: &[f64], v: &[f64]| -> f64 { u.iter().zip(v).map(|(u, v)| u * v).sum() };
    let square = NEARLY_PARALLEL * NEARLY_PARALLEL;
    let are_parallel = |u: &[f64], v: &[f64]| {
        let (uu, vv) = (dot(u, u), dot(v, v));
        1.0 - dot(u, v).powi(2) / (uu * vv) < square
    };
    let mut marks: Vec<bool> = blocks
        .iter()
        .map(|block| match block {
            // The vectors are `u - i v` and `u + i v`.
            PieceBlock::Pair(BlockPair::Oscillatory { .. }, [u, v]) => {
                let (uu, vv, uv) = (dot(u, u), dot(v, v), dot(u, v));
                1.0 - ((uu - vv).powi(2) + 4.0 * uv * uv) / (uu + vv).powi(2) < square
            }
            _ => false,
        })
        .collect();
    for (k, pair) in blocks.windows(2).enumerate() {
        if let [PieceBlock::Real(_, u), PieceBlock::Real(_, v)] = pair
            && are_parallel(u, v)
        {
            marks[k..k + 2].fill(true);
        }
    }
    marks
}
