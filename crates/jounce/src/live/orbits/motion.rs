//! Motion of the beams over the period of an orbit.

use super::orbit::sample_states;
use jounce_dynamics::TrajectoryState;
use jounce_model::structure::BeamShape;
use jounce_orbits::ShootingEvaluation;
use serde::Serialize;
use std::collections::BTreeMap;

/// Frames of the motion in a period.
const FRAMES_PER_PERIOD: usize = 240;

/// Motion of one beam over the period of an orbit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BeamMotion {
    /// Name.
    pub name: String,
    /// Distances from the root, m.
    pub position_m: Vec<f64>,
    /// Displacement at each position, m, frame after frame.
    pub displacement_m: Vec<f64>,
}

impl BeamMotion {
    /// Returns the largest displacement relative to the root, m.
    pub(super) fn max_deflection_m(&self) -> f64 {
        let frames = self.displacement_m.chunks_exact(self.position_m.len());
        let deflections = frames.flat_map(|frame| frame.iter().map(|own| (own - frame[0]).abs()));
        deflections.fold(0.0, f64::max)
    }
}

/// Returns the number of frames and the motion of each beam.
pub(super) fn of_beams(
    evaluation: &ShootingEvaluation,
    shapes: &BTreeMap<String, BeamShape>,
) -> (usize, Vec<BeamMotion>) {
    let plant = &evaluation.kernel.plant;
    let instants = sample_states(evaluation, FRAMES_PER_PERIOD);
    let modes = plant.system.modes.len();
    let motion = |(name, beam): (&String, &BeamShape)| {
        let frame = |instant: &TrajectoryState| {
            let state = plant.to_physical(&instant.state, instant.time_s);
            let deflection = |shape: &Vec<f64>| -> f64 {
                let terms = shape.iter().zip(&state[..modes]);
                terms.map(|(s, q)| s * q).sum()
            };
            beam.shape.iter().map(deflection).collect::<Vec<f64>>()
        };
        BeamMotion {
            name: name.clone(),
            position_m: beam.place_m.clone(),
            displacement_m: instants.iter().flat_map(frame).collect(),
        }
    };
    (instants.len(), shapes.iter().map(motion).collect())
}
