//! What continuation asks of a problem.

use super::ResidualReport;

/// A family of problems `R(u, p) = 0` over one parameter.
pub trait Problem {
    /// The problem at one place, with its derivative and whatever else the caller wants to keep of it.
    type Evaluation: Linearization;
    /// Why the residual cannot be had.
    type Error;

    /// Residual and derivative at `(u, p)`.
    ///
    /// # Errors
    /// What the problem itself reports.
    fn at(&self, unknown: &[f64], parameter: f64) -> Result<Self::Evaluation, Self::Error>;
}

/// A residual with its derivative.
pub trait Linearization {
    /// `R`.
    fn residual(&self) -> &[f64];

    /// What `R` is made of, for the words of a failure.
    fn parts(&self) -> ResidualReport {
        ResidualReport::default()
    }

    /// Solves `[R_u R_p; row corner] (du, dp) = (right, last)`; `None` where the bordered matrix is singular.
    fn bordered(
        &self,
        row: &[f64],
        corner: f64,
        right: &[f64],
        last: f64,
    ) -> Option<(Vec<f64>, f64)>;
}
