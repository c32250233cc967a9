//! Modes of the plates of a spec.

use super::layout::PlateLayout;
use super::mesh::{PlateMesh, ProductRow};
use super::refinement::refined;
use crate::structure::PlatePlaces;
use crate::structure::error::StructureError;
use crate::structure::modes::{Modes, PatchModes, PlaceStrain};
use jounce_linalg::Mat;
use jounce_sparse::{SparseError, lowest_modes};
use jounce_spec::{GROUND, Plate, PlatePoint, Spec};

/// Places in each direction of an element at which the strain of a patch is taken.
const STRAIN_POINTS: usize = 5;
/// Places in each direction of a plate that decide the signs of its modes.
const SIGN_POINTS: usize = 3;

/// Required relative error of an eigenvalue of a mesh.
const EIGEN_TOLERANCE: f64 = 1e-12;

/// Lowest modes of a plate on one mesh.
#[derive(Debug, Clone)]
pub(super) struct MeshModes {
    pub frequency_rad_s: Vec<f64>,
    /// Mass-normalised, one column per mode.
    shapes: Mat<f64>,
}

/// Returns the lowest `count` modes of every plate, without damping, with their values at more
/// places.
///
/// # Errors
/// `NotPositive` for a capacitance, and those of [`refined`].
pub(in crate::structure) fn plate_modes(
    spec: &Spec,
    count: usize,
    places: &PlatePlaces,
) -> Result<Vec<Modes>, StructureError> {
    let of_plate = |(name, plate): (&String, &Plate)| {
        let layout = PlateLayout::new(spec, name, plate);
        for (patch_name, _, patch) in &layout.patches {
            let key = format!("patch.{patch_name}.capacitance");
            StructureError::positive(key, patch.clamped_in_plane_capacitance_f())?;
        }
        let (mesh, modes, error) = refined(&layout, count, spec.reduction.mesh_tolerance)?;
        let mut converted = modes.converted(spec, &mesh, error);
        for (place_name, place) in places.get(name).into_iter().flatten() {
            let values = modes.modal(&mesh.row(*place, [0, 0]));
            converted
                .shape
                .insert(format!("{name}.{place_name}"), values);
        }
        Ok(converted)
    };
    spec.plate.iter().map(of_plate).collect()
}

impl MeshModes {
    /// Solves the eigenproblem of a mesh; at most `count` modes.
    ///
    /// # Errors
    /// `NotRepresentable` if the numbers exceed the range of double precision, else
    /// `PlateWithoutModes`.
    pub fn new(mesh: &PlateMesh, count: usize) -> Result<Self, StructureError> {
        let refused = |error| match error {
            SparseError::NotFinite { .. } => StructureError::NotRepresentable {
                body: mesh.layout.name.into(),
            },
            other => StructureError::PlateWithoutModes {
                plate: mesh.layout.name.into(),
                reason: other.to_string(),
            },
        };
        let [stiffness, mass] = mesh.matrices().map_err(refused)?;
        let lowest = lowest_modes(
            &stiffness,
            &mass,
            count.min(mesh.unknowns()),
            EIGEN_TOLERANCE,
        )
        .map_err(refused)?;
        let mut modes = Self {
            frequency_rad_s: lowest
                .eigenvalue
                .iter()
                .map(|square| square.sqrt())
                .collect(),
            shapes: lowest.shape,
        };
        modes.orient(mesh);
        Ok(modes)
    }

    /// Returns the value of each mode for a product row.
    fn modal(&self, row: &ProductRow) -> Vec<f64> {
        let entries = row.entries();
        let dot = |mode| {
            let column = self.shapes.column(mode);
            entries
                .iter()
                .map(|(index, value)| column[*index] * value)
                .sum()
        };
        (0..self.frequency_rad_s.len()).map(dot).collect()
    }

    fn modal_sum(&self, row: &[f64]) -> Vec<f64> {
        let dot = |mode| {
            let column = self.shapes.column(mode);
            column
                .iter()
                .zip(row)
                .map(|(shape, value)| shape * value)
                .sum()
        };
        (0..self.frequency_rad_s.len()).map(dot).collect()
    }

    /// Sets the sign of each mode: positive at the first of these places that moves at least half
    /// as far as the furthest: the named points in the order of their names, then a grid from the
    /// right and back.
    fn orient(&mut self, mesh: &PlateMesh) {
        let plate = mesh.layout.plate;
        let part = |k: usize, side_m: f64| side_m * (1.0 - k as f64 / SIGN_POINTS as f64);
        let grid = (0..SIGN_POINTS).flat_map(|i| {
            (0..SIGN_POINTS).map(move |j| PlatePoint {
                x_m: part(i, plate.length_m),
                y_m: part(j, plate.width_m),
            })
        });
        let places: Vec<Vec<f64>> = plate
            .point
            .values()
            .copied()
            .chain(grid)
            .map(|point| self.modal(&mesh.row(point, [0, 0])))
            .collect();
        for mode in 0..self.frequency_rad_s.len() {
            let furthest = places
                .iter()
                .map(|place| place[mode].abs())
                .fold(0.0, f64::max);
            let leading = places
                .iter()
                .map(|place| place[mode])
                .find(|place| place.abs() >= furthest / 2.0);
            if leading.is_some_and(|place| place < 0.0) {
                self.shapes.column_mut(mode).neg_mut();
            }
        }
    }

    /// Returns the modes as those of a structure.
    fn converted(&self, spec: &Spec, mesh: &PlateMesh, discretisation_error: Vec<f64>) -> Modes {
        let layout = mesh.layout;
        let participation_sqrt_kg = self.modal_sum(&mesh.translated_mass());
        let mut modes = Modes {
            frequency_rad_s: self.frequency_rad_s.clone(),
            damping_ratio: vec![0.0; self.frequency_rad_s.len()],
            discretisation_error,
            ..Modes::default()
        };
        let base = spec.base_under(&layout.plate.on);
        if base != GROUND {
            modes
                .base_sqrt_kg
                .insert(base.to_owned(), participation_sqrt_kg.clone());
        }
        modes.participation_sqrt_kg = participation_sqrt_kg;
        let points = layout.plate.point.iter();
        let named = points.map(|(point, place)| (format!("{}.{point}", layout.name), *place));
        let masses = layout
            .masses
            .iter()
            .map(|(name, _, place)| ((*name).to_owned(), *place));
        for (name, place) in named.chain(masses) {
            modes
                .shape
                .insert(name, self.modal(&mesh.row(place, [0, 0])));
        }
        modes.patch = layout
            .patches
            .iter()
            .enumerate()
            .map(|(index, (name, ..))| ((*name).to_owned(), self.patch(mesh, index)))
            .collect();
        modes
    }

    fn patch(&self, mesh: &PlateMesh, index: usize) -> PatchModes {
        let (_, _, patch) = mesh.layout.patches[index];
        let plate = mesh.layout.plate;
        let mut coupling = vec![0.0; mesh.unknowns()];
        let mut strain = Vec::new();
        for (i, j, laminate) in mesh.elements() {
            let middle = PlatePoint {
                x_m: mesh.x.middle_m(i),
                y_m: mesh.y.middle_m(j),
            };
            if !mesh.layout.patches_at(middle).any(|(of, _)| of == index) {
                continue;
            }
            let moment_n_v = laminate.patch_moment_n_v(plate, patch);
            for (curvature, moment_n_v) in [[2, 0], [0, 2]].into_iter().zip(moment_n_v) {
                mesh.integral([i, j], curvature)
                    .add_to(&mut coupling, moment_n_v);
            }
            for place in strain_places(mesh.x.ends_m(i), mesh.y.ends_m(j)) {
                let curvatures =
                    [[2, 0], [0, 2], [1, 1]].map(|order| self.modal(&mesh.row(place, order)));
                let strains: Vec<[f64; 3]> = (0..self.frequency_rad_s.len())
                    .map(|mode| {
                        let curvature = [0, 1, 2].map(|k| curvatures[k][mode]);
                        laminate.outer_strain(plate, patch, curvature)
                    })
                    .collect();
                let rows = [0, 1, 2].map(|axis| strains.iter().map(|of| of[axis]).collect());
                strain.push(if patch.is_fibre_composite() {
                    let [along, ..] = rows;
                    PlaceStrain::Along(along)
                } else {
                    PlaceStrain::InPlane(rows)
                });
            }
        }
        PatchModes {
            coupling_n_per_v: self.modal_sum(&coupling),
            capacitance_f: patch.clamped_in_plane_capacitance_f(),
            leakage_ohm: patch.leakage_ohm,
            strain,
        }
    }
}

/// Returns places of an element; its far edges belong to the next element, which may have another
/// laminate.
fn strain_places(x_m: [f64; 2], y_m: [f64; 2]) -> Vec<PlatePoint> {
    let at = |ends: [f64; 2], k: usize| {
        let part = k as f64 / (STRAIN_POINTS - 1) as f64 * (1.0 - 1e-9);
        ends[0] + (ends[1] - ends[0]) * part
    };
    (0..STRAIN_POINTS)
        .flat_map(|i| {
            (0..STRAIN_POINTS).map(move |j| PlatePoint {
                x_m: at(x_m, i),
                y_m: at(y_m, j),
            })
        })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_spec::Edge;
    use std::f64::consts::PI;

    fn simply_supported() -> Plate {
        let edge = Edge::SimplySupported;
        Plate {
            material: String::new(),
            length_m: 0.1,
            width_m: 0.1,
            thickness_m: 1e-3,
            youngs_modulus_pa: 70e9,
            poisson_ratio: 0.3,
            density_kg_m3: 2700.0,
            on: GROUND.into(),
            left: edge,
            right: edge,
            front: edge,
            back: edge,
            point: Default::default(),
        }
    }

    /// Errors of the eigensolver keep their reasons.
    #[test]
    fn a_plate_without_modes_states_the_reason() {
        let spec = Spec::default();
        let message = |plate: &Plate| {
            let layout = PlateLayout::new(&spec, "lid", plate);
            let mesh = PlateMesh::new(&layout, layout.cuts_m(), 0.05, 5);
            MeshModes::new(&mesh, 1).unwrap_err().to_string()
        };
        let weightless = Plate {
            density_kg_m3: 0.0,
            ..simply_supported()
        };
        let found = message(&weightless);
        assert!(
            found.contains("plate.lid has no modes: 1 modes are wanted"),
            "{found}"
        );
        let negative = Plate {
            youngs_modulus_pa: -70e9,
            ..simply_supported()
        };
        let found = message(&negative);
        assert!(found.contains("the stiffness matrix has"), "{found}");
        let endless = Plate {
            youngs_modulus_pa: f64::INFINITY,
            ..simply_supported()
        };
        let found = message(&endless);
        assert!(
            found.contains("outside the range of double precision"),
            "{found}"
        );
    }

    /// The cubic element of Bogner, Fox and Schmit: the error of a frequency falls with the fourth
    /// power of the element size. Degree `p` gives the order `2 (p - 1)`. All are upper bounds.
    #[test]
    fn the_error_has_the_order_of_the_element() {
        let plate = simply_supported();
        let spec = Spec::default();
        let layout = PlateLayout::new(&spec, "plate", &plate);
        let d_n_m: f64 = 70e9 * 1e-9 / (12.0 * (1.0 - 0.3 * 0.3));
        let exact = 2.0 * (PI / 0.1_f64).powi(2) * (d_n_m / 2.7).sqrt();
        for (degree, divisions) in [(3, &[4, 8, 16][..]), (4, &[2, 4, 8]), (5, &[2, 4])] {
            let error = |parts: &i32| {
                let longest_m = plate.length_m / f64::from(*parts);
                let mesh = PlateMesh::new(&layout, layout.cuts_m(), longest_m, degree);
                let modes = MeshModes::new(&mesh, 1).unwrap();
                modes.frequency_rad_s[0] / exact - 1.0
            };
            let errors: Vec<f64> = divisions.iter().map(error).collect();
            let order = 2.0 * (degree - 1) as f64;
            for pair in errors.windows(2) {
                let measured = (pair[0] / pair[1]).log2();
                assert!(
                    pair[1] > 0.0 && (measured - order).abs() < 0.2,
                    "degree {degree}: {errors:?}, order {measured}"
                );
            }
        }
    }
}
