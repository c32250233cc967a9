//! Sparse symmetric matrices, their `L D L^T` factors, and the lowest modes of large structures.
//!
//! [`lowest_modes`] solves the eigenproblem of a structure with stiffness `K` and mass `M`, both
//! symmetric, `M` positive (semi)definite and `K` positive semidefinite:
//!
//! ```text
//! K x = lambda M x,   x^T M x = 1,   lambda ascending
//! ```
//!
//! by block Lanczos iteration with the operator `(K - sigma M)^-1 M`, whose largest eigenvalues
//! `1 / (lambda - sigma)` belong to the lowest modes. The shift `sigma` is negative, so rigid-body
//! modes need no special case. The number of negative pivots of `K - s M` is the number of
//! eigenvalues below `s` (Sylvester's law of inertia); it proves that no mode was missed.
//!
//! ```
//! use jounce_sparse::{SymmetricMatrix, lowest_modes};
//!
//! // Three masses of 1 kg in a row, free, with springs of 1 N/m: eigenvalues 0, 1 and 3.
//! let mass = SymmetricMatrix::from_entries(3, (0..3).map(|i| (i, i, 1.0)))?;
//! let spring = |i: usize| [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)];
//! let stiffness = SymmetricMatrix::from_entries(3, (0..2).flat_map(spring))?;
//! let modes = lowest_modes(&stiffness, &mass, 2, 1e-12)?;
//! assert!(modes.eigenvalue[0].abs() < 1e-12 && (modes.eigenvalue[1] - 1.0).abs() < 1e-12);
//! # Ok::<(), jounce_sparse::SparseError>(())
//! ```
//!
//! [`read_market`] reads the Matrix Market format.
//!
//! Sources: R. G. Grimes, J. G. Lewis, H. D. Simon, A shifted block Lanczos algorithm for solving
//! sparse symmetric generalized eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994) 228; I. S. Duff,
//! J. K. Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM Trans.
//! Math. Softw. 9 (1983) 302; P. R. Amestoy, T. A. Davis, I. S. Duff, An approximate minimum degree
//! ordering algorithm, SIAM J. Matrix Anal. Appl. 17 (1996) 886.

mod block;
mod entries;
mod error;
mod factor;
mod lanczos;
mod market;
mod matrix;
mod modes;
mod uncoupled;

pub use entries::MatrixEntries;
pub use error::SparseError;
pub use factor::{Factor, Symbolic};
pub use market::{
    MAX_DIMENSION, MarketError, read_market, write_market_array, write_market_symmetric,
};
pub use matrix::SymmetricMatrix;
pub use modes::{LowestModes, lowest_modes};
