//! Result of basins of attraction.

use jounce_analysis::run::ExceededLimit;
use jounce_analysis::{AttractingOrbit, Attractor, GridAxis};
use serde::Serialize;
use std::sync::Arc;

/// Attractors reached from a cloud or a grid of starts, and the share of the starts that reach
/// each.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BasinsResult {
    /// Attractors: orbits by period and decreasing power, then chaos, tori, and the undecided
    /// starts.
    pub attractors: Vec<AttractorResult>,
    /// Expected power of a start, W.
    pub expected_power_w: f64,
    /// Lower end of its 95 % interval, W.
    pub expected_power_low_w: f64,
    /// Upper end of its 95 % interval, W.
    pub expected_power_high_w: f64,
    /// Number of starts.
    pub starts: usize,
    /// Number of finished starts, fewer than `starts` after a stop by the user.
    pub finished: usize,
    /// Starts whose run failed.
    pub failed: Vec<FailedStart>,
    /// Number of starts that reach an orbit after a transient of at least 512 drive cycles that is
    /// chaotic: roundoff decides which orbit each of them reaches. Their shares are not affected.
    pub chaotic_transients: usize,
    /// Seed of the cloud.
    pub seed: u64,
    /// Displacement towards the first stop at which contact begins, its gap, m; `None` without a
    /// stop, or where the motions of two bases change the gap.
    pub gap_m: Option<f64>,
    /// Each start, in order.
    #[serde(skip)]
    pub points: Vec<StartPoint>,
    /// Sides of the grid of starts; none for a cloud.
    #[serde(skip)]
    pub sides: Vec<GridAxis>,
}

/// An attractor with its share of the starts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttractorResult {
    /// Drive cycles of the period and a letter by decreasing power, `1a`; `chaos`, `torus`,
    /// `undecided` for the starts without a proven attractor.
    pub id: String,
    /// Period in drive cycles; 0 without a period.
    pub period_cycles: u32,
    /// True where neighbouring motions diverge.
    pub chaotic: bool,
    /// Id of the orbit whose mirror image, half a drive cycle later, this orbit is.
    pub mirror_of: Option<String>,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Contacts per period.
    pub contacts_per_period: u64,
    /// Largest Lyapunov exponent of an aperiodic attractor, 1/s.
    pub lyapunov_per_s: Option<f64>,
    /// Standard error of the exponent, 1/s.
    pub lyapunov_error_per_s: Option<f64>,
    /// Share of the starts.
    pub fraction: f64,
    /// Lower end of its 95 % interval.
    pub fraction_low: f64,
    /// Upper end of its 95 % interval.
    pub fraction_high: f64,
    /// Exceeded limits of patches.
    pub warnings: Vec<ExceededLimit>,
    /// Orbit of a periodic attractor, with the ball that proves that it attracts.
    #[serde(skip)]
    pub(crate) attracting: Option<Arc<AttractingOrbit>>,
    /// State (physical) of an aperiodic attractor at the start of a drive cycle.
    #[serde(skip)]
    pub(crate) last_state: Option<Vec<f64>>,
}

/// A start whose run failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FailedStart {
    /// Number of the start, from 0.
    pub start: usize,
    /// The reason.
    pub reason: String,
}

/// A start: its place and its attractor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartPoint {
    /// Displacement towards the first stop, m.
    pub displacement_m: f64,
    /// Velocity towards the first stop, m/s.
    pub velocity_m_s: f64,
    /// Voltage of the first patch, V.
    pub voltage_v: f64,
    /// Number of its attractor; `None` where the run failed or was not finished.
    pub attractor: Option<usize>,
}

impl AttractorResult {
    pub(super) fn of(attractor: &Attractor) -> Self {
        let (exponent, error) = attractor.lyapunov.unzip();
        Self {
            id: attractor.id.clone(),
            period_cycles: attractor.period_cycles,
            chaotic: attractor.is_chaotic(),
            mirror_of: attractor.mirror_of.clone(),
            mean_power_w: attractor.mean_power_w,
            contacts_per_period: attractor.contacts_per_period,
            lyapunov_per_s: exponent,
            lyapunov_error_per_s: error,
            fraction: attractor.share.fraction,
            fraction_low: attractor.share.low,
            fraction_high: attractor.share.high,
            warnings: attractor.exceeded.clone(),
            attracting: attractor.attracting.clone(),
            last_state: attractor.last_state.clone(),
        }
    }
}
