//! Integration of every start until its attractor is recognized, and the count of starts per
//! attractor.

use super::InitialStates;
use super::attractor::{Attractor, BasinsResult, counted, orbits};
use super::mirror::mirrored_states;
use crate::orbit_limits::{exceeded_by_orbit, exceeded_over_cycles};
use crate::run::{ExceededLimit, Limits, RunError, check_outside};
use crate::{AnalysisError, AttractingOrbit, KeyLine, Model, Recognition, Recognizer, SteadyState};
use jounce_dynamics::{IntegrationError, Kernel};
use jounce_orbits::{ParametricModel, Shooting};
use rayon::prelude::*;
use std::sync::Arc;

/// Drive cycles over which an aperiodic motion is compared with limits.
const LATE_CYCLES: u32 = 64;

/// Starts in the first batch. Each later batch is as large as all earlier ones combined and knows
/// their orbits, so few orbits are proved twice. The batches do not depend on the number of
/// threads.
const FIRST_BATCH: usize = 4;

/// Definition of a computation of basins of attraction.
#[derive(Debug)]
pub struct Basins<'s> {
    /// The spec.
    pub base: &'s Model,
    /// Initial states.
    pub starts: InitialStates,
    /// Options of the recognition of attractors.
    pub recognition: Recognition,
}

impl Basins<'_> {
    /// Integrates all starts in parallel. After cancellation the finished ones are counted.
    ///
    /// # Errors
    /// A model cannot be built.
    pub fn run(&self) -> Result<BasinsResult, AnalysisError> {
        let line = KeyLine::at(self.base);
        let kernel = line.at(0.0)?.kernel;
        self.base.kernel.control.expect(self.starts.len());
        let ends = self.ends(&line, &kernel);
        let scale = Shooting::new(&line, &kernel, 1, self.recognition.tolerance).scale;
        let mirrored = |one: &AttractingOrbit, two: &AttractingOrbit| {
            kernel.plant.period_s().is_some_and(|cycle_s| {
                let accuracy = (cycle_s, self.recognition.tolerance);
                mirrored_states(&kernel, &one.orbit, &scale, accuracy)
                    .is_ok_and(|states| two.passes(&states))
            })
        };
        let mut result = counted(&ends, mirrored);
        if result.attractors.len() > 1 {
            result.chaotic_transients = self.chaotic_transients(&kernel, &ends);
        }
        let limits = Limits::of(&self.base.spec, &kernel.plant);
        for attractor in result
            .attractors
            .iter_mut()
            .filter(|_| !limits.is_empty() && !self.base.kernel.control.is_stopped())
        {
            let end = ends
                .iter()
                .find(|(index, _)| attractor.starts.first() == Some(index))
                .map(|(_, end)| end);
            attractor.exceeded = self
                .exceeded_limits(&limits, (&line, &kernel), attractor, end)
                .map_err(RunError::from)?;
        }
        Ok(result)
    }

    /// Returns the index and the steady state of each start.
    fn ends(&self, line: &KeyLine<'_>, kernel: &Kernel) -> Vec<(usize, SteadyState)> {
        let recognizer = Recognizer {
            family: line,
            kernel,
            parameter: 0.0,
            options: self.recognition,
        };
        let control = &self.base.kernel.control;
        let end = |index: usize, known: &[Arc<AttractingOrbit>]| {
            if control.is_stopped() {
                return None;
            }
            let start = self.starts.start(&kernel.plant, index);
            let end = match check_outside(&kernel.plant, &start[..kernel.plant.system.modes.len()])
            {
                Ok(()) => recognizer.settle(&start, known),
                Err(inside) => SteadyState::Failed(inside.to_string()),
            };
            control.count();
            (!control.is_stopped()).then_some((index, end))
        };
        let mut ends: Vec<(usize, SteadyState)> = Vec::new();
        let mut first = 0;
        while first < self.starts.len() {
            let next = (2 * first).max(FIRST_BATCH).min(self.starts.len());
            let known: Vec<Arc<AttractingOrbit>> =
                orbits(&ends).into_iter().map(|(orbit, _)| orbit).collect();
            ends.par_extend(
                (first..next)
                    .into_par_iter()
                    .filter_map(|index| end(index, &known)),
            );
            first = next;
        }
        ends
    }

    /// Returns the starts that reach an orbit after a chaotic transient.
    fn chaotic_transients(&self, kernel: &Kernel, ends: &[(usize, SteadyState)]) -> Vec<usize> {
        let (control, tolerance) = (&self.base.kernel.control, self.recognition.tolerance);
        let Some(cycle_s) = kernel.plant.period_s() else {
            return Vec::new();
        };
        let is_chaotic = |end: &SteadyState| match end {
            SteadyState::Periodic(reached) => {
                !control.is_stopped() && reached.has_chaotic_transient(kernel, cycle_s, tolerance)
            }
            SteadyState::Aperiodic(_) | SteadyState::Failed(_) => false,
        };
        ends.par_iter()
            .filter(|(_, end)| is_chaotic(end))
            .map(|(index, _)| *index)
            .collect()
    }

    /// Returns the limits that an attractor exceeds: over its period, or, if aperiodic, over
    /// further cycles from the end of its first start.
    fn exceeded_limits(
        &self,
        limits: &Limits,
        (line, kernel): (&KeyLine<'_>, &Kernel),
        attractor: &Attractor,
        end: Option<&SteadyState>,
    ) -> Result<Vec<ExceededLimit>, IntegrationError> {
        let tolerance = self.recognition.tolerance;
        match (attractor.orbit(), end) {
            (Some(orbit), _) => exceeded_by_orbit(limits, (line, kernel), orbit, tolerance),
            (None, Some(SteadyState::Aperiodic(end))) => {
                exceeded_over_cycles(limits, kernel, &end.state, LATE_CYCLES, tolerance)
            }
            (None, _) => Ok(Vec::new()),
        }
    }
}
