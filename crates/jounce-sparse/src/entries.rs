//! A matrix of any shape as a list of entries.

use crate::{SparseError, SymmetricMatrix};
use jounce_linalg::Mat;

/// Entries of a matrix; others are zero, and entries at the same place are summed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MatrixEntries {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// `(row, column, value)`, counted from 0.
    pub entries: Vec<(usize, usize, f64)>,
}

impl MatrixEntries {
    /// Returns the matrix as a symmetric one.
    ///
    /// # Errors
    /// `NotSquare`, and those of [`SymmetricMatrix::from_entries`].
    pub fn symmetric(self) -> Result<SymmetricMatrix, SparseError> {
        if self.rows != self.columns {
            return Err(SparseError::NotSquare {
                rows: self.rows,
                columns: self.columns,
            });
        }
        SymmetricMatrix::from_entries(self.rows, self.entries)
    }

    /// Returns the matrix with all entries stored.
    pub fn dense(&self) -> Mat<f64> {
        let mut dense = Mat::zeros(self.rows, self.columns);
        for (row, column, value) in &self.entries {
            dense[(*row, *column)] += value;
        }
        dense
    }
}
