//! End of one integration at one value of the key.

use super::SectionPoint;
use crate::branches::SAME_ORBIT_DISTANCE;
use crate::{
    AnalysisError, AttractorKind, Model, Parameter, Recognition, Recognizer, SteadyState,
    SweepDirection,
};
use jounce_dynamics::{IntegrationError, Integrator, Kernel};
use jounce_orbits::{Orbit, ParametricModel, Shooting};
use serde::{Deserialize, Serialize};

/// Result of an integration at one value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiagramPoint {
    /// Index in the diagram, from 0.
    pub index: usize,
    /// Value of the key, SI.
    pub parameter: f64,
    /// Direction from which it was reached.
    pub direction: SweepDirection,
    /// Number of the start in its cloud, 0 when stepped.
    pub start: usize,
    /// Kind of the attractor.
    pub motion: AttractorKind,
    /// Drive cycles of the period, 0 for an aperiodic motion.
    pub period_cycles: u32,
    /// Contacts per period, 0 without contact.
    pub contacts_per_period: u64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Poincare section at the start of each drive cycle: over one period, or over the requested
    /// number of cycles.
    pub section: Vec<SectionPoint>,
    /// Physical state `(q, q', V)` at the start of a drive cycle.
    pub end: Vec<f64>,
}

/// Index, value, direction and start of one point in a diagram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionState {
    pub index: usize,
    pub parameter: f64,
    pub direction: SweepDirection,
    pub start: usize,
}

impl DiagramPoint {
    /// Integrates from a physical start; an aperiodic motion has `cycles` section points.
    pub(super) fn integrate(
        (base, parameter): (&Model, &Parameter),
        section_state: SectionState,
        start: &[f64],
        (cycles, tolerance): (u32, f64),
    ) -> Result<Self, AnalysisError> {
        let kernel = parameter.at(section_state.parameter)?.kernel;
        let SectionState {
            index,
            parameter: value,
            direction,
            start: number,
        } = section_state;
        let mut visit = Self {
            index,
            parameter: value,
            direction,
            start: number,
            motion: AttractorKind::Lost,
            period_cycles: 0,
            contacts_per_period: 0,
            mean_power_w: 0.0,
            section: Vec::new(),
            end: vec![0.0; start.len()],
        };
        let options = Recognition::at(tolerance);
        let steady_state = Recognizer {
            family: parameter,
            kernel: &kernel,
            parameter: value,
            options,
        }
        .settle(start, &[]);
        visit.motion = steady_state.kind();
        match steady_state {
            SteadyState::Periodic(reached) => {
                visit.set_orbit((base, parameter), &reached.attracting.orbit, tolerance)?;
            }
            SteadyState::Aperiodic(steady_state) => {
                let states = kernel.plant.period_s().map(|cycle_s| {
                    strobe_states(&kernel, &steady_state.state, (cycles, cycle_s), tolerance)
                });
                match states {
                    Some(Ok(states)) => {
                        visit.mean_power_w = steady_state.mean_power_w;
                        visit.section = states
                            .iter()
                            .map(|state| SectionPoint::of(&kernel.plant.system, state))
                            .collect();
                        visit.end = states.into_iter().next_back().unwrap_or(visit.end);
                    }
                    Some(Err(_)) | None => visit.motion = AttractorKind::Lost,
                }
            }
            SteadyState::Failed(_) => {}
        }
        Ok(visit)
    }

    /// Stores the values of the orbit on which the integration ended.
    fn set_orbit(
        &mut self,
        (base, parameter): (&Model, &Parameter),
        orbit: &Orbit,
        tolerance: f64,
    ) -> Result<(), AnalysisError> {
        let shooting = Shooting::new(parameter, &base.kernel, orbit.period_cycles, tolerance);
        self.period_cycles = orbit.period_cycles;
        self.contacts_per_period = orbit.contacts;
        self.mean_power_w = orbit.mean_power_w;
        self.end = shooting.physical(orbit.start());
        self.section = SectionPoint::of_orbit(base, parameter, self.parameter, orbit)?;
        Ok(())
    }

    /// True when both end on one attractor: on one orbit, or on aperiodic motions of one kind.
    pub(super) fn is_of(&self, other: &DiagramPoint) -> bool {
        self.motion == other.motion
            && (self.motion != AttractorKind::Orbit
                || self
                    .distance(other)
                    .is_some_and(|distance| distance < SAME_ORBIT_DISTANCE))
    }

    /// Distance of the sections of two orbits of one period, relative to the larger section,
    /// minimised over the order of their points; `None` for an aperiodic motion.
    pub(super) fn distance(&self, other: &DiagramPoint) -> Option<f64> {
        let cycles = self.section.len();
        if self.period_cycles == 0 || cycles == 0 || other.section.len() != cycles {
            return None;
        }
        let largest = |read: fn(&SectionPoint) -> f64| {
            self.section
                .iter()
                .chain(&other.section)
                .map(|point| read(point).abs())
                .fold(f64::MIN_POSITIVE, f64::max)
        };
        let (far_m, fast_m_s) = (
            largest(|point| point.displacement_m),
            largest(|point| point.velocity_m_s),
        );
        let between = |a: &SectionPoint, b: &SectionPoint| {
            ((a.displacement_m - b.displacement_m) / far_m)
                .hypot((a.velocity_m_s - b.velocity_m_s) / fast_m_s)
        };
        let rotated_distance = |by: usize| {
            (0..cycles)
                .map(|k| between(&self.section[k], &other.section[(k + by) % cycles]))
                .fold(0.0, f64::max)
        };
        (0..cycles).map(rotated_distance).min_by(f64::total_cmp)
    }
}

/// Returns the physical states at the start of drive cycles of a length, the given one first.
fn strobe_states(
    kernel: &Kernel,
    start: &[f64],
    (cycles, cycle_s): (u32, f64),
    tolerance: f64,
) -> Result<Vec<Vec<f64>>, IntegrationError> {
    let mut integrator = Integrator::new(
        kernel,
        &kernel.plant.from_physical(start, 0.0),
        0.0,
        tolerance,
    )?;
    let mut states = vec![start.to_vec()];
    for cycle in 1..cycles.max(1) {
        integrator.advance_to(f64::from(cycle) * cycle_s)?;
        states.push(kernel.plant.to_physical(&integrator.state(), 0.0));
    }
    Ok(states)
}
