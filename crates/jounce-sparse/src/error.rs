//! Errors of sparse matrices and their modes.

use thiserror::Error;

/// Why a matrix cannot be used, or why its modes were not found. Rows and columns of fields
/// count from 0, those of messages from 1, as in files.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SparseError {
    /// An index is not below the size.
    #[error("entry ({}, {}) lies outside the {size} x {size} matrix", .row + 1, .column + 1)]
    OutOfRange {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
        /// Number of rows and columns.
        size: usize,
    },
    /// An entry is infinite or not a number.
    #[error("entry ({}, {}) is {value}; it must be finite", .row + 1, .column + 1)]
    NotFinite {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
        /// Its value.
        value: f64,
    },
    /// An entry differs from that of the transpose by more than roundoff.
    #[error(
        "the matrix is not symmetric: entry ({0}, {1}) is {value}, but entry ({1}, {0}) is {transposed}; leave out gyroscopic and follower-force terms, or write more digits",
        .row + 1,
        .column + 1
    )]
    NotSymmetric {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
        /// Its value.
        value: f64,
        /// Value of the transposed entry.
        transposed: f64,
    },
    /// The numbers of rows and columns differ.
    #[error("the matrix has {rows} rows but {columns} columns; it must be square")]
    NotSquare {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
    /// Stiffness and mass have different sizes.
    #[error(
        "stiffness has {stiffness} rows, but mass has {mass}; both must have one per degree of freedom"
    )]
    SizeMismatch {
        /// Rows of the stiffness.
        stiffness: usize,
        /// Rows of the mass.
        mass: usize,
    },
    /// The mass has negative eigenvalues.
    #[error(
        "the mass matrix has {}; it must be positive definite, or zero in massless directions: check its signs, and that it is not another matrix",
        eigenvalues(*.negative)
    )]
    IndefiniteMass {
        /// Number of negative eigenvalues.
        negative: usize,
    },
    /// The stiffness has negative eigenvalues.
    #[error(
        "the stiffness matrix has {}; it must be positive definite, or zero in rigid-body motions: check its signs, and leave out a preload beyond buckling",
        eigenvalues(*.negative)
    )]
    IndefiniteStiffness {
        /// Number of negative eigenvalues.
        negative: usize,
    },
    /// More modes are wanted than the matrices have.
    #[error(
        "{count} modes are wanted, but the matrices have {available}; ask for at most {available}"
    )]
    TooManyModes {
        /// Number of modes wanted.
        count: usize,
        /// Number of modes with mass.
        available: usize,
    },
    /// A pivot is zero: neither matrix acts on a degree of freedom, or a shift is an eigenvalue.
    #[error(
        "the matrix is singular at row {}: neither stiffness nor mass acts on this degree of freedom, or on a motion that includes it",
        .row + 1
    )]
    Singular {
        /// Row with the vanishing pivot.
        row: usize,
    },
    /// The iteration ended before the modes were accurate.
    #[error(
        "{converged} of {count} modes converged in {solves} solves; raise the tolerance or check the units of the matrices"
    )]
    NotConverged {
        /// Number of accurate modes.
        converged: usize,
        /// Number of modes wanted.
        count: usize,
        /// Number of systems solved.
        solves: usize,
    },
}

/// Returns `1 negative eigenvalue`, or `2 negative eigenvalues`.
fn eigenvalues(negative: usize) -> String {
    let plural = if negative == 1 { "" } else { "s" };
    format!("{negative} negative eigenvalue{plural}")
}
