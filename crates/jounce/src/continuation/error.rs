//! Why a curve ends.

use super::ResidualReport;

/// A walk that could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ContinuationError<E> {
    /// The problem itself.
    #[error(transparent)]
    Family(E),
    /// Newton did not converge.
    #[error(
        "Newton did not converge at parameter {parameter}: last correction {error:e}, wanted {goal:e}{left}; start nearer to the solution or loosen the tolerance"
    )]
    Diverged {
        /// Where.
        parameter: f64,
        /// Last correction, relative to the solution.
        error: f64,
        /// Wanted.
        goal: f64,
        /// What the residual is made of there.
        left: ResidualReport,
    },
    /// The derivative is singular in more than one direction.
    #[error("the derivative is singular at parameter {parameter}; start at another value")]
    Singular {
        /// Where.
        parameter: f64,
    },
    /// No step is short enough.
    #[error(
        "the curve cannot be followed beyond parameter {parameter}: even a step of {step:e} fails (last correction {error:e}){left}; a tighter tolerance may help"
    )]
    Stuck {
        /// Last good point.
        parameter: f64,
        /// Shortest step tried, in the metric.
        step: f64,
        /// Last correction.
        error: f64,
        /// What the residual was made of when it was given up.
        left: ResidualReport,
    },
}
