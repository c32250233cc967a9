//! Shapes over plates, in the middles of the cells of a grid.

use jounce_model::structure::{Modes, StructureError, modes_at};
use jounce_spec::{Plate, PlatePoint, Spec};
use std::collections::BTreeMap;

/// Number of cells along the longer side.
const CELLS: usize = 60;
/// Smallest number of cells along the shorter side.
const MIN_CELLS: usize = 8;

/// Modes over one plate.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateShapes {
    /// Name of the plate.
    pub name: String,
    /// Length and width, m.
    pub size_m: [f64; 2],
    /// Mass-normalised displacement of each mode, kg^-1/2, in the middle of each cell of an even
    /// grid: columns along the length, each with a value for every cell across the width.
    pub shapes_per_sqrt_kg: Vec<Vec<Vec<f64>>>,
}

impl PlateShapes {
    /// Returns the displacement in the middle of each cell, m, for given amplitudes of the modes,
    /// kg^1/2 m.
    pub(crate) fn displacement_m(&self, amplitudes: &[f64]) -> Vec<Vec<f64>> {
        let Some(first) = self.shapes_per_sqrt_kg.first() else {
            return Vec::new();
        };
        let mut sum: Vec<Vec<f64>> = first.iter().map(|own| vec![0.0; own.len()]).collect();
        for (shape, amplitude) in self.shapes_per_sqrt_kg.iter().zip(amplitudes) {
            let values = shape.iter().flatten();
            for (total, value) in sum.iter_mut().flatten().zip(values) {
                *total += amplitude * value;
            }
        }
        sum
    }
}

/// Returns the numbers of cells along the length and the width.
fn cells(plate: &Plate) -> [usize; 2] {
    let longer_m = plate.length_m.max(plate.width_m);
    [plate.length_m, plate.width_m].map(|side_m| {
        let cells = (CELLS as f64 * side_m / longer_m).round() as usize;
        cells.max(MIN_CELLS)
    })
}

/// Name of a point of the grid; a name with spaces is none of the spec.
fn point(i: usize, j: usize) -> String {
    format!("cell {i} {j}")
}

/// Returns the modes of a spec with some masses fixed, and their shapes over its plates.
pub(crate) fn modes_and_plates(
    spec: &Spec,
    held: &[String],
) -> Result<(Modes, Vec<PlateShapes>), StructureError> {
    let places = spec.plate.iter();
    let places = places.map(|(name, plate)| (name.clone(), middles(plate)));
    let mut modes = modes_at(spec, held, &places.collect())?;
    let count = modes.len();
    let plates = take_cells(spec, &mut modes.shape, count);
    Ok((modes, plates))
}

/// Returns the middles of the cells of a plate.
fn middles(plate: &Plate) -> Vec<(String, PlatePoint)> {
    let [columns, rows] = cells(plate);
    let middle = |i: usize, j: usize| PlatePoint {
        x_m: plate.length_m * (i as f64 + 0.5) / columns as f64,
        y_m: plate.width_m * (j as f64 + 0.5) / rows as f64,
    };
    (0..columns)
        .flat_map(|i| (0..rows).map(move |j| (point(i, j), middle(i, j))))
        .collect()
}

/// Takes the points of the cells out of the shapes at all points.
fn take_cells(
    spec: &Spec,
    shape: &mut BTreeMap<String, Vec<f64>>,
    modes: usize,
) -> Vec<PlateShapes> {
    let mut over = |(name, plate): (&String, &Plate)| {
        let [columns, rows] = cells(plate);
        let mut shapes = vec![vec![vec![0.0; rows]; columns]; modes];
        for i in 0..columns {
            for j in 0..rows {
                let values = shape.remove(&format!("{name}.{}", point(i, j)));
                let values = values.unwrap_or_default();
                for (shape, value) in shapes.iter_mut().zip(values) {
                    shape[i][j] = value;
                }
            }
        }
        PlateShapes {
            name: name.clone(),
            size_m: [plate.length_m, plate.width_m],
            shapes_per_sqrt_kg: shapes,
        }
    };
    spec.plate.iter().map(&mut over).collect()
}
