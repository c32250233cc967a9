//! What a bandwidth answers.

use serde::Serialize;

/// What a place of a branch is to its stable part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BandLimit {
    /// Power is stationary.
    Maximum,
    /// Power is half the peak.
    HalfPower,
    /// Stability is lost.
    Stability,
    /// The branch ends, at the edge of the range or elsewhere.
    End,
}

/// The largest mean power of a stable orbit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PowerPeak {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Its estimated error.
    pub parameter_error: f64,
    /// Mean power of all loads, W; where stability is lost, the limit from the stable side.
    pub mean_power_w: f64,
    /// What makes it the largest.
    pub at: BandLimit,
}

/// An end of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IntervalEdge {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Its estimated error.
    pub parameter_error: f64,
    /// What ends the interval.
    pub at: BandLimit,
}

/// A range of the key.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BandInterval {
    /// Lower end.
    pub from: IntervalEdge,
    /// Upper end.
    pub to: IntervalEdge,
}

/// Where a stable orbit has at least half the peak power.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bandwidth {
    /// The peak.
    pub peak: PowerPeak,
    /// Sum of the widths, in the unit of the key.
    pub width: f64,
    /// Its estimated error: the sum of those of the edges.
    pub width_error: f64,
    /// The ranges, from low to high, none touching the next.
    pub intervals: Vec<BandInterval>,
}

/// Bandwidths of several branches.
#[derive(Debug, Clone, PartialEq)]
pub struct Bandwidths {
    /// Of each branch by its own peak; `None` without a stable orbit.
    pub branches: Vec<Option<Bandwidth>>,
    /// Of all together: where any stable orbit has half the largest peak.
    pub together: Option<Bandwidth>,
}
