//! Where one march at one value of the key ends.

use super::SectionPoint;
use crate::march::{Kernel, MarchError, Marcher};
use crate::orbit::Harvester;
use crate::study::basins::Signature;
use crate::study::{Fate, Parameter, Prepared, StudyError, Wandering, Way};
use serde::{Deserialize, Serialize};

/// Drive cycles before points of a motion without a period are kept.
const TRANSIENT_CYCLES: u32 = 500;

/// What a motion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Motion {
    /// Periodic.
    Orbit,
    /// Neighbours part exponentially.
    Chaos,
    /// Neighbours keep their distance.
    Torus,
    /// Not settled after a long march.
    Unsettled,
    /// The march failed.
    Lost,
}

/// A march at one value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Visit {
    /// Place in the diagram, from 0.
    pub index: usize,
    /// Value of the key, SI.
    pub parameter: f64,
    /// How it was reached.
    pub direction: Way,
    /// Number of the start in its cloud, 0 when stepped.
    pub start: usize,
    /// What the motion is.
    pub motion: Motion,
    /// Drive cycles of the period, 0 for none.
    pub period_cycles: u32,
    /// Contacts per period, 0 for none.
    pub contacts_per_period: u64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// The motion at the start of each drive cycle: of one period, or of as many cycles as were asked for.
    pub section: Vec<SectionPoint>,
    /// Physical state `(q, q', V)` at the start of a drive cycle.
    pub end: Vec<f64>,
}

/// A place in a diagram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    pub index: usize,
    pub parameter: f64,
    pub direction: Way,
    pub start: usize,
}

impl Motion {
    /// Name in answers.
    pub fn name(self) -> &'static str {
        match self {
            Motion::Orbit => "orbit",
            Motion::Chaos => "chaos",
            Motion::Torus => "torus",
            Motion::Unsettled => "unsettled",
            Motion::Lost => "lost",
        }
    }
}

impl From<Wandering> for Motion {
    fn from(kind: Wandering) -> Self {
        match kind {
            Wandering::Chaos => Motion::Chaos,
            Wandering::Torus => Motion::Torus,
            Wandering::Unsettled => Motion::Unsettled,
        }
    }
}

impl Visit {
    /// Marches from a physical start; motions without a period show `cycles` points.
    pub(super) fn march(
        (base, parameter): (&Prepared, &Parameter),
        place: Place,
        start: &[f64],
        (cycles, tolerance): (u32, f64),
    ) -> Result<Self, StudyError> {
        let kernel = parameter.at(place.parameter)?.kernel;
        let Place { index, parameter: value, direction, start: number } = place;
        let mut visit = Self {
            index,
            parameter: value,
            direction,
            start: number,
            motion: Motion::Lost,
            period_cycles: 0,
            contacts_per_period: 0,
            mean_power_w: 0.0,
            section: Vec::new(),
            end: vec![0.0; start.len()],
        };
        match Fate::of(parameter, (&kernel, value), start, tolerance) {
            Fate::Orbit(orbit) => {
                let shooting = crate::orbit::Shooting::new(parameter, &base.kernel, orbit.period_cycles, tolerance);
                visit.motion = Motion::Orbit;
                visit.period_cycles = orbit.period_cycles;
                visit.contacts_per_period = orbit.contacts;
                visit.mean_power_w = orbit.mean_power_w;
                visit.end = shooting.physical(orbit.start());
                visit.section = SectionPoint::of_orbit(base, parameter, value, &orbit)?;
            }
            Fate::Wandering(found) => {
                if let Ok(states) = looks(&kernel, start, cycles, tolerance) {
                    visit.motion = found.wandering().into();
                    visit.mean_power_w = found.mean_power_w;
                    visit.section = states.iter().map(|state| SectionPoint::of(&kernel.plant.system, state)).collect();
                    visit.end = states.into_iter().next_back().unwrap_or(visit.end);
                }
            }
            Fate::Lost(_) => {}
        }
        Ok(visit)
    }

    /// True when both end on the same attractor: one orbit, or motions of one kind.
    pub(super) fn is_of(&self, other: &Visit) -> bool {
        self.motion == other.motion && (self.motion != Motion::Orbit || self.signature().is(&other.signature()))
    }

    /// Distance of the sections of two orbits of one period beside the larger of them, at the best order of their points; `None`
    /// without a period.
    pub(super) fn apart(&self, other: &Visit) -> Option<f64> {
        let cycles = self.section.len();
        if self.period_cycles == 0 || cycles == 0 || other.section.len() != cycles {
            return None;
        }
        let largest = |read: fn(&SectionPoint) -> f64| {
            self.section.iter().chain(&other.section).map(|point| read(point).abs()).fold(f64::MIN_POSITIVE, f64::max)
        };
        let (far_m, fast_m_per_s) = (largest(|point| point.displacement_m), largest(|point| point.velocity_m_per_s));
        let between = |a: &SectionPoint, b: &SectionPoint| {
            ((a.displacement_m - b.displacement_m) / far_m).hypot((a.velocity_m_per_s - b.velocity_m_per_s) / fast_m_per_s)
        };
        let turned = |by: usize| (0..cycles).map(|k| between(&self.section[k], &other.section[(k + by) % cycles])).fold(0.0, f64::max);
        (0..cycles).map(turned).min_by(f64::total_cmp)
    }

    fn signature(&self) -> Signature {
        Signature { period_cycles: self.period_cycles, contacts: self.contacts_per_period, mean_power_w: self.mean_power_w }
    }
}

/// Physical states at the start of drive cycles after a transient.
fn looks(kernel: &Kernel, start: &[f64], cycles: u32, tolerance: f64) -> Result<Vec<Vec<f64>>, MarchError> {
    let cycle_s = kernel.plant.period_s().unwrap_or(1.0);
    let mut marcher = Marcher::new(kernel, &kernel.plant.from_physical(start, 0.0), 0.0, tolerance)?;
    let mut states = Vec::new();
    for cycle in TRANSIENT_CYCLES..TRANSIENT_CYCLES + cycles.max(1) {
        marcher.advance_to(f64::from(cycle) * cycle_s)?;
        states.push(kernel.plant.to_physical(&marcher.state(), 0.0));
    }
    Ok(states)
}
