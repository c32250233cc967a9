//! Results of a design.

use serde::Serialize;
use std::collections::BTreeMap;

/// Best design and what is known of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignOutcome {
    /// The best design: within the limits or, if there is none, the one with the least violation.
    pub best: BestDesign,
    /// Limits at the best design.
    pub limits: Vec<LimitResult>,
    /// Distribution of the power under the tolerances; `None` without tolerances or without an
    /// orbit.
    pub robust: Option<Robustness>,
    /// Designs that no other design beats in all goals; empty for one goal.
    pub front: Vec<FrontPoint>,
    /// Spec as given, evaluated in the same way.
    pub before: DesignBefore,
    /// True where the best design keeps all limits, under noise in all examined realisations.
    pub feasible: bool,
    /// Sum of the relative violations of the limits, and the share of the starts of which no limit
    /// is known; 0 within the limits.
    pub violation: f64,
    /// Reason of the end of the search.
    pub ended_by: SearchEnd,
    /// Free keys that change neither a goal nor a limit at the best design, and a bifurcation that is
    /// nearer than the nearest fold, one sentence each.
    pub warnings: Vec<String>,
    /// Better and better designs.
    pub trace: Vec<TracePoint>,
    /// Number of evaluated designs.
    pub evaluations: usize,
    /// Seed.
    pub seed: u64,
    /// Wall time, s.
    pub wall_time_s: f64,
}

/// Best design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BestDesign {
    /// Values of the free keys with their units, as `--set` takes them.
    pub set: BTreeMap<String, String>,
    /// The free keys in the order of the file.
    pub keys: Vec<FreeValue>,
    /// Value of each goal in its unit ([`crate::Goal::unit`]).
    pub goals: BTreeMap<String, f64>,
    /// Mean power of the main orbit, or of the run of a goal `mean-power`, W; NaN without either.
    pub mean_power_w: f64,
    /// Expected power of a start, W.
    pub expected_power_w: f64,
    /// Lower end of its 95 % interval, W.
    pub expected_power_low_w: f64,
    /// Upper end of its 95 % interval, W.
    pub expected_power_high_w: f64,
    /// Share of the starts that reach the main orbit.
    pub basin_fraction: f64,
    /// Lower end of its 95 % interval.
    pub basin_fraction_low: f64,
    /// Upper end of its 95 % interval.
    pub basin_fraction_high: f64,
    /// True where the main orbit is proved to attract; false without an orbit.
    pub stable: bool,
    /// Period of the main orbit, drive cycles; 0 without an orbit.
    pub period_cycles: u32,
    /// Nearest fold of the main orbit over the frequency of the drive.
    pub nearest_fold: Option<NearestFold>,
    /// Mean power under other noise than that of the search; `null` without a goal `mean-power` under
    /// noise.
    pub noise: Option<NoisePower>,
}

/// Mean power of the best design under realisations of the noise of its spec. The search uses one
/// realisation and fits the design to it, so its own power tends to be too high.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NoisePower {
    /// Number of realisations of each condition.
    pub realisations: usize,
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Lower end of its 95 % interval, W.
    pub mean_power_low_w: f64,
    /// Upper end of its 95 % interval, W.
    pub mean_power_high_w: f64,
}

/// Value of a free key.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FreeValue {
    /// Dotted path.
    pub key: String,
    /// Value with its unit.
    pub value: String,
    /// Value in the spec as given.
    pub before: String,
    /// `lower` or `upper` where the value is at an end of its range.
    pub at_end: Option<&'static str>,
}

/// A fold of the main orbit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NearestFold {
    /// Key over which the orbit is followed.
    pub key: String,
    /// Frequency of the fold, Hz.
    pub frequency_hz: f64,
    /// Distance from the frequency of the drive, Hz.
    pub distance_hz: f64,
    /// Standard deviation of the frequency of the fold by the tolerances, to first order, Hz; `null`
    /// without tolerances.
    pub scatter_hz: Option<f64>,
}

/// Limit at the best design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitResult {
    /// Name.
    pub name: String,
    /// Value at the design, SI; the worst of all conditions, attractors and realisations of the noise.
    pub value: f64,
    /// Limit, SI.
    pub limit: f64,
    /// True where the value must be at least the limit, false where at most.
    pub is_lower: bool,
    /// Share of the value beyond the limit or, of a limit from below, missing share of the limit; 0
    /// within it, 1 where the value is not known.
    pub violation: f64,
    /// True where the limit binds.
    pub active: bool,
    /// Gain of mean power per unit of the limit, W per SI unit, where the limit is met and binds, a
    /// free key affects it, and the main orbit has derivatives.
    pub price: Option<f64>,
    /// The limit under other noise than that of the search; `null` without noise, and for a limit that
    /// does not depend on it.
    pub noise: Option<NoiseLimit>,
}

impl LimitResult {
    /// Returns the value and the limit in words, `6.0e-4 of at most 6.0e-4`.
    pub fn comparison(&self, decimals: usize) -> String {
        let side = if self.is_lower { "at least" } else { "at most" };
        let (value, limit) = (self.value, self.limit);
        format!("{value:.decimals$e} of {side} {limit:.decimals$e}")
    }

    /// Returns whether the limit is met, in words.
    pub fn state(&self) -> &'static str {
        match (self.violation > 0.0, self.active) {
            (true, _) => "not met",
            (false, true) => "binds",
            (false, false) => "does not bind",
        }
    }
}

/// Limit of the best design under realisations of the noise other than that of its spec. The search
/// examines each design in them before it counts, so that a design within its limits exceeds none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NoiseLimit {
    /// Number of realisations; each has a run in every condition.
    pub realisations: usize,
    /// Number of these in which the limit is exceeded in a condition.
    pub exceeded: usize,
    /// Lower end of the 95 % interval of the share of all realisations that exceed the limit.
    pub exceeded_fraction_low: f64,
    /// Upper end of this interval.
    pub exceeded_fraction_high: f64,
}

/// Spec as given.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignBefore {
    /// Value of each goal, in W or Hz; empty where the spec cannot be evaluated or the search was
    /// stopped.
    pub goals: BTreeMap<String, f64>,
    /// Expected power of a start, W; NaN without goals.
    pub expected_power_w: f64,
    /// Sum of the relative violations of the limits; `None` without goals.
    pub violation: Option<f64>,
}

/// Distribution of the power under the tolerances: that of the main orbits, the mean over the
/// conditions by their weights.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Robustness {
    /// Quantiles of the power.
    pub quantiles: Vec<Quantile>,
    /// Sobol indices of each tolerance.
    pub sobol: Vec<SobolIndex>,
    /// Number of drawn designs of the quantiles.
    pub draws: usize,
    /// Share of these in which the main orbit of a condition is lost, so that its power is that of the
    /// starts.
    pub lost_fraction: f64,
}

/// Quantile of the power.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Quantile {
    /// Share of the designs with less power.
    pub share: f64,
    /// Mean power, W.
    pub mean_power_w: f64,
}

/// Quantiles of the power of an orbit over a key, under tolerances.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct PowerBand {
    /// Values of the key, SI.
    pub parameter: Vec<f64>,
    /// Power that 5 % of the drawn designs with the orbit do not reach, W; NaN where none has it.
    pub low_w: Vec<f64>,
    /// Median, W.
    pub median_w: Vec<f64>,
    /// Power that 5 % of the drawn designs with the orbit exceed, W.
    pub high_w: Vec<f64>,
    /// Share of the drawn designs that have the orbit.
    pub found_share: Vec<f64>,
}

/// Share of the variance of the power that a tolerance causes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SobolIndex {
    /// Key of the tolerance.
    pub key: String,
    /// Share that it causes alone, with the ends of its 95 % interval.
    pub first: f64,
    /// Lower end.
    pub first_low: f64,
    /// Upper end.
    pub first_high: f64,
    /// Share that it causes with all others.
    pub total: f64,
    /// Lower end.
    pub total_low: f64,
    /// Upper end.
    pub total_high: f64,
}

/// Point of a front.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrontPoint {
    /// Values of the free keys with their units.
    pub set: BTreeMap<String, String>,
    /// Value of each goal.
    pub goals: BTreeMap<String, f64>,
}

/// A better design.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TracePoint {
    /// Number of evaluated designs.
    pub evaluation: usize,
    /// Value of the first goal.
    pub goal: f64,
    /// Sum of the relative violations of the limits.
    pub violation: f64,
}

/// A better design, as soon as a search has found it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Improvement {
    /// Value of the first goal and violation of the limits.
    #[serde(flatten)]
    pub point: TracePoint,
    /// Values of the free keys with their units, as `--set` takes them.
    pub set: BTreeMap<String, String>,
    /// Limits at the design, without their prices.
    pub limits: Vec<LimitResult>,
}

/// Reason of the end of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SearchEnd {
    /// Nothing better is expected.
    Converged,
    /// The number of evaluations was reached.
    Evaluations,
    /// The wall time was reached: the result depends on the machine.
    Seconds,
    /// The user stopped it.
    Stopped,
}
