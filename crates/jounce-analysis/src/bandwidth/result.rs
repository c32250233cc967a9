//! Results of a bandwidth computation.

use serde::Serialize;

/// Kind of a peak or of an edge of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BandLimit {
    /// The power is stationary.
    Maximum,
    /// The power is half the peak power.
    HalfPower,
    /// The stability changes.
    Stability,
    /// The branch ends, at the edge of the range or elsewhere.
    End,
}

/// Largest mean power of a stable orbit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PowerPeak {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Estimated error of the key.
    pub parameter_error: f64,
    /// Mean power of all loads, W; where stability is lost, the limit from the stable side.
    pub mean_power_w: f64,
    /// Kind of the peak.
    pub at: BandLimit,
}

/// End of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IntervalEdge {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Estimated error of the key.
    pub parameter_error: f64,
    /// Kind of the edge.
    pub at: BandLimit,
}

/// Interval of the key.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BandInterval {
    /// Lower end.
    pub from: IntervalEdge,
    /// Upper end.
    pub to: IntervalEdge,
}

/// Intervals where a stable orbit has at least half the peak power.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bandwidth {
    /// The peak.
    pub peak: PowerPeak,
    /// Sum of the widths, in the unit of the key.
    pub width: f64,
    /// Estimated error of the width: the sum of the errors of the edges.
    pub width_error: f64,
    /// Disjoint intervals, from low to high.
    pub intervals: Vec<BandInterval>,
}

/// Bandwidths of several branches.
#[derive(Debug, Clone, PartialEq)]
pub struct Bandwidths {
    /// Bandwidth of each branch relative to its own peak; `None` without a stable orbit.
    pub branches: Vec<Option<Bandwidth>>,
    /// Bandwidth of all branches combined: where any stable orbit has half the largest peak.
    pub together: Option<Bandwidth>,
}
