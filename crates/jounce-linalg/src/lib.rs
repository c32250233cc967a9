//! Dense matrices and their decompositions.
//!
//! The algorithms of `nalgebra` are generic: each crate that calls one compiles it anew. This crate
//! calls them for doubles, so they are compiled once. Its own are the eigenvectors of real matrices
//! without symmetry, which `nalgebra` lacks, and the LU factors of Newton's method.
//!
//! ```
//! use jounce_linalg::{Mat, eigenvalues, inverse};
//!
//! let rotation = Mat::from_fn(2, 2, |i, j| [[0.0, -1.0], [1.0, 0.0]][i][j]);
//! assert_eq!(inverse(&rotation), rotation.transpose());
//! let values = eigenvalues(&rotation).ok_or("no convergence")?;
//! assert!(values.iter().all(|value| (value.im.abs() - 1.0).abs() < 1e-15));
//! # Ok::<(), &str>(())
//! ```

mod eigen;
mod factors;
mod lu;
mod slices;
mod solve;
mod symmetric_eigen;

pub use eigen::{Eigen, complex_eigenvalues, eigen, eigenvalues};
pub use factors::{
    CholeskyFactor, complex_inverse_cholesky_factor, complex_right_singular,
    inverse_cholesky_factor, orthogonal_factor, right_singular, singular_values, thin_qr,
    upper_cholesky,
};
pub use lu::LuFactors;
pub use slices::{
    add_gram, add_transposed_product, column, column_mut, distance, norm, row_product,
    subtract_lower_product,
};
pub use solve::{
    complex_inverse, complex_solve, determinant, inverse, inverse_fully_pivoted, positive_inverse,
    pseudoinverse, solve, solve_fully_pivoted,
};
pub use symmetric_eigen::symmetric_eigen;

/// Dense matrix, stored by columns.
pub type Mat<T> = nalgebra::DMatrix<T>;

/// Complex number of two doubles.
#[allow(non_camel_case_types, reason = "the usual short name, as f64")]
pub type c64 = nalgebra::Complex<f64>;

/// Sweeps per row of a matrix after which an iteration is taken not to converge.
const SWEEPS_PER_ROW: usize = 60;
