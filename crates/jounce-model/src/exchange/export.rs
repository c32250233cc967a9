//! A system as matrices in modal coordinates.

use super::{MatrixSet, NameKind, Names};
use crate::plant::System;
use jounce_sparse::MatrixEntries;
use jounce_spec::GROUND;

/// Returns the matrices of a system in its modal coordinates, without loads, stops and drives.
///
/// `base` belongs to the ground. Friction of masses couples the modes in `damping`.
pub fn modal_matrices(system: &System) -> MatrixSet {
    let modes = &system.modes;
    let (n, patches) = (modes.len(), modes.patch.len());
    let mut set = MatrixSet::default();
    let diagonal = |size: usize, value: &dyn Fn(usize) -> f64| MatrixEntries {
        rows: size,
        columns: size,
        entries: (0..size).map(|i| (i, i, value(i))).collect(),
    };
    let damping = |i: usize, j: usize| {
        let friction = system
            .dashpots
            .iter()
            .map(|dashpot| dashpot.damping_per_s(i, j));
        let own = if i == j {
            2.0 * modes.damping_ratio[i] * modes.frequency_rad_s[i]
        } else {
            0.0
        };
        own + friction.sum::<f64>()
    };
    let of_patch: Vec<_> = modes.patch.values().collect();
    let points: Vec<_> = modes.shape.values().collect();
    let matrices = [
        ("mass", diagonal(n, &|_| 1.0)),
        (
            "stiffness",
            diagonal(n, &|i| modes.frequency_rad_s[i].powi(2)),
        ),
        ("damping", full(n, n, damping)),
        (
            "coupling",
            full(n, patches, |i, p| of_patch[p].coupling_n_per_v[i]),
        ),
        (
            "capacitance",
            diagonal(patches, &|p| of_patch[p].capacitance_f),
        ),
        (
            "conductance",
            diagonal(patches, &|p| {
                of_patch[p].leakage_ohm.map_or(0.0, f64::recip)
            }),
        ),
        ("points", full(points.len(), n, |point, i| points[point][i])),
        ("base", {
            let participation = modes.participation_in_sqrt_kg(GROUND);
            full(n, 1, |i, _| participation[i])
        }),
    ];
    set.matrix = matrices
        .into_iter()
        .map(|(name, matrix)| (name.to_owned(), matrix))
        .collect();
    let degrees: Vec<String> = (1..=n).map(|mode| format!("mode-{mode}")).collect();
    let mut names = Names::default();
    names.add(NameKind::Degree, &degrees);
    names.add(NameKind::Point, modes.shape.keys());
    names.add(NameKind::Electrode, modes.patch.keys());
    set.names = names;
    set
}

/// The entries other than zero of a matrix.
fn full(rows: usize, columns: usize, value: impl Fn(usize, usize) -> f64) -> MatrixEntries {
    let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let entries = places
        .map(|(i, j)| (i, j, value(i, j)))
        .filter(|entry| entry.2 != 0.0)
        .collect();
    MatrixEntries {
        rows,
        columns,
        entries,
    }
}
