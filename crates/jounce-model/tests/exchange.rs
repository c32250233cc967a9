//! A cantilever of cubic elements in t, mm and N, as other programs give it, against closed forms in
//! SI units.
#![allow(clippy::unwrap_used, reason = "tests")]

use jounce_model::exchange::{ImportSettings, MatrixSet, NameKind, Names, import_modes};
use jounce_sparse::MatrixEntries;
use std::f64::consts::TAU;

const ELEMENTS: usize = 40;
const LENGTH_M: f64 = 0.2;
/// Mass per length, kg/m, and bending stiffness, N m^2.
const MASS_KG_M: f64 = 0.081;
const STIFFNESS_N_M2: f64 = 0.175;

/// Adds the elements of `integral h h` or `integral h'' h''`, times a factor, without the clamped end.
fn assembled(factor: f64, element: [[f64; 4]; 4]) -> MatrixEntries {
    let h = 1e3 * LENGTH_M / ELEMENTS as f64;
    let slope = |i: usize| if i % 2 == 1 { h } else { 1.0 };
    let mut entries = Vec::new();
    for start in (0..2 * ELEMENTS).step_by(2) {
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            if start + i >= 2 && start + j >= 2 {
                let value = factor * element[i][j] * slope(i) * slope(j);
                entries.push((start + i - 2, start + j - 2, value));
            }
        }
    }
    MatrixEntries {
        rows: 2 * ELEMENTS,
        columns: 2 * ELEMENTS,
        entries,
    }
}

/// The beam in t, mm and N, with a moment of 1 N mm per volt on its end.
fn cantilever(damping_s: f64) -> MatrixSet {
    let h = 1e3 * LENGTH_M / ELEMENTS as f64;
    // kg/m = 1e-3 t / 1e3 mm; N m^2 = 1e6 N mm^2.
    let mass = [
        [156.0, 22.0, 54.0, -13.0],
        [22.0, 4.0, 13.0, -3.0],
        [54.0, 13.0, 156.0, -22.0],
        [-13.0, -3.0, -22.0, 4.0],
    ];
    let bending = [
        [12.0, 6.0, -12.0, 6.0],
        [6.0, 4.0, -6.0, 2.0],
        [-12.0, -6.0, 12.0, -6.0],
        [6.0, 2.0, -6.0, 4.0],
    ];
    let stiffness = 1e6 * STIFFNESS_N_M2 / h.powi(3);
    let column = |rows: usize, entries: Vec<(usize, usize, f64)>| MatrixEntries {
        rows,
        columns: 1,
        entries,
    };
    let end = 2 * ELEMENTS - 1;
    let matrix = [
        ("mass", assembled(1e-6 * MASS_KG_M * h / 420.0, mass)),
        ("stiffness", assembled(stiffness, bending)),
        ("damping", assembled(damping_s * stiffness, bending)),
        ("coupling", column(2 * ELEMENTS, vec![(end, 0, 1.0)])),
        ("capacitance", column(1, vec![(0, 0, 3e-8)])),
        (
            "base",
            column(
                2 * ELEMENTS,
                (0..ELEMENTS).map(|i| (2 * i, 0, 1.0)).collect(),
            ),
        ),
    ];
    let mut names = Names::default();
    names
        .lines
        .push((NameKind::Point, end - 1, "beam.tip".to_owned()));
    names.add(NameKind::Electrode, &["mfc".to_owned()]);
    MatrixSet {
        matrix: matrix
            .map(|(name, matrix)| (name.to_owned(), matrix))
            .into(),
        names,
    }
}

fn settings() -> ImportSettings {
    ImportSettings {
        modes: 4,
        damping_ratio: vec![0.02, 0.01],
        mass_unit_kg: 1e3,
        length_unit_m: 1e-3,
    }
}

/// Roots `x` of `cos x cosh x = -1`, and the slope of each shape at the end over its displacement.
const ROOTS: [(f64, f64); 4] = [
    (1.875_104_068_711_961_2, 0.734_095_514),
    (4.694_091_132_974_174, 1.018_467_319),
    (7.854_757_438_237_613, 0.999_224_497),
    (10.995_540_734_875_467, 1.000_033_553),
];

#[test]
fn cantilever_in_millimetres_and_tonnes() {
    let damping_s = 1e-5;
    let imported = import_modes(cantilever(damping_s), &settings()).unwrap();
    let modal = &imported.modal;
    assert!(
        imported.orthogonality < 1e-10 && imported.damping_coupling < 1e-6,
        "{imported:?}"
    );
    let beam_kg = MASS_KG_M * LENGTH_M;
    for (k, (root, slope)) in ROOTS.into_iter().enumerate() {
        let speed = (root / LENGTH_M).powi(2) * (STIFFNESS_N_M2 / MASS_KG_M).sqrt();
        let close = |found: f64, exact: f64, tolerance: f64| {
            assert!(
                (found / exact - 1.0).abs() < tolerance,
                "mode {k}: {found} for {exact}"
            );
        };
        close(modal.frequency_hz[k], speed / TAU, 1e-5);
        close(modal.damping_ratio[k], damping_s * speed / 2.0, 1e-5);
        let tip = modal.point["beam-tip"][k];
        close(tip.abs(), 2.0 / beam_kg.sqrt(), 1e-5);
        // The slope at the end is that ratio times the root over the length.
        let patch = &modal.patch["mfc"];
        close(
            patch.coupling_n_per_v[k] / tip,
            1e-3 * slope * root / LENGTH_M,
            1e-5,
        );
        close(patch.capacitance_f, 3e-8, 1e-15);
        // The integral of the shape: 2 slope / root for a tip of 2, from w'''' = (root / L)^4 w.
        // The matrices lack the mass that consistent elements share with the clamped node.
        let ratio = [0.782_991, 0.433_936, 0.254_425, 0.181_897][k];
        close(
            modal.participation_sqrt_kg[k].abs(),
            ratio * beam_kg.sqrt(),
            1e-3,
        );
    }
}

/// Without a damping matrix the ratios are those of the list.
#[test]
fn damping_ratios_of_a_list() {
    let mut set = cantilever(0.0);
    set.matrix.remove("damping");
    let imported = import_modes(set, &settings()).unwrap();
    assert_eq!(imported.modal.damping_ratio, [0.02, 0.01, 0.01, 0.01]);
}

/// A free beam has two rigid-body modes, exactly 0 Hz, without damping; an indefinite mass is refused.
#[test]
fn rigid_bodies_and_indefinite_matrices() {
    let mut set = cantilever(0.0);
    set.matrix.remove("damping");
    // Release the clamp: a spring of negative sign would be indefinite, a missing one is free.
    let mut free = set.clone();
    let springs = [[1.0, -1.0], [-1.0, 1.0]];
    let size = 2 * ELEMENTS;
    let entries = (0..size - 1)
        .flat_map(|i| (0..4).map(move |k| (i + k / 2, i + k % 2, springs[k / 2][k % 2])));
    let chain = MatrixEntries {
        rows: size,
        columns: size,
        entries: entries.collect(),
    };
    free.matrix.insert("stiffness".to_owned(), chain);
    let imported = import_modes(free, &settings()).unwrap();
    assert_eq!(
        (
            imported.modal.frequency_hz[0],
            imported.modal.damping_ratio[0]
        ),
        (0.0, 0.0)
    );
    assert!(imported.modal.frequency_hz[1] > 0.0 && imported.modal.damping_ratio[1] == 0.02);
    for name in ["mass", "stiffness"] {
        let mut wrong = set.clone();
        let matrix = wrong.matrix.get_mut(name).unwrap();
        matrix
            .entries
            .iter_mut()
            .filter(|entry| entry.0 == 9 && entry.1 == 9)
            .for_each(|entry| entry.2 = -entry.2);
        let error = import_modes(wrong, &settings()).unwrap_err().to_string();
        assert!(
            error.contains(&format!("the {name} matrix has 1 negative eigenvalues")),
            "{error}"
        );
    }
}
