//! Two reduced bases of a beam that is struck at its tip.
//!
//! Free-interface: the lowest modes of the beam. Fixed-contact (Craig and Bampton, AIAA J. 6 (1968)
//! 1313): the lowest modes with the tip fixed, and the static shape under a force on the tip. Both
//! are computed from one model with many free-interface modes; without truncation they span the
//! same space.

use jounce_linalg::{Mat, symmetric_eigen};
use jounce_model::plant::System;
use std::sync::Arc;

/// System with only the lowest modes of its beam; the free mass (mode 0) remains.
pub fn free_interface(system: &System, coordinates: usize) -> System {
    let beam = system.modes.len() - 1;
    in_coordinates(
        system,
        &Mat::from_fn(
            beam,
            coordinates,
            |row, column| if row == column { 1.0 } else { 0.0 },
        ),
    )
}

/// System with the fixed-tip modes of the beam and the static shape, `coordinates` in all.
pub fn fixed_contact(system: &System, coordinates: usize) -> System {
    let square: Vec<f64> = system.modes.frequency_rad_s[1..]
        .iter()
        .map(|w| w * w)
        .collect();
    let tip = &system.modes.shape["upper.end"][1..];
    let n = tip.len();
    // An orthonormal basis of the motions without tip displacement: columns of a reflection that
    // maps the tip's row to an axis.
    let norm = tip.iter().map(|t| t * t).sum::<f64>().sqrt();
    let mut mirror: Vec<f64> = tip.iter().map(|t| t / norm).collect();
    mirror[0] += mirror[0].signum();
    let size: f64 = mirror.iter().map(|m| m * m).sum();
    let constrained = Mat::from_fn(n, n - 1, |row, column| {
        f64::from(row == column + 1) - 2.0 * mirror[row] * mirror[column + 1] / size
    });
    let stiffness = Mat::from_fn(n - 1, n - 1, |a, b| {
        (0..n)
            .map(|i| constrained[(i, a)] * square[i] * constrained[(i, b)])
            .sum::<f64>()
    });
    let (_, modes) = symmetric_eigen(&stiffness).unwrap();
    let constrained_modes = &constrained * modes;
    let basis = Mat::from_fn(n, coordinates, |row, column| {
        if column + 1 < coordinates {
            constrained_modes[(row, column)]
        } else {
            tip[row] / square[row]
        }
    });
    in_coordinates(system, &basis)
}

/// System in a basis of the beam's coordinates, diagonalised again.
fn in_coordinates(system: &System, basis: &Mat<f64>) -> System {
    let modes = &system.modes;
    let square: Vec<f64> = modes.frequency_rad_s[1..].iter().map(|w| w * w).collect();
    let (scale, vectors) = symmetric_eigen(&(basis.transpose() * basis)).unwrap();
    let whitened = Mat::from_fn(basis.ncols(), basis.ncols(), |i, j| {
        vectors[(i, j)] / scale[j].sqrt()
    });
    let orthonormal = basis * whitened;
    let stiffness = Mat::from_fn(basis.ncols(), basis.ncols(), |a, b| {
        square
            .iter()
            .enumerate()
            .map(|(i, square)| orthonormal[(i, a)] * square * orthonormal[(i, b)])
            .sum::<f64>()
    });
    let (squares, vectors) = symmetric_eigen(&stiffness).unwrap();
    let shapes = &orthonormal * vectors;
    let onto = |row: &[f64]| -> Vec<f64> {
        let on_beam = (0..shapes.ncols()).map(|k| {
            row[1..]
                .iter()
                .enumerate()
                .map(|(i, value)| value * shapes[(i, k)])
                .sum::<f64>()
        });
        std::iter::once(row[0]).chain(on_beam).collect()
    };
    let mut reduced = system.clone();
    let modal = Arc::make_mut(&mut reduced.modes);
    modal.frequency_rad_s = std::iter::once(0.0)
        .chain((0..shapes.ncols()).map(|k| squares[k].sqrt()))
        .collect();
    modal.damping_ratio = vec![0.0; shapes.ncols() + 1];
    modal.discretisation_error = vec![0.0; shapes.ncols() + 1];
    modal.participation_sqrt_kg = onto(&modes.participation_sqrt_kg);
    modal.shape.values_mut().for_each(|row| *row = onto(row));
    modal.patch.values_mut().for_each(|patch| {
        patch.coupling_n_per_v = onto(&patch.coupling_n_per_v);
        patch.strain.clear();
    });
    reduced
        .stops
        .iter_mut()
        .for_each(|stop| stop.shape = onto(&stop.shape));
    reduced
}
