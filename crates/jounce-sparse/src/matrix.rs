//! Sparse symmetric matrices.

use crate::SparseError;
use crate::block::{Block, LANES, add_scaled};

/// Difference between an entry and that of the transpose, relative to the largest entry of their
/// rows, above which a matrix is not symmetric: sums in another order stay far below.
const MAX_ASYMMETRY: f64 = 1e-10;

/// A sparse symmetric matrix, both triangles stored by rows.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricMatrix {
    /// First entry of each row in `columns` and `values`, and the number of entries at the end.
    starts: Vec<usize>,
    /// Column of each entry, ascending within a row.
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl SymmetricMatrix {
    /// Builds a matrix of `size` rows from entries `(row, column, value)` of both triangles.
    ///
    /// Entries at the same place are summed, as an assembly of finite elements needs it. Differences
    /// between the triangles at roundoff are averaged.
    ///
    /// # Errors
    /// `OutOfRange`, `NotFinite`, `NotSymmetric`.
    pub fn from_entries(
        size: usize,
        entries: impl IntoIterator<Item = (usize, usize, f64)>,
    ) -> Result<Self, SparseError> {
        let entries: Vec<(usize, usize, f64)> = entries.into_iter().collect();
        for (row, column, value) in entries.iter().copied() {
            if row >= size || column >= size {
                return Err(SparseError::OutOfRange { row, column, size });
            }
            if !value.is_finite() {
                return Err(SparseError::NotFinite { row, column, value });
            }
        }
        Self::summed(size, entries).symmetrised()
    }

    /// Builds a matrix from entries of its lower triangle, `row >= column`; others are ignored.
    ///
    /// # Errors
    /// `OutOfRange`, `NotFinite`.
    pub fn from_lower(
        size: usize,
        entries: impl IntoIterator<Item = (usize, usize, f64)>,
    ) -> Result<Self, SparseError> {
        let both = |(i, j, value): (usize, usize, f64)| match i.cmp(&j) {
            std::cmp::Ordering::Greater => vec![(i, j, value), (j, i, value)],
            std::cmp::Ordering::Equal => vec![(i, j, value)],
            std::cmp::Ordering::Less => Vec::new(),
        };
        Self::from_entries(size, entries.into_iter().flat_map(both))
    }

    /// Sorts entries by row and column and sums those at the same place.
    fn summed(size: usize, entries: Vec<(usize, usize, f64)>) -> Self {
        // Two counting sorts, first by column, then by row, leave each row in order.
        let by_column = counting_sort(size, entries, |entry| entry.1);
        let by_row = counting_sort(size, by_column, |entry| entry.0);
        let mut matrix = Self::with_capacity(by_row.len());
        let mut last = None;
        for (row, column, value) in by_row {
            match matrix.values.last_mut() {
                Some(sum) if last == Some((row, column)) => *sum += value,
                _ => {
                    matrix.starts.resize(row + 1, matrix.values.len());
                    matrix.push(column, value);
                }
            }
            last = Some((row, column));
        }
        matrix.starts.resize(size + 1, matrix.values.len());
        matrix
    }

    /// The mean of the matrix and its transpose, on the entries that both store.
    fn symmetrised(self) -> Result<Self, SparseError> {
        let size = self.size();
        let largest: Vec<f64> = (0..size)
            .map(|i| self.row(i).fold(0.0, |max: f64, (_, v)| max.max(v.abs())))
            .collect();
        let mut mean = Self::with_capacity(self.stored());
        for row in 0..size {
            for (column, value) in self.row(row) {
                let mirrored = self.stored_entry(column, row);
                let transposed = mirrored.unwrap_or(0.0);
                let roundoff = MAX_ASYMMETRY * largest[row].max(largest[column]);
                if (value - transposed).abs() > roundoff {
                    return Err(SparseError::NotSymmetric {
                        row,
                        column,
                        value,
                        transposed,
                    });
                }
                if mirrored.is_some() {
                    mean.push(column, 0.5 * (value + transposed));
                }
            }
            mean.starts.push(mean.values.len());
        }
        Ok(mean)
    }

    /// A matrix without rows.
    fn with_capacity(stored: usize) -> Self {
        Self {
            starts: vec![0],
            columns: Vec::with_capacity(stored),
            values: Vec::with_capacity(stored),
        }
    }

    /// Adds an entry to the last row, which is not complete.
    fn push(&mut self, column: usize, value: f64) {
        self.columns.push(column);
        self.values.push(value);
    }

    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of stored entries of both triangles.
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// Returns the entries of a row as pairs of column and value, ascending.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[row]..self.starts[row + 1];
        self.columns[range.clone()]
            .iter()
            .copied()
            .zip(self.values[range].iter().copied())
    }

    /// Returns one entry; 0 where nothing is stored.
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        self.stored_entry(row, column).unwrap_or(0.0)
    }

    fn stored_entry(&self, row: usize, column: usize) -> Option<f64> {
        let range = self.starts[row]..self.starts[row + 1];
        let found = self.columns[range.clone()].binary_search(&column).ok()?;
        Some(self.values[range.start + found])
    }

    /// Returns `A x`.
    pub fn product(&self, x: &[f64]) -> Vec<f64> {
        (0..self.size())
            .map(|i| self.row(i).map(|(j, value)| value * x[j]).sum())
            .collect()
    }

    /// Returns `A + factor B`, which stores each entry that either of both stores.
    ///
    /// # Errors
    /// `SizeMismatch`.
    pub fn plus(&self, factor: f64, other: &Self) -> Result<Self, SparseError> {
        if self.size() != other.size() {
            return Err(SparseError::SizeMismatch {
                stiffness: self.size(),
                mass: other.size(),
            });
        }
        let mut sum = Self::with_capacity(self.stored().max(other.stored()));
        for row in 0..self.size() {
            let mut first = self.row(row).peekable();
            let mut second = other.row(row).peekable();
            while let Some(column) = [first.peek(), second.peek()]
                .into_iter()
                .flatten()
                .map(|entry| entry.0)
                .min()
            {
                let a = first
                    .next_if(|entry| entry.0 == column)
                    .map_or(0.0, |entry| entry.1);
                let b = second
                    .next_if(|entry| entry.0 == column)
                    .map_or(0.0, |entry| entry.1);
                sum.push(column, a + factor * b);
            }
            sum.starts.push(sum.columns.len());
        }
        Ok(sum)
    }

    /// Returns `A X` for a block of vectors.
    pub(crate) fn block_product(&self, x: &Block) -> Block {
        let row_product = |i| {
            let mut sum = [0.0; LANES];
            for (j, value) in self.row(i) {
                add_scaled(&mut sum, value, &x[j]);
            }
            sum
        };
        (0..self.size()).map(row_product).collect()
    }

    /// First entry of each row, and the column of each entry.
    pub(crate) fn pattern(&self) -> (&[usize], &[usize]) {
        (&self.starts, &self.columns)
    }
}

/// The entries in ascending order of a key below `size`, those of the same key in their order.
fn counting_sort(
    size: usize,
    entries: Vec<(usize, usize, f64)>,
    key: impl Fn(&(usize, usize, f64)) -> usize,
) -> Vec<(usize, usize, f64)> {
    let mut next = vec![0; size + 1];
    for entry in &entries {
        next[key(entry) + 1] += 1;
    }
    for k in 0..size {
        next[k + 1] += next[k];
    }
    let mut sorted = vec![(0, 0, 0.0); entries.len()];
    for entry in entries {
        let place = &mut next[key(&entry)];
        sorted[*place] = entry;
        *place += 1;
    }
    sorted
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn entries_of_elements_are_summed() {
        let element = |i: usize| {
            [
                (i + 1, i, -1.0),
                (i, i, 1.0),
                (i + 1, i + 1, 1.0),
                (i, i + 1, -1.0),
            ]
        };
        let matrix = SymmetricMatrix::from_entries(3, (0..2).flat_map(element)).unwrap();
        assert_eq!(
            matrix.row(1).collect::<Vec<_>>(),
            [(0, -1.0), (1, 2.0), (2, -1.0)]
        );
        assert_eq!((matrix.stored(), matrix.entry(0, 2)), (7, 0.0));
        assert_eq!(matrix.product(&[1.0, 2.0, 4.0]), [-1.0, -1.0, 2.0]);
        let lower = (0..3).flat_map(|i| matrix.row(i).map(move |(j, x)| (i, j, x)));
        assert_eq!(SymmetricMatrix::from_lower(3, lower).unwrap(), matrix);
    }

    #[test]
    fn sums_store_the_entries_of_both() {
        let a = SymmetricMatrix::from_lower(2, [(0, 0, 1.0), (1, 0, 2.0)]).unwrap();
        let b = SymmetricMatrix::from_lower(2, [(1, 1, 3.0), (1, 0, 1.0)]).unwrap();
        let sum = a.plus(-2.0, &b).unwrap();
        let expected = [(0, 0, 1.0), (1, 0, 0.0), (1, 1, -6.0)];
        assert_eq!(sum, SymmetricMatrix::from_lower(2, expected).unwrap());
    }

    #[test]
    fn faults_name_the_entry() {
        let fault = |entries: &[(usize, usize, f64)]| {
            SymmetricMatrix::from_entries(2, entries.iter().copied())
                .unwrap_err()
                .to_string()
        };
        assert!(fault(&[(0, 2, 1.0)]).contains("(0, 2) lies outside the 2 x 2"));
        assert!(fault(&[(1, 0, f64::NAN)]).contains("(1, 0) is NaN"));
        let text = fault(&[(0, 1, 1.0), (1, 0, 1.0001), (0, 0, 2.0)]);
        assert!(
            text.contains("entry (0, 1) is 1, but entry (1, 0) is 1.0001"),
            "{text}"
        );
        let rounded = [(0, 1, 1.0), (1, 0, 1.0 + 1e-13), (0, 0, 2.0)];
        assert!(SymmetricMatrix::from_entries(2, rounded).is_ok());
    }
}
