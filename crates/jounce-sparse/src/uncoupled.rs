//! Modes of diagonal matrices, such as those of a structure in modal coordinates.

use crate::{LowestModes, SparseError, SymmetricMatrix};
use jounce_linalg::Mat;

/// Returns the lowest modes of matrices whose entries off the diagonal vanish; `None` for others.
pub(crate) fn uncoupled_modes(
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
    count: usize,
) -> Option<Result<LowestModes, SparseError>> {
    let size = mass.size();
    let is_diagonal = |matrix: &SymmetricMatrix| {
        (0..size).all(|i| matrix.row(i).all(|(j, value)| i == j || value == 0.0))
    };
    if !is_diagonal(stiffness) || !is_diagonal(mass) {
        return None;
    }
    let negative =
        |matrix: &SymmetricMatrix| (0..size).filter(|i| matrix.entry(*i, *i) < 0.0).count();
    let (of_mass, of_stiffness) = (negative(mass), negative(stiffness));
    if of_mass > 0 {
        return Some(Err(SparseError::IndefiniteMass { negative: of_mass }));
    }
    if of_stiffness > 0 {
        return Some(Err(SparseError::IndefiniteStiffness {
            negative: of_stiffness,
        }));
    }
    let has_mass = |i: &usize| mass.entry(*i, *i) > 0.0;
    let empty = (0..size).find(|i| !has_mass(i) && stiffness.entry(*i, *i) == 0.0);
    if let Some(row) = empty {
        return Some(Err(SparseError::Singular { row }));
    }
    let ratio = |i: usize| (stiffness.entry(i, i) / mass.entry(i, i), i);
    let mut lowest: Vec<(f64, usize)> = (0..size).filter(has_mass).map(ratio).collect();
    lowest.sort_by(|a, b| a.0.total_cmp(&b.0));
    if count > lowest.len() {
        return Some(Err(SparseError::TooManyModes {
            count,
            available: lowest.len(),
        }));
    }
    lowest.truncate(count);
    let mut shape = Mat::zeros(size, count);
    for (k, (_, i)) in lowest.iter().enumerate() {
        shape[(*i, k)] = mass.entry(*i, *i).sqrt().recip();
    }
    Some(Ok(LowestModes {
        eigenvalue: lowest.iter().map(|(value, _)| *value).collect(),
        shape,
        error_bound: vec![0.0; count],
        shift: 0.0,
        solves: 0,
    }))
}
