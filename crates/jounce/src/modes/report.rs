//! Table and figures of modes.

use super::{BeamShapes, ModeResult, ModesResult, PlateShapes};
use crate::error::Error;
use jounce_io::table::{Column, Table};
use jounce_plot::{Figure, ModeShape, PlateShape, mode_shapes, plate_shapes};

/// Largest number of shapes in a figure.
const MAX_DRAWN_MODES: usize = 5;

impl ModesResult {
    /// Returns the table of the modes.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let column = |name: &str, unit: &str, about: &str, value: fn(&ModeResult) -> f64| {
            let values: Vec<f64> = self.modes.iter().map(value).collect();
            Column::new(name, unit, about, values)
        };
        Ok(Table::new(vec![
            column(
                "frequency_hz",
                "Hz",
                "undamped short-circuit frequency",
                |mode| mode.frequency_hz,
            ),
            column("damping_ratio", "", "damping ratio", |mode| {
                mode.damping_ratio
            }),
            column(
                "discretisation_error",
                "",
                "estimated relative error of the frequency",
                |mode| mode.discretisation_error,
            ),
        ])?)
    }

    /// Returns the figures of the first shapes along each beam and over each plate, with their names.
    pub fn figures(&self) -> Vec<(String, Figure)> {
        let beam = |beam: &BeamShapes| (format!("modes-{}", beam.name), self.shapes(beam));
        let plate = |plate: &PlateShapes| (format!("modes-{}", plate.name), self.over(plate));
        let beams = self.beams.iter().map(beam);
        beams.chain(self.plates.iter().map(plate)).collect()
    }

    fn over(&self, plate: &PlateShapes) -> Figure {
        let modes = self.modes.iter().zip(&plate.shapes_per_sqrt_kg);
        let shape = |(index, (mode, shape)): (usize, (&ModeResult, &Vec<Vec<f64>>))| PlateShape {
            label: format!("{}: {:.2} Hz", index + 1, mode.frequency_hz),
            columns: shape.clone(),
        };
        let shapes: Vec<PlateShape> = modes.take(MAX_DRAWN_MODES).enumerate().map(shape).collect();
        let title = format!("Mode shapes of {}", plate.name);
        plate_shapes(&title, plate.size_m, &shapes)
    }

    fn shapes(&self, beam: &BeamShapes) -> Figure {
        let modes = self.modes.iter().zip(&beam.shapes_per_sqrt_kg);
        let shapes: Vec<ModeShape> = modes
            .take(MAX_DRAWN_MODES)
            .enumerate()
            .map(|(index, (mode, shape))| ModeShape {
                label: format!("{}: {:.2} Hz", index + 1, mode.frequency_hz),
                displacement: shape.clone(),
            })
            .collect();
        let title = format!("Mode shapes of {}", beam.name);
        mode_shapes(&title, &beam.place_m, &shapes, &beam.patches)
    }
}
