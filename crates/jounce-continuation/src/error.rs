//! Errors of continuation.

use super::ResidualReport;

/// Error that ends a continuation.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ContinuationError<E> {
    /// Error of the problem.
    #[error(transparent)]
    Family(E),
    /// Newton did not converge.
    #[error(
        "Newton did not converge at parameter {parameter}: last correction {error:e}, wanted {goal:e}{left}; start nearer to the solution or loosen the tolerance"
    )]
    Diverged {
        /// Parameter there.
        parameter: f64,
        /// Last correction, relative to the solution.
        error: f64,
        /// Required correction.
        goal: f64,
        /// Parts of the residual there.
        left: ResidualReport,
    },
    /// The derivative is singular in more than one direction.
    #[error("the derivative is singular at parameter {parameter}; start at another value")]
    Singular {
        /// Parameter there.
        parameter: f64,
    },
    /// No step is short enough.
    #[error(
        "the curve cannot be followed beyond parameter {parameter}: even a step of {step:e} fails (last correction {error:e}){left}; a tighter tolerance may help"
    )]
    Stuck {
        /// Parameter of the last point.
        parameter: f64,
        /// Shortest step tried, in the metric.
        step: f64,
        /// Last correction.
        error: f64,
        /// Parts of the residual at the last attempt.
        left: ResidualReport,
    },
}
