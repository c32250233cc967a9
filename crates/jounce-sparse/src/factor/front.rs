//! Elimination of the first columns of a dense symmetric matrix.

use jounce_linalg::{Mat, column, column_mut, subtract_lower_product};

/// Columns that are eliminated before the columns to their right change.
const PANEL: usize = 32;

/// A pivot smaller than this share of its column before elimination is roundoff.
const MIN_PIVOT_RATIO: f64 = 1e-15;

/// Eliminates the first `columns` columns of a symmetric matrix of which only the lower triangle is
/// used: `A = L D L^T` on them and the Schur complement on the others.
///
/// The columns then hold `L` below the diagonal. Returns the pivots `D`, or the first column whose
/// pivot vanishes. `scales` holds the magnitude of each diagonal entry before any elimination.
pub(super) fn eliminate(
    front: &mut Mat<f64>,
    columns: usize,
    scales: &[f64],
) -> Result<Vec<f64>, usize> {
    let rows = front.nrows();
    let mut pivots = Vec::with_capacity(columns);
    for start in (0..columns).step_by(PANEL) {
        let end = columns.min(start + PANEL);
        for j in start..end {
            let pivot = front[(j, j)];
            if !pivot.is_finite() || pivot.abs() <= MIN_PIVOT_RATIO * scales[j] {
                return Err(j);
            }
            pivots.push(pivot);
            column_mut(front, j)[j + 1..]
                .iter_mut()
                .for_each(|entry| *entry /= pivot);
            for k in j + 1..end {
                let factor = front[(k, j)] * pivot;
                subtract_scaled_column(front, j, k, factor);
            }
        }
        if end < rows {
            let left = Mat::from_fn(rows - end, end - start, |i, j| front[(end + i, start + j)]);
            let right = Mat::from_fn(end - start, rows - end, |j, i| {
                left[(i, j)] * pivots[start + j]
            });
            subtract_lower_product(front, end, &left, &right);
        }
    }
    Ok(pivots)
}

/// Subtracts `factor` times column `from` from the column `to` on its right, from its diagonal down.
fn subtract_scaled_column(front: &mut Mat<f64>, from: usize, to: usize, factor: f64) {
    if factor == 0.0 {
        return;
    }
    let rows = front.nrows();
    let (left, right) = front.as_mut_slice().split_at_mut(to * rows);
    let source = &left[from * rows + to..(from + 1) * rows];
    for (entry, source) in right[to..rows].iter_mut().zip(source) {
        *entry -= factor * source;
    }
}

/// The first columns of a front below each other, from the diagonal block down.
pub(super) fn leading_columns(front: &Mat<f64>, columns: usize) -> Mat<f64> {
    let entries = (0..columns).flat_map(|j| column(front, j).iter().copied());
    Mat::from_iterator(front.nrows(), columns, entries)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// An indefinite matrix of several panels: its factors multiply to the matrix, and the rest is the
    /// Schur complement of dense algebra.
    #[test]
    fn factors_multiply_to_the_matrix() {
        let (n, columns) = (90, 70);
        let matrix = Mat::from_fn(n, n, |i, j| {
            let sign = if i % 3 == 0 { -9.0 } else { 8.0 };
            if i == j {
                sign
            } else {
                (1.0 + (i * j) as f64 + (i + j) as f64).sin() / 4.0
            }
        });
        let mut front = matrix.clone();
        let scales = vec![9.0; n];
        let pivots = eliminate(&mut front, columns, &scales).unwrap();
        let lower = Mat::from_fn(n, columns, |i, j| match i.cmp(&j) {
            std::cmp::Ordering::Less => 0.0,
            std::cmp::Ordering::Equal => 1.0,
            std::cmp::Ordering::Greater => front[(i, j)],
        });
        let product = &lower * Mat::from_diagonal(&pivots.clone().into()) * lower.transpose();
        let rest = &matrix - product;
        assert!(rest.view((0, 0), (n, columns)).norm() < 1e-12);
        let schur = Mat::from_fn(20, 20, |i, j| {
            front[(columns + i.max(j), columns + i.min(j))]
        });
        assert!((rest.view((columns, columns), (20, 20)) - schur).norm() < 1e-12);
        let negative = pivots.iter().filter(|pivot| **pivot < 0.0).count();
        let (values, _) =
            jounce_linalg::symmetric_eigen(&matrix.view((0, 0), (70, 70)).into()).unwrap();
        assert_eq!(
            negative,
            values.iter().filter(|value| **value < 0.0).count()
        );
    }

    #[test]
    fn a_vanishing_pivot_is_named() {
        let mut front = Mat::from_fn(3, 3, |i, j| (1 + i.max(j).min(1)) as f64);
        assert_eq!(eliminate(&mut front, 3, &[1.0, 2.0, 2.0]), Err(2));
    }
}
