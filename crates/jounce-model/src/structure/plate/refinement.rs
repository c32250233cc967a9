//! Refinement of the polynomials of a plate until its frequencies converge.
//!
//! Elements are at most `2.5 pi / k` long, with `k` the wave number of the highest retained mode of
//! the same plate simply supported on all edges. The curvature is infinite in the corner of a
//! clamped and a free edge (Williams, J. Appl. Mech. 19 (1952) 526), so a narrow strip of elements
//! runs along both edges of each such corner. The degree of the polynomials rises by 2 until no
//! retained frequency changes by more than the tolerance. The corners and those of the patches make
//! the error fall with a power of the degree, so that the change is about the error that remains.

use super::layout::PlateLayout;
use super::mesh::PlateMesh;
use super::modal::MeshModes;
use crate::structure::assembly::refinement::relative_change;
use crate::structure::error::StructureError;
use jounce_spec::{Edge, Plate};
use std::f64::consts::PI;

/// Tolerance of a plate where that of the spec is smaller: singular corners forbid more digits.
const LEAST_TOLERANCE: f64 = 1e-4;
/// Degree of the polynomials on the first mesh, and its increase.
const FIRST_DEGREE: usize = 5;
const DEGREE_STEP: usize = 2;
/// Highest degree.
const MAX_DEGREE: usize = 15;
/// Largest number of degrees of freedom.
const MAX_UNKNOWNS: usize = 6000;
/// Width of the strips at singular corners, relative to the shorter side.
const STRIP: f64 = 0.15;

/// Returns mesh, modes and the estimated error of each frequency on the first mesh that meets the
/// tolerance.
///
/// # Errors
/// `PlateTooFine`, `PlateNotConverged`, `NotRepresentable`, `PlateWithoutModes`.
pub(super) fn refined<'l, 'a>(
    layout: &'l PlateLayout<'a>,
    count: usize,
    tolerance: f64,
) -> Result<(PlateMesh<'l, 'a>, MeshModes, Vec<f64>), StructureError> {
    let tolerance = tolerance.max(LEAST_TOLERANCE);
    let longest_m = 2.5 * PI / wave_number_per_m(layout.plate, count);
    let mesh = |degree| PlateMesh::new(layout, cuts_m(layout), longest_m, degree);
    let too_many = mesh(FIRST_DEGREE + DEGREE_STEP).unknowns();
    if too_many > MAX_UNKNOWNS {
        return Err(StructureError::PlateTooFine {
            plate: layout.name.into(),
            unknowns: too_many,
            allowed: MAX_UNKNOWNS,
        });
    }
    let mut coarse = MeshModes::new(&mesh(FIRST_DEGREE), count)?.frequency_rad_s;
    let (mut least, mut unknowns) = (f64::INFINITY, mesh(FIRST_DEGREE).unknowns());
    for degree in (FIRST_DEGREE + DEGREE_STEP..=MAX_DEGREE).step_by(DEGREE_STEP) {
        let mesh = mesh(degree);
        if mesh.unknowns() > MAX_UNKNOWNS {
            break;
        }
        let modes = MeshModes::new(&mesh, count)?;
        let error = relative_change(&coarse, &modes.frequency_rad_s);
        least = error.iter().copied().fold(0.0, f64::max);
        if least <= tolerance && coarse.len() == modes.frequency_rad_s.len() {
            return Ok((mesh, modes, error));
        }
        (coarse, unknowns) = (modes.frequency_rad_s, mesh.unknowns());
    }
    Err(StructureError::PlateNotConverged {
        plate: layout.name.into(),
        change: least,
        unknowns,
        tolerance,
    })
}

/// Returns the wave number of mode `count` of the plate simply supported on all edges, 1/m.
fn wave_number_per_m(plate: &Plate, count: usize) -> f64 {
    let square = |m: usize, side_m: f64| (m as f64 * PI / side_m).powi(2);
    let of =
        |m: usize| (1..=count).map(move |n| square(m, plate.length_m) + square(n, plate.width_m));
    let mut squares: Vec<f64> = (1..=count).flat_map(of).collect();
    squares.sort_by(f64::total_cmp);
    squares[count - 1].sqrt()
}

/// Returns the grid lines of the layout and those of the strips.
fn cuts_m(layout: &PlateLayout) -> [Vec<f64>; 2] {
    let plate = layout.plate;
    let [left, right, front, back] = plate.edges();
    let is_singular = |one: Edge, other: Edge| {
        [one, other].contains(&Edge::Clamped) && [one, other].contains(&Edge::Free)
    };
    let strip_m = STRIP * plate.length_m.min(plate.width_m);
    let with_strips = |mut cuts: Vec<f64>, side_m: f64, ends: [Edge; 2], others: [Edge; 2]| {
        for (end, at_m) in ends.into_iter().zip([strip_m, side_m - strip_m]) {
            let is_needed = others.iter().any(|other| is_singular(end, *other));
            let is_near = |cut: &f64| (cut - at_m).abs() < strip_m / 2.0;
            if is_needed && !cuts.iter().any(is_near) {
                cuts.push(at_m);
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts
    };
    let [across_x, across_y] = layout.cuts_m();
    [
        with_strips(across_x, plate.length_m, [left, right], [front, back]),
        with_strips(across_y, plate.width_m, [front, back], [left, right]),
    ]
}
