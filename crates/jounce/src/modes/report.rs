//! Table and figures of modes.

use super::{BeamShapes, ModeResult, ModesResult};
use crate::error::Error;
use jounce_io::table::{Column, Table};
use jounce_plot::{Figure, ModeShape, mode_shapes};

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

    /// Returns the figures of the first shapes along each beam, with their names.
    pub fn figures(&self) -> Vec<(String, Figure)> {
        let figure = |beam: &BeamShapes| (format!("modes-{}", beam.name), self.shapes(beam));
        self.beams.iter().map(figure).collect()
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
