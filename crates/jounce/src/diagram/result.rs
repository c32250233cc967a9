//! Result of a bifurcation diagram.

use crate::branch::Branch;
use jounce_analysis as analysis;
use jounce_analysis::{AttractorKind, AttractorTrack, SweepDirection};
use serde::Serialize;

/// Poincare sections over the values of a key.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DiagramResult {
    /// Path of the key.
    pub key: String,
    /// SI unit of the key.
    pub unit: String,
    /// Runs in order, fewer than `expected` after a stop by the control.
    pub points: Vec<DiagramPoint>,
    /// Attractors along the key; only with direction starts.
    pub attractors: Option<Vec<AttractorTrack>>,
    /// Number of runs of the complete diagram.
    #[serde(skip)]
    pub expected: usize,
    /// Branches continued over the same range.
    #[serde(skip)]
    pub branches: Vec<Branch>,
    /// Displacement towards the stop at the start of each drive cycle of each point of each branch,
    /// m.
    #[serde(skip)]
    pub branch_displacement_m: Vec<Vec<Vec<f64>>>,
}

/// End of one run at one value of the key.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DiagramPoint {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Direction from which the value was reached; `independent` from a start of the cloud.
    pub direction: SweepDirection,
    /// Number of the start in its cloud, 0 when stepped.
    pub start: usize,
    /// Id of the attractor; `None` when stepped, or where the run failed.
    pub attractor: Option<String>,
    /// Kind of the attractor; `lost` where the run failed.
    pub motion: AttractorKind,
    /// Period in drive cycles; 0 without a period.
    pub period_cycles: u32,
    /// Contacts per period; 0 without a period.
    pub contacts_per_period: u64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Poincare section at the start of each drive cycle.
    pub section: Vec<SectionPoint>,
}

/// Point of a Poincare section.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SectionPoint {
    /// Displacement towards the first stop, m.
    pub displacement_m: f64,
    /// Velocity towards the first stop, m/s.
    pub velocity_m_s: f64,
    /// Voltage of the first patch, V.
    pub voltage_v: f64,
}

impl DiagramPoint {
    pub(super) fn new(point: &analysis::DiagramPoint, attractor: Option<String>) -> Self {
        let section = |point: &analysis::SectionPoint| SectionPoint {
            displacement_m: point.displacement_m,
            velocity_m_s: point.velocity_m_s,
            voltage_v: point.voltage_v,
        };
        Self {
            parameter: point.parameter,
            direction: point.direction,
            start: point.start,
            attractor,
            motion: point.motion,
            period_cycles: point.period_cycles,
            contacts_per_period: point.contacts_per_period,
            mean_power_w: point.mean_power_w,
            section: point.section.iter().map(section).collect(),
        }
    }

    /// True where the run failed.
    pub fn is_lost(&self) -> bool {
        self.motion == AttractorKind::Lost
    }
}
