//! Branches of a model next to another one with known orbits, fast enough for interactive use.
//!
//! Newton's method corrects every known orbit at its own value of the key, and both directions are
//! followed from there. Nothing is integrated to a steady state, so branches without a known orbit
//! are not found: [`BranchSearch`](super::BranchSearch) finds those.

use super::branch::Branch;
use super::branch_tracer::tracer::BranchTracer;
use crate::{AnalysisError, Parameter};
use jounce_continuation::{Metric, Position, StepControl, correct_at};
use jounce_dynamics::Kernel;
use jounce_orbits::{Orbit, OrbitError, OrbitMethod, ParametricModel, Shooting};

/// Orbit of a neighbouring model.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownOrbit {
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// State at the start of the period, energy coordinates.
    pub state: Vec<f64>,
    /// Value of the key, SI.
    pub parameter: f64,
}

impl KnownOrbit {
    /// Returns the orbit of another model next to this one; `None` where Newton's method fails or
    /// finds an orbit of a shorter period.
    pub(super) fn corrected<H: ParametricModel>(
        &self,
        tracer: &BranchTracer,
        shooting: &Shooting<'_, H>,
        parameter: f64,
    ) -> Option<Orbit> {
        if self.state.len() != shooting.scale.len() {
            return None;
        }
        let position = Position {
            unknown: self.state.clone(),
            parameter,
        };
        let metric = Metric::at(&position, tracer.parameter_scale());
        let corrected = correct_at(shooting, &tracer.corrector, &metric, position).ok()?;
        let orbit = shooting.orbit(&corrected.local, corrected.error).ok()?;
        (!orbit.repeats_early()).then_some(orbit)
    }
}

/// Definition of a continuation from known orbits.
#[derive(Debug)]
pub struct WarmStart<'s> {
    /// Family of models over the key.
    pub family: &'s Parameter<'s>,
    /// Kernel of one of these models.
    pub kernel: &'s Kernel,
    /// Ends of the range of the key.
    pub range: (f64, f64),
    /// Relative tolerance of the integrations.
    pub tolerance: f64,
    /// Step size control.
    pub control: StepControl,
    /// Length in the metric (a twentieth of the range counts as one) to which bifurcations are
    /// located.
    pub resolution: f64,
}

impl WarmStart<'_> {
    /// Follows the branches; known orbits at which Newton's method fails are omitted.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run(&self, known: &[KnownOrbit]) -> Result<Vec<Branch>, OrbitError<AnalysisError>> {
        let tracer = BranchTracer {
            control: self.control,
            most_points: 2000,
            resolution: self.resolution,
            ..BranchTracer::new(self.range, self.tolerance)
        };
        let mut branches: Vec<Branch> = Vec::new();
        for orbit in known {
            let parameter = orbit.parameter.clamp(self.range.0, self.range.1);
            let shooting = Shooting::new(
                self.family,
                self.kernel,
                orbit.period_cycles,
                self.tolerance,
            );
            let Some(corrected) = orbit.corrected(&tracer, &shooting, parameter) else {
                continue;
            };
            if branches
                .iter()
                .any(|branch| branch.holds(&tracer, &shooting, (&corrected, parameter)))
            {
                continue;
            }
            branches.extend(tracer.both_ways(&shooting, corrected.start(), parameter)?);
        }
        Ok(branches)
    }
}
