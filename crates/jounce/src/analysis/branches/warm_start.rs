//! Branches of a harvester next to another one whose orbits are known: what can be had in the time of a frame.
//!
//! Every known orbit is corrected by Newton at its own value of the key, and followed both ways from there. Nothing is marched to rest,
//! so that branches on which no known orbit lies are not found: [`BranchSearch`](super::BranchSearch) finds those.

use super::branch::Branch;
use super::tracer::{BranchTracer, newton_goal};
use crate::analysis::{AnalysisError, Parameter};
use crate::continuation::{Corrector, Metric, Position, StepControl, correct_at};
use crate::integrate::Kernel;
use crate::orbit::{OrbitError, OrbitMethod, Shooting};

/// An orbit of a neighbouring harvester.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownOrbit {
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// State at the start of the period, energy coordinates.
    pub state: Vec<f64>,
    /// Value of the key, SI.
    pub parameter: f64,
}

/// Branches to be followed from known orbits.
#[derive(Debug)]
pub struct WarmStart<'s> {
    /// The harvesters.
    pub harvester: &'s Parameter<'s>,
    /// One of them.
    pub kernel: &'s Kernel,
    /// Ends of the range of the key.
    pub range: (f64, f64),
    /// Relative tolerance of the marches.
    pub tolerance: f64,
    /// The law of the step.
    pub control: StepControl,
    /// Length in the metric (a twentieth of the range counts as one) to which bifurcations are located.
    pub resolution: f64,
}

impl WarmStart<'_> {
    /// Follows the branches; a known orbit that Newton does not find again is left out.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run(&self, known: &[KnownOrbit]) -> Result<Vec<Branch>, OrbitError<AnalysisError>> {
        let goal = newton_goal(self.tolerance);
        let following = BranchTracer {
            range: self.range,
            corrector: Corrector { goal, most: 8 },
            control: self.control,
            most_points: 2000,
            budget: usize::MAX,
            resolution: self.resolution,
            levels: Vec::new(),
        };
        let mut branches: Vec<Branch> = Vec::new();
        for orbit in known {
            let parameter = orbit.parameter.clamp(self.range.0, self.range.1);
            let shooting = Shooting::new(
                self.harvester,
                self.kernel,
                orbit.period_cycles,
                self.tolerance,
            );
            if orbit.state.len() != shooting.scale.len() {
                continue;
            }
            let position = Position {
                unknown: orbit.state.clone(),
                parameter,
            };
            let Ok(found) = correct_at(
                &shooting,
                &following.corrector,
                &Metric::at(&position, following.parameter_scale()),
                position,
            ) else {
                continue;
            };
            let there = shooting.orbit(&found.local, found.error)?;
            if there.repeats_early()
                || branches
                    .iter()
                    .any(|branch| branch.holds(&following, &shooting, (&there, parameter)))
            {
                continue;
            }
            branches.extend(following.both_ways(&shooting, there.start(), parameter)?);
        }
        Ok(branches)
    }
}
