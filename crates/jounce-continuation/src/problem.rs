//! Interface of a problem for continuation.

use super::ResidualReport;

/// A family of problems `R(u, p) = 0` over one parameter.
pub trait Problem {
    /// Evaluation at one point, with its derivative and other data for the caller.
    type Evaluation: Linearization;
    /// Error of an evaluation.
    type Error;

    /// Returns residual and derivative at `(u, p)`.
    ///
    /// # Errors Any error of the problem.
    fn at(&self, unknown: &[f64], parameter: f64) -> Result<Self::Evaluation, Self::Error>;
}

/// Residual with its derivative.
pub trait Linearization {
    /// `R`.
    fn residual(&self) -> &[f64];

    /// Returns the parts of `R`, for error messages.
    fn parts(&self) -> ResidualReport {
        ResidualReport::default()
    }

    /// Solves `[R_u R_p; row corner] (du, dp) = (right, last)`; `None` where the bordered matrix is
    /// singular.
    fn bordered(
        &self,
        row: &[f64],
        corner: f64,
        right: &[f64],
        last: f64,
    ) -> Option<(Vec<f64>, f64)>;
}
