//! Conditions in which a design is evaluated.

use jounce_spec::NumericKey;

/// Values of keys in one condition, with its weight in the goal.
#[derive(Debug, Clone)]
pub struct Condition {
    /// Index of the changes of the spec by text, such as a recording in place of a sine:
    /// [`super::Problem::changes`].
    pub change: usize,
    /// Numeric keys with their values, SI.
    pub values: Vec<(NumericKey, f64)>,
    /// Weight, relative to the sum of all.
    pub weight: f64,
}
