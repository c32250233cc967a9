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
        "Newton's method did not converge at the parameter value {parameter}: the last correction is {error:.1e}, the goal {goal:.1e}{left}; start nearer to the solution or use a larger tolerance"
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
    #[error(
        "the derivative is singular at the parameter value {parameter}; start at another value"
    )]
    Singular {
        /// Parameter there.
        parameter: f64,
    },
    /// No step is short enough.
    #[error(
        "the curve cannot be followed further: even a step of {step:.1e} of the solution fails{}{left}; a smaller tolerance may help",
        last_correction(.error)
    )]
    Stuck {
        /// Parameter of the last point.
        parameter: f64,
        /// Shortest step tried, in the metric.
        step: f64,
        /// Last correction; `None` if none was computed.
        error: Option<f64>,
        /// Parts of the residual at the last attempt.
        left: ResidualReport,
    },
}

fn last_correction(error: &Option<f64>) -> String {
    error.map_or_else(String::new, |error| {
        format!(", with a last correction of {error:.1e}")
    })
}
