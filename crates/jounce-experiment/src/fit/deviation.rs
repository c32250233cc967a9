//! Standard deviations of measurements.

/// Standard deviation of measurements: relative, or relative to the RMS of a time history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Deviation {
    /// Given by the user.
    Given(f64),
    /// Unknown: estimated from the residuals, including the error of the model.
    Residuals,
}

/// Initial value where unknown.
const INITIAL_DEVIATION: f64 = 0.01;
/// Lower bound on the estimate from residuals.
pub(super) const MIN_DEVIATION: f64 = 1e-7;

impl Deviation {
    /// Returns the initial value.
    pub(super) fn first(self) -> f64 {
        match self {
            Self::Given(deviation) => deviation,
            Self::Residuals => INITIAL_DEVIATION,
        }
    }
}

/// Measurements that share a standard deviation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DeviationGroup {
    pub name: String,
    pub deviation: Deviation,
}
