//! Shapes that are given with mass and stiffness, against closed forms of two masses on springs.

use jounce_model::exchange::{
    ExchangeFaults, ImportSettings, ImportedModes, MatrixSet, NameKind, Names, import_modes,
};
use jounce_sparse::MatrixEntries;
use std::f64::consts::TAU;

const MASS_KG: f64 = 0.5;
const SPRING_N_M: f64 = 100.0;
/// Golden ratio: the shapes are `(1, g)` and `(g, -1)`, `w^2 = k / m / g^2` and `k / m g^2`.
const GOLDEN: f64 = 1.618_033_988_749_895;

fn dense(rows: &[&[f64]]) -> MatrixEntries {
    let entries = rows.iter().enumerate();
    MatrixEntries {
        rows: rows.len(),
        columns: rows[0].len(),
        entries: entries
            .flat_map(|(i, row)| row.iter().enumerate().map(move |(j, value)| (i, j, *value)))
            .collect(),
    }
}

/// The chain, clamped at one end, with shapes and perhaps frequencies.
fn chain(shapes: MatrixEntries, frequency_hz: Option<MatrixEntries>) -> MatrixSet {
    let (m, k) = (MASS_KG, SPRING_N_M);
    let matrices = [
        ("mass", dense(&[&[m, 0.0], &[0.0, m]])),
        ("stiffness", dense(&[&[2.0 * k, -k], &[-k, k]])),
        ("base", dense(&[&[1.0], &[1.0]])),
        ("shapes", shapes),
    ];
    let mut set = MatrixSet::default();
    set.matrix
        .extend(matrices.map(|(name, matrix)| (name.to_owned(), matrix)));
    if let Some(frequency_hz) = frequency_hz {
        set.matrix.insert("frequency_hz".to_owned(), frequency_hz);
    }
    let mut names = Names::default();
    names.lines.push((NameKind::Point, 1, "tip".to_owned()));
    set.names = names;
    set
}

fn imported(set: MatrixSet) -> Result<ImportedModes, ExchangeFaults> {
    let settings = ImportSettings {
        modes: 1,
        damping_ratio: vec![0.02, 0.01],
        mass_unit_kg: 1.0,
        length_unit_m: 1.0,
    };
    import_modes(set, &settings)
}

fn exact_hz() -> [f64; 2] {
    let angular = (SPRING_N_M / MASS_KG).sqrt();
    [angular / GOLDEN / TAU, angular * GOLDEN / TAU]
}

/// Exact shapes of any scale and order are the modes of the eigenproblem.
#[test]
fn exact_shapes_are_the_modes() {
    let shapes = dense(&[&[GOLDEN, -3.0], &[-1.0, -3.0 * GOLDEN]]);
    let result = imported(chain(shapes, None)).unwrap();
    assert!(
        result.has_given_shapes && result.orthogonality < 1e-14,
        "{result:?}"
    );
    assert!(result.stiffness_orthogonality < 1e-14, "{result:?}");
    assert_eq!(result.frequency_error, [None, None]);
    assert_eq!(result.modal.damping_ratio, [0.02, 0.01]);
    let root = (MASS_KG * (1.0 + GOLDEN * GOLDEN)).sqrt();
    for (mode, tip) in [-GOLDEN / root, -1.0 / root].into_iter().enumerate() {
        for found_hz in [result.modal.frequency_hz[mode], result.rayleigh_hz[mode]] {
            assert!((found_hz / exact_hz()[mode] - 1.0).abs() < 1e-14);
        }
        assert!((result.modal.point["tip"][mode] / tip - 1.0).abs() < 1e-14);
    }
    let both: f64 = result
        .modal
        .participation_sqrt_kg
        .iter()
        .map(|p| p * p)
        .sum();
    assert!((both / (2.0 * MASS_KG) - 1.0).abs() < 1e-14);
}

/// The second shape contains a share `s` of the first, both of unit modal mass: the products are
/// `s / sqrt(1 + s^2)` and `s w1 / sqrt(w2^2 + s^2 w1^2)`, its quotient `(w2^2 + s^2 w1^2) / (1 + s^2)`.
#[test]
fn a_mixed_shape_has_the_products_of_the_closed_form() {
    let s = 0.1;
    let shapes = dense(&[&[1.0, GOLDEN + s], &[GOLDEN, -1.0 + s * GOLDEN]]);
    let [first_hz, second_hz] = exact_hz();
    let stated = dense(&[&[first_hz], &[1.01 * second_hz]]);
    let result = imported(chain(shapes, Some(stated))).unwrap();
    let close =
        |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-13, "{found} {exact}");
    let norm = 1.0 + s * s;
    close(result.orthogonality, s / norm.sqrt());
    let mixed_hz = (second_hz.powi(2) + (s * first_hz).powi(2)).sqrt();
    close(result.stiffness_orthogonality, s * first_hz / mixed_hz);
    close(result.rayleigh_hz[0], first_hz);
    close(result.rayleigh_hz[1], mixed_hz / norm.sqrt());
    // The modes have the frequencies that are given.
    assert_eq!(result.modal.frequency_hz, [first_hz, 1.01 * second_hz]);
}

/// A free pair: the rigid-body motion has 0 Hz, and its quotient of roundoff is none.
#[test]
fn rigid_body_shapes_have_no_frequency() {
    let mut set = chain(dense(&[&[1.0, 1.0], &[-1.0, 1.0]]), None);
    let k = SPRING_N_M;
    let free = dense(&[&[k, -k], &[-k, k]]);
    set.matrix.insert("stiffness".to_owned(), free.clone());
    let result = imported(set).unwrap();
    assert_eq!(result.modal.frequency_hz[0], 0.0);
    assert_eq!(result.modal.damping_ratio, [0.0, 0.02]);
    assert!(result.set_to_zero_hz.is_empty() && result.stiffness_orthogonality == 0.0);
    // Shapes of few digits bend slightly: the quotient is reported, and the mode keeps 0 Hz.
    let mut rough = chain(dense(&[&[1.0, 1.0], &[-1.0, 1.00001]]), None);
    rough.matrix.insert("stiffness".to_owned(), free);
    let result = imported(rough).unwrap();
    assert_eq!(result.modal.frequency_hz[0], 0.0);
    let exact_hz = (k * 1e-10 / (2.0 * MASS_KG)).sqrt() / TAU;
    let [(0, found_hz)] = result.set_to_zero_hz[..] else {
        panic!("{result:?}")
    };
    assert!(
        (found_hz / exact_hz - 1.0).abs() < 1e-4,
        "{found_hz} {exact_hz}"
    );
}

#[test]
fn faults_name_the_column() {
    let good = || dense(&[&[1.0, GOLDEN], &[GOLDEN, -1.0]]);
    let mut without = chain(good(), Some(dense(&[&[1.0], &[2.0]])));
    without.matrix.remove("shapes");
    let mut negative = chain(good(), None);
    let stiffness = dense(&[&[-1.0, 0.0], &[0.0, 1.0]]);
    negative.matrix.insert("stiffness".to_owned(), stiffness);
    for (set, expected) in [
        (
            chain(dense(&[&[1.0, 2.0]]), None),
            "shapes has 1 rows, one per degree of freedom, but must have 2",
        ),
        (
            chain(dense(&[&[1.0, 2.0, 3.0], &[1.0, 0.0, 3.0]]), None),
            "shapes has 3 columns, one per mode, but must have 1 to 2",
        ),
        (
            chain(dense(&[&[1.0, 0.0], &[1.0, 0.0]]), None),
            "shapes: column 2 has the modal mass 0; it must be above 0",
        ),
        (
            chain(dense(&[&[1.0, -2.0], &[1.0, -2.0]]), None),
            "shapes: columns 1 and 2 are the same shape but for a factor",
        ),
        (
            chain(dense(&[&[1.0, f64::NAN], &[1.0, 2.0]]), None),
            "shapes: entry (1, 2) is NaN; it must be finite",
        ),
        (
            chain(good(), Some(dense(&[&[1.0, 2.0]]))),
            "frequency_hz is 1 x 2, but must be 2 x 1",
        ),
        (
            chain(good(), Some(dense(&[&[-1.0], &[2.0]]))),
            "frequency_hz: entry (1, 1) is -1; it must be at least 0",
        ),
        (without, "frequency_hz belongs to shapes, which are missing"),
        (negative, "has the negative stiffness"),
    ] {
        let message = imported(set).unwrap_err().to_string();
        assert!(message.contains(expected), "{expected} in {message}");
    }
}
