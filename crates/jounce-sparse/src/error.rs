//! Errors of sparse matrices and their modes.

use thiserror::Error;

/// Why a matrix cannot be used, or why its modes were not found. Rows and columns count from 0.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SparseError {
    /// An index is not below the size.
    #[error("entry ({row}, {column}) lies outside the {size} x {size} matrix")]
    OutOfRange {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
        /// Number of rows and columns.
        size: usize,
    },
    /// An entry is infinite or not a number.
    #[error("entry ({row}, {column}) is {value}; it must be finite")]
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
        "the matrix is not symmetric: entry ({row}, {column}) is {value}, but entry ({column}, {row}) is {transposed}"
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
        "the mass matrix has {negative} negative eigenvalues; it must be positive definite, or zero in massless directions"
    )]
    IndefiniteMass {
        /// Number of negative eigenvalues.
        negative: usize,
    },
    /// The stiffness has negative eigenvalues.
    #[error(
        "the stiffness matrix has {negative} negative eigenvalues; it must be positive definite, or zero in rigid-body motions"
    )]
    IndefiniteStiffness {
        /// Number of negative eigenvalues.
        negative: usize,
    },
    /// More modes are wanted than the matrices have.
    #[error("{count} modes are wanted, but the matrices have {available}")]
    TooManyModes {
        /// Number of modes wanted.
        count: usize,
        /// Number of modes with mass.
        available: usize,
    },
    /// A pivot is zero: neither matrix acts on a degree of freedom, or a shift is an eigenvalue.
    #[error(
        "the matrix is singular at row {row}: neither stiffness nor mass acts on this degree of freedom alone or on a motion that includes it"
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
