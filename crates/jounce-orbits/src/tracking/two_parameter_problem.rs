//! Harvesters over two parameters.

use crate::ParametricModel;

/// Family of harvesters over two parameters: one line of them for each value of the second
/// parameter.
pub trait TwoParameterProblem: Sync {
    /// Harvesters over the first parameter.
    type Line: ParametricModel;

    /// Returns the line at a value of the second parameter.
    ///
    /// # Errors
    /// The value is not allowed.
    fn line(&self, parameter_2: f64) -> Result<Self::Line, <Self::Line as ParametricModel>::Error>;

    /// Returns the steps of the difference quotients of the two parameters, at given values.
    fn differences(&self, at: [f64; 2]) -> [f64; 2];
}
