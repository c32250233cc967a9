//! Measured numbers and curves.

/// Measured number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MeasuredNumber {
    pub name: String,
    pub unit: String,
    pub value: f64,
    /// Scale of the deviation; without one the error is logarithmic.
    pub scale: Option<f64>,
    /// Index of its group.
    pub group: usize,
    /// Index of its curve, and the position on it.
    pub on: Option<(usize, f64)>,
}

/// Measured curve.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MeasuredCurve {
    pub name: String,
    pub unit: String,
    /// `frequency_hz` or `time_s`
    pub over: &'static str,
}
