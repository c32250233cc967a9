//! Quantiles of the standard normal distribution.

/// Half-width of a two-sided interval of 95 %.
pub const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Upper quartile: the median of the magnitude.
pub const NORMAL_QUARTILE: f64 = 0.674_489_75;
