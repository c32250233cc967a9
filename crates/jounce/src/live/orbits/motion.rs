//! Motion of the beams and plates over the period of an orbit.

use super::orbit::sample_states;
use crate::error::Error;
use crate::live::analysis::Shapes;
use crate::modes::PlateShapes;
use jounce_dynamics::TrajectoryState;
use jounce_model::structure::BeamShape;
use jounce_orbits::ShootingEvaluation;
use jounce_plot::plate_motion;
use serde::Serialize;

/// Frames of the motion in a period.
const FRAMES_PER_PERIOD: usize = 240;
/// Instants of the period at which a plate is drawn.
const PLATE_INSTANTS: usize = 24;

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

/// Motion of one plate over the period of an orbit, at equidistant instants.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlateMotion {
    /// Name.
    pub name: String,
    /// Length and width, m.
    pub size_m: [f64; 2],
    /// Displacement at each instant, m, in the middle of each cell of an even grid: columns along
    /// the length, each with a value for every cell across the width.
    pub displacement_m: Vec<Vec<Vec<f64>>>,
}

impl PlateMotion {
    /// Returns the largest displacement, m.
    pub fn max_displacement_m(&self) -> f64 {
        let values = self.displacement_m.iter().flatten().flatten();
        values.fold(0.0, |max, w| w.abs().max(max))
    }

    /// Draws the plate at each instant: SVG documents of filled contours with nodal lines, whose
    /// colours go from the negative to the positive of the largest displacement.
    ///
    /// # Errors
    /// [`Error::Picture`].
    pub fn pictures(&self) -> Result<Vec<String>, Error> {
        let figures = plate_motion(self.size_m, &self.displacement_m, self.max_displacement_m());
        let svg = figures.iter().map(|figure| Ok(figure.to_svg()?));
        svg.collect()
    }
}

/// Motion of all bodies.
pub(super) struct Motion {
    /// Number of frames of the beams.
    pub frames: usize,
    /// Each beam.
    pub beams: Vec<BeamMotion>,
    /// Each plate.
    pub plates: Vec<PlateMotion>,
}

/// Returns the motion of the beams and plates.
pub(super) fn of_bodies(evaluation: &ShootingEvaluation, shapes: &Shapes) -> Motion {
    let plant = &evaluation.kernel.plant;
    let instants = sample_states(evaluation, FRAMES_PER_PERIOD);
    let modes = plant.system.modes.len();
    let amplitudes = |instant: &TrajectoryState| {
        let mut state = plant.to_physical(&instant.state, instant.time_s);
        state.truncate(modes);
        state
    };
    let amplitudes: Vec<Vec<f64>> = instants.iter().map(amplitudes).collect();
    let of_beam = |(name, beam): (&String, &BeamShape)| {
        let frame = |modal: &Vec<f64>| {
            let deflection = |shape: &Vec<f64>| -> f64 {
                let terms = shape.iter().zip(modal);
                terms.map(|(s, q)| s * q).sum()
            };
            beam.shape.iter().map(deflection).collect::<Vec<f64>>()
        };
        BeamMotion {
            name: name.clone(),
            position_m: beam.place_m.clone(),
            displacement_m: amplitudes.iter().flat_map(frame).collect(),
        }
    };
    let of_plate = |plate: &PlateShapes| {
        let frames = amplitudes.len();
        let instants = (0..PLATE_INSTANTS).map(|k| &amplitudes[k * frames / PLATE_INSTANTS]);
        PlateMotion {
            name: plate.name.clone(),
            size_m: plate.size_m,
            displacement_m: instants.map(|modal| plate.displacement_m(modal)).collect(),
        }
    };
    Motion {
        frames: amplitudes.len(),
        beams: shapes.beams.iter().map(of_beam).collect(),
        plates: shapes.plates.iter().map(of_plate).collect(),
    }
}
