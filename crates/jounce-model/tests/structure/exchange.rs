//! A cantilever of cubic elements in t, mm and N, as other programs give it, against closed forms in
//! SI units.

use jounce_model::exchange::{ImportSettings, MatrixSet, NameKind, Names, import_modes};
use jounce_sparse::MatrixEntries;
use std::f64::consts::TAU;

const ELEMENTS: usize = 40;
const LENGTH_M: f64 = 0.2;
/// Mass per length, kg/m, and bending stiffness, N m^2.
const MASS_KG_M: f64 = 0.081;
const STIFFNESS_N_M2: f64 = 0.175;

/// Adds the elements of `integral h h` or `integral h'' h''`, times a factor, without the degrees of
/// freedom that are `held` at the first end: 2 of a clamped beam, 0 of a free one.
fn assembled(held: usize, factor: f64, element: [[f64; 4]; 4]) -> MatrixEntries {
    let size = 2 * (ELEMENTS + 1) - held;
    let h = 1e3 * LENGTH_M / ELEMENTS as f64;
    let slope = |i: usize| if i % 2 == 1 { h } else { 1.0 };
    let mut entries = Vec::new();
    for start in (0..2 * ELEMENTS).step_by(2) {
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            if start + i >= held && start + j >= held {
                let value = factor * element[i][j] * slope(i) * slope(j);
                entries.push((start + i - held, start + j - held, value));
            }
        }
    }
    MatrixEntries {
        rows: size,
        columns: size,
        entries,
    }
}

/// Mass, and stiffness times a factor, in t, mm and N.
fn mass_and_stiffness(held: usize, factor: f64) -> [MatrixEntries; 2] {
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
    [
        assembled(held, 1e-6 * MASS_KG_M * h / 420.0, mass),
        assembled(held, factor * 1e6 * STIFFNESS_N_M2 / h.powi(3), bending),
    ]
}

/// The beam in t, mm and N, with a moment of 1 N mm per volt on its end.
fn cantilever(damping_s: f64) -> MatrixSet {
    let [mass, stiffness] = mass_and_stiffness(2, 1.0);
    let [_, damping] = mass_and_stiffness(2, damping_s);
    let column = |rows: usize, entries: Vec<(usize, usize, f64)>| MatrixEntries {
        rows,
        columns: 1,
        entries,
    };
    let end = 2 * ELEMENTS - 1;
    let matrix = [
        ("mass", mass),
        ("stiffness", stiffness),
        ("damping", damping),
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

/// Mass, stiffness and perhaps damping of a free beam.
fn free_beam(damping: Option<MatrixEntries>) -> MatrixSet {
    let [mass, stiffness] = mass_and_stiffness(0, 1.0);
    let mut set = MatrixSet::default();
    set.matrix.insert("mass".to_owned(), mass);
    set.matrix.insert("stiffness".to_owned(), stiffness);
    if let Some(damping) = damping {
        set.matrix.insert("damping".to_owned(), damping);
    }
    set
}

/// A free beam has two rigid-body modes, exactly 0 Hz, and the elastic modes of `cos x cosh x = 1`.
/// Damping proportional to the stiffness neither acts on the rigid-body modes nor couples modes,
/// although its products with the rigid-body shapes are roundoff and not 0.
#[test]
fn free_beams_have_two_rigid_body_modes() {
    let [_, damping] = mass_and_stiffness(0, 1e-5);
    for damping in [None, Some(damping)] {
        let is_list = damping.is_none();
        let imported = import_modes(free_beam(damping), &settings()).unwrap();
        let modal = &imported.modal;
        assert_eq!(modal.frequency_hz[..2], [0.0; 2]);
        assert_eq!(modal.damping_ratio[..2], [0.0; 2]);
        for (mode, root) in [(2, 4.730_040_744_862_704), (3, 7.853_204_624_095_838)] {
            let speed: f64 = (root / LENGTH_M).powi(2) * (STIFFNESS_N_M2 / MASS_KG_M).sqrt();
            let error = modal.frequency_hz[mode] / (speed / TAU) - 1.0;
            assert!(error.abs() < 1e-5, "mode {mode}: {error:e}");
            let expected = match is_list {
                true => [0.02, 0.01][mode - 2],
                false => 1e-5 * speed / 2.0,
            };
            let error = modal.damping_ratio[mode] / expected - 1.0;
            assert!(error.abs() < 1e-5, "mode {mode}: {error:e}");
        }
        assert!(imported.damping_coupling < 1e-6, "{imported:?}");
        assert!(imported.set_to_zero_hz.is_empty() && imported.rigid_damping_per_s.is_empty());
    }
}

/// Damping proportional to the mass acts on rigid-body modes too; the modes leave it out.
#[test]
fn damping_of_rigid_body_modes_is_reported() {
    let [mut damping, _] = mass_and_stiffness(0, 1.0);
    damping.entries.iter_mut().for_each(|entry| entry.2 *= 3.0);
    let imported = import_modes(free_beam(Some(damping)), &settings()).unwrap();
    let modes: Vec<usize> = imported.rigid_damping_per_s.iter().map(|of| of.0).collect();
    assert_eq!(modes, [0, 1]);
    for (_, damping_per_s) in imported.rigid_damping_per_s {
        assert!((damping_per_s / 3.0 - 1.0).abs() < 1e-9, "{damping_per_s}");
    }
    assert!(imported.damping_coupling < 1e-6);
}

/// A free beam on two soft springs: its two lowest modes are set to 0 Hz with their true frequencies
/// reported, `sqrt(2 k / m)` for the translation and `sqrt(6 k / m)` for the rotation.
#[test]
fn soft_modes_that_are_set_to_zero_are_reported() {
    let mut set = free_beam(None);
    let spring_n_mm = 1e-7;
    let stiffness = set.matrix.get_mut("stiffness").unwrap();
    for end in [0, 2 * ELEMENTS] {
        stiffness.entries.push((end, end, spring_n_mm));
    }
    let imported = import_modes(set, &settings()).unwrap();
    assert_eq!(imported.modal.frequency_hz[..2], [0.0; 2]);
    assert_eq!(imported.set_to_zero_hz.len(), 2, "{imported:?}");
    let mass_kg = MASS_KG_M * LENGTH_M;
    for ((_, found_hz), factor) in imported.set_to_zero_hz.into_iter().zip([2.0, 6.0]) {
        let exact_hz = (factor * 1e3 * spring_n_mm / mass_kg).sqrt() / TAU;
        assert!(
            (found_hz / exact_hz - 1.0).abs() < 1e-3,
            "{found_hz} for {exact_hz}"
        );
    }
}

/// Matrices with negative eigenvalues, and entries that are no numbers or outside, are refused.
#[test]
fn indefinite_matrices_and_wrong_entries() {
    let set = cantilever(0.0);
    let message = |wrong: MatrixSet| import_modes(wrong, &settings()).unwrap_err().to_string();
    for name in ["mass", "stiffness"] {
        let mut wrong = set.clone();
        let matrix = wrong.matrix.get_mut(name).unwrap();
        matrix
            .entries
            .iter_mut()
            .filter(|entry| entry.0 == 9 && entry.1 == 9)
            .for_each(|entry| entry.2 = -entry.2);
        let error = message(wrong);
        assert!(
            error.contains(&format!("the {name} matrix has 1 negative eigenvalue;")),
            "{error}"
        );
    }
    let mut wrong = set;
    let mut push = |name: &str, entry| wrong.matrix.get_mut(name).unwrap().entries.push(entry);
    push("coupling", (1, 0, f64::NAN));
    push("base", (99, 0, 1.0));
    wrong.names.add(NameKind::Point, &["my tip".to_owned()]);
    let error = message(wrong);
    for part in [
        "coupling: entry (2, 1) is NaN; it must be finite",
        "base: entry (100, 1) lies outside the 80 x 1 matrix",
        "the name \"my tip\" must consist of letters",
    ] {
        assert!(error.contains(part), "{error}");
    }
}
