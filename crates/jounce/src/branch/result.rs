//! Result of a continuation of branches.

use super::BranchOptions;
use jounce_analysis::run::ExceededLimit;
use jounce_analysis::{BandInterval, BranchKind, PowerPeak};
use serde::Serialize;

/// Branches of periodic orbits over the range of a key.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchResult {
    /// Path of the key.
    pub key: String,
    /// SI unit of the key.
    pub unit: String,
    /// Branches in the order of their computation.
    pub branches: Vec<Branch>,
    /// Largest mean power of a stable orbit on all branches; `None` without power or stable orbit.
    pub peak: Option<PowerPeak>,
    /// Half-power bandwidth of all branches combined; `None` without a peak.
    pub half_power_bandwidth: Option<HalfPowerBandwidth>,
    /// Note on the branches that the search may miss, and on the options that find more.
    pub note: String,
    /// Quantity that figures and texts show over the key.
    #[serde(skip)]
    pub quantity: BranchQuantity,
    /// Options of the search.
    #[serde(skip)]
    pub options: BranchOptions,
}

/// Branch of periodic orbits.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// Points along the branch.
    pub points: Vec<BranchPoint>,
    /// Bifurcations in the order of the branch.
    pub bifurcations: Vec<Bifurcation>,
    /// Intervals on which the listed events of a kind are not proved.
    pub not_proved: Vec<NotProved>,
    /// Terminations: at the first point, then at the last point.
    pub termination: Vec<Termination>,
    /// Number of period doublings whose branch was not continued: the budget was used up, or Newton
    /// iteration found no first orbit.
    pub not_followed: usize,
    /// Largest mean power of a stable orbit; `None` without power or stable orbit.
    pub peak: Option<PowerPeak>,
    /// Half-power bandwidth; `None` without a peak.
    pub half_power_bandwidth: Option<HalfPowerBandwidth>,
}

/// Point of a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchPoint {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Rms voltage of the first load, else of the output of the first rectifier, V.
    pub voltage_rms_v: f64,
    /// True where the orbit attracts.
    pub stable: bool,
    /// True where a Floquet multiplier has modulus one within its error.
    pub stability_undecided: bool,
    /// Largest modulus of a Floquet multiplier.
    pub floquet_max_abs: f64,
    /// Contacts per period.
    pub contacts_per_period: u64,
    /// Largest penetration of the stop, m.
    pub max_penetration_m: f64,
    /// Half the peak-to-peak displacement at the first stop, m.
    pub displacement_peak_m: f64,
    /// Larger of the estimated relative errors of the state and the mean power.
    pub error_estimate: f64,
    /// Exceeded limits of patches over a period.
    pub warnings: Vec<ExceededLimit>,
}

/// Bifurcation, grazing or level on a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bifurcation {
    /// Kind of the bifurcation.
    pub kind: BranchKind,
    /// Value of the key, SI.
    pub parameter: f64,
    /// Estimated error of the value of the key, SI, by integrations with a tenth of the tolerance;
    /// `None` where the event ends the branch.
    pub parameter_error: Option<f64>,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Half the peak-to-peak displacement at the first stop, m.
    pub displacement_peak_m: f64,
    /// Contacts per period.
    pub contacts_per_period: u64,
    /// Level that is crossed, as given; `None` for other kinds.
    pub level: Option<String>,
    /// Stop of a grazing or of sticking; `None` for other kinds.
    pub stop: Option<String>,
    /// Values of the key at the neighbouring points of the branch, SI; `None` where the event ends
    /// the branch.
    #[serde(skip)]
    pub neighbours: Option<[f64; 2]>,
}

/// Interval of a branch on which the listed events of a kind are not proved: there may be more, or
/// fewer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotProved {
    /// Kind of the event.
    pub event: BranchKind,
    /// Value of the key at the begin of the interval, SI.
    pub from: f64,
    /// Value of the key at the end of the interval, SI.
    pub to: f64,
    /// Reason why the proof failed.
    pub message: String,
}

/// Termination of a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Termination {
    /// The reason.
    pub reason: TerminationReason,
    /// Last value of the key, SI, where continuation stopped early.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameter: Option<f64>,
    /// Error of the last step, where continuation stopped early.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
}

/// Reason of a termination.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TerminationReason {
    /// The branch reached an end of the range.
    Range,
    /// The branch returned to its own start.
    Closed,
    /// The branch reached a branch of a shorter period.
    Merged,
    /// The branch reached the limit of points, or the budget was used up.
    Points,
    /// The branch turns at a grazing more sharply than any step can follow.
    Grazing,
    /// Sticking to a rigid stop begins.
    Sticking,
    /// Continuation failed.
    Failed,
}

/// Intervals of the key where a stable orbit has at least half the power of the peak.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HalfPowerBandwidth {
    /// Sum of the widths of the intervals, in the unit of the key.
    pub width: f64,
    /// Estimated error of the width, in the unit of the key.
    pub width_error: f64,
    /// Disjoint intervals, from low to high.
    pub intervals: Vec<BandInterval>,
}

/// Quantity of the orbits of a branch that figures and texts show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BranchQuantity {
    /// Mean power of all loads, W.
    MeanPower,
    /// Half the peak-to-peak displacement at the first stop, m, for a harvester without a circuit.
    Displacement,
}

impl Branch {
    /// True where continuation stopped early at no end.
    pub fn is_complete(&self) -> bool {
        let is_early = |one: &Termination| {
            matches!(
                one.reason,
                TerminationReason::Failed | TerminationReason::Points
            )
        };
        !self.termination.iter().any(is_early)
    }
}
