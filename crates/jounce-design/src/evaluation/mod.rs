//! Evaluation of one design: its goals and the quantities that have limits.

mod attractors;
mod bandwidth;
mod evaluator;
mod nearest_fold;
mod run_goals;

pub use evaluator::{Evaluator, OnImprovement};
pub use nearest_fold::examined_fold;
pub use run_goals::{REALISATIONS, RealisedRun, realised};

use crate::problem::Problem;
use serde::{Deserialize, Serialize};

/// Number of starts of a first evaluation, and of one that only looks for an orbit.
pub const SCREENING_STARTS: usize = 8;
const PROBE_STARTS: usize = 2;

/// Effort of an evaluation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Effort {
    /// Two starts for a few hundred drive cycles, to find an orbit.
    Probe,
    /// A few starts for a few hundred drive cycles.
    Screening,
    /// All starts, for more drive cycles; limits of a run under noise in all realisations.
    Full,
}

/// Result of an evaluation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Value of each goal, in its unit.
    pub goals: Vec<f64>,
    /// Value of each limited quantity, SI: the worst of all conditions, attractors and realisations.
    pub limits: Vec<f64>,
    /// Sum of the relative violations of the limits. Where a limit is on a peak, the share of the
    /// starts without a proved attractor is added: no peak is known of their motions.
    pub violation: f64,
    /// Share of the starts without a proved attractor.
    pub unknown_share: f64,
    /// Expected power with the ends of its 95 % interval, W; 0 where no goal needs it.
    pub expected_power_w: [f64; 3],
    /// Share of the starts that reach the main orbit with the ends of its 95 % interval.
    pub basin_fraction: [f64; 3],
    /// Main orbit of the first condition.
    pub orbit: Option<MainOrbit>,
    /// Main orbits of the further conditions.
    pub further_orbits: Vec<Option<MainOrbit>>,
    /// Reason why the design could not be evaluated.
    pub failure: Option<String>,
}

/// Main orbit of a design: the one that contributes most to the goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MainOrbit {
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// State at the start of the period, energy coordinates.
    pub state: Vec<f64>,
    /// Mean power, W.
    pub mean_power_w: f64,
}

/// Evaluation in a journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Journaled {
    place: Vec<f64>,
    effort: Effort,
    evaluation: Evaluation,
}

impl Evaluation {
    /// Returns the evaluation of a design that cannot be computed.
    fn failed(problem: &Problem, reason: String) -> Self {
        Self {
            goals: vec![0.0; problem.goals.len()],
            limits: vec![f64::NAN; problem.limits.len()],
            violation: f64::INFINITY,
            unknown_share: 1.0,
            expected_power_w: [0.0; 3],
            basin_fraction: [0.0; 3],
            orbit: None,
            further_orbits: Vec::new(),
            failure: Some(reason),
        }
    }

    /// True where the design keeps all limits.
    pub fn is_feasible(&self) -> bool {
        self.violation == 0.0
    }
}

/// Values in one condition.
struct InCondition {
    /// Goals that the attractors give; the others are NaN.
    goals: Vec<f64>,
    limits: Vec<f64>,
    /// Share of the starts without a proved attractor.
    unknown_share: f64,
    expected_power_w: [f64; 3],
    basin_fraction: [f64; 3],
    /// Orbits that the starts reach, the main one first.
    orbits: Vec<MainOrbit>,
}
