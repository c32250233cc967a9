//! How far a measurement may be from the truth.

/// A standard deviation of measurements: relative, or over the rms of a time history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Deviation {
    /// As the user knows it.
    Given(f64),
    /// Unknown: taken from what the fit leaves over, that of the model included.
    Residuals,
}

/// What a fit begins with where nothing is known.
const INITIAL_DEVIATION: f64 = 0.01;
/// Residuals are not believed to be smaller than this.
pub(super) const MIN_DEVIATION: f64 = 1e-7;

impl Deviation {
    /// What a fit begins with.
    pub(super) fn first(self) -> f64 {
        match self {
            Self::Given(deviation) => deviation,
            Self::Residuals => INITIAL_DEVIATION,
        }
    }
}

/// Measurements that share a deviation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DeviationGroup {
    pub name: String,
    pub deviation: Deviation,
}
