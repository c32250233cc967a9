//! What identifies an orbit in a link of the page.

use super::orbit::sample_states;
use jounce_analysis::SectionPoint;
use jounce_orbits::{Orbit, ShootingEvaluation};
use serde::{Deserialize, Serialize};

/// Samples per drive cycle that give the size of a motion.
const SAMPLES_PER_CYCLE: usize = 64;

/// What identifies an orbit of a design: the state at the start of a drive cycle determines the
/// motion. Unlike its mean power, no two orbits have it in common.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OrbitIdentity {
    /// Value of the key of the response, SI.
    pub parameter: f64,
    /// Period, in drive cycles.
    pub period_cycles: u32,
    /// Motion at the start of any drive cycle of the period.
    pub section: SectionPoint,
    /// Kind of the bifurcation whose orbit this is.
    pub bifurcation: Option<String>,
}

impl OrbitIdentity {
    /// Returns the distance of the motion at the start of a drive cycle from an orbit, relative to
    /// the size of its motion; `motion` is its period.
    pub(super) fn distance(&self, orbit: &Orbit, motion: &ShootingEvaluation) -> f64 {
        let plant = &motion.kernel.plant;
        let samples = SAMPLES_PER_CYCLE * orbit.period_cycles as usize;
        let states = sample_states(motion, samples);
        let points: Vec<SectionPoint> = states
            .iter()
            .map(|own| SectionPoint::of(&plant.system, &plant.to_physical(&own.state, own.time_s)))
            .collect();
        let size = size(&points);
        let starts = points.iter().step_by(SAMPLES_PER_CYCLE);
        let distances = starts.map(|point| self.distance_to(point, size));
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Returns the distance from a motion at the start of a drive cycle, relative to the size of
    /// each quantity.
    pub(super) fn distance_to(&self, point: &SectionPoint, size: [f64; 3]) -> f64 {
        let pairs = quantities(&self.section).into_iter().zip(quantities(point));
        let distances = pairs.zip(size).map(|((one, other), size)| {
            let difference = (one - other).abs();
            if difference > 0.0 {
                difference / size
            } else {
                0.0
            }
        });
        distances.fold(0.0, f64::max)
    }
}

/// Returns the largest magnitude of each quantity.
pub(super) fn size(points: &[SectionPoint]) -> [f64; 3] {
    let magnitudes = points.iter().map(|own| quantities(own).map(f64::abs));
    magnitudes.fold([0.0; 3], |size, own| [0, 1, 2].map(|k| own[k].max(size[k])))
}

fn quantities(point: &SectionPoint) -> [f64; 3] {
    [point.displacement_m, point.velocity_m_s, point.voltage_v]
}
