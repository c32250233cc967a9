//! What a fit gives.

use serde::Serialize;

/// A key before and after.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedKey {
    /// Its path.
    pub key: String,
    /// Its SI unit.
    pub unit: String,
    /// Value before, SI.
    pub before: f64,
    /// Value after, SI.
    pub after: f64,
    /// Ends of the interval of 95 %, SI.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
    /// Relative standard deviation of the prior.
    pub prior_deviation: f64,
    /// Relative standard deviation after.
    pub deviation: f64,
}

/// A feature before and after.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedFeature {
    /// Its name, as in `mode 1 frequency`.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// As measured.
    pub measured: f64,
    /// Relative standard deviation of the measurement.
    pub deviation: f64,
    /// Of the model before.
    pub before: f64,
    /// Of the model after.
    pub after: f64,
    /// Relative standard deviation of the model's prediction after the fit, from that of the keys.
    pub predicted_deviation: f64,
}

/// Keys, features, and how far to trust them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitAnswer {
    /// The keys.
    pub keys: Vec<FittedKey>,
    /// The features.
    pub features: Vec<FittedFeature>,
    /// Correlation of every key with every other.
    pub correlation: Vec<Vec<f64>>,
    /// Sum of the squared errors of the features over their variances.
    pub chi_square: f64,
    /// The same plus that of the keys about their priors: what was minimised.
    pub objective: f64,
    /// What the data cannot tell, one sentence each.
    pub warnings: Vec<String>,
    /// Evaluations of the model.
    pub evaluations: usize,
}

impl FittedFeature {
    /// Relative error before and after.
    pub fn errors(&self) -> (f64, f64) {
        (self.before / self.measured - 1.0, self.after / self.measured - 1.0)
    }
}
