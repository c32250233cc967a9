//! Harvesters over two parameters.

use crate::orbit::ParametricModel;

/// A plane of harvesters: one line of them for each value of the second parameter.
pub trait TwoParameterProblem: Sync {
    /// Harvesters over the first parameter.
    type Line: ParametricModel;

    /// The line at a value of the second parameter.
    ///
    /// # Errors
    /// A value that is not allowed.
    fn line(&self, parameter_2: f64) -> Result<Self::Line, <Self::Line as ParametricModel>::Error>;

    /// Lengths of differences of the two parameters, at their values.
    fn differences(&self, at: [f64; 2]) -> [f64; 2];
}
