//! Chains of masses and springs.

use super::{check, diagonal, springs};
use jounce_sparse::{SymmetricMatrix, lowest_modes};
use std::f64::consts::PI;

/// A string: masses `m` between fixed ends have `lambda_k = 4 (c / m) sin^2(k pi / (2 (n + 1)))`.
#[test]
fn string() {
    let (n, spring, mass) = (3000, 50.0, 0.2);
    let mut entries = springs(n, 1, spring);
    entries.extend([(0, 0, spring), (n - 1, n - 1, spring)]);
    let stiffness = SymmetricMatrix::from_entries(n, entries).unwrap();
    let mass_matrix = diagonal(&vec![mass; n]);
    let modes = lowest_modes(&stiffness, &mass_matrix, 15, 1e-10).unwrap();
    let exact = |k: usize| {
        let sine = (k as f64 * PI / (2.0 * (n as f64 + 1.0))).sin();
        4.0 * spring / mass * sine * sine
    };
    let exact: Vec<f64> = (1..=15).map(exact).collect();
    check(&modes, &stiffness, &mass_matrix, &exact, exact[0], 1e-9);
    for (value, exact) in modes.eigenvalue.iter().zip(&exact) {
        assert!((value / exact - 1.0).abs() < 1e-9);
    }
}

/// A chain with free ends has a rigid-body motion and `lambda_k = 4 (c / m) sin^2(k pi / (2 n))`.
#[test]
fn free_chain() {
    for n in [1, 2, 3, 4, 5, 9, 400] {
        let stiffness = SymmetricMatrix::from_entries(n, springs(n, 1, 7.0)).unwrap();
        let mass = diagonal(&vec![0.5; n]);
        let count = n.min(10);
        let modes = lowest_modes(&stiffness, &mass, count, 1e-11).unwrap();
        let exact = |k: usize| 4.0 * 14.0 * (k as f64 * PI / (2.0 * n as f64)).sin().powi(2);
        // A single mass has no elastic mode; its scale is that of the spring.
        let elastic = if n > 1 { exact(1) } else { 14.0 };
        let exact: Vec<f64> = (0..count).map(exact).collect();
        check(&modes, &stiffness, &mass, &exact, elastic, 1e-9);
    }
}

/// Nine equal free chains: each eigenvalue nine times, more than a block holds.
#[test]
fn repeated_more_often_than_a_block_is_wide() {
    let (n, copies) = (60, 9);
    let entries = (0..copies).flat_map(|copy| {
        let shifted = move |(i, j, x): (usize, usize, f64)| (i + n * copy, j + n * copy, x);
        springs(n, 1, 1.0).into_iter().map(shifted)
    });
    let stiffness = SymmetricMatrix::from_entries(n * copies, entries).unwrap();
    let mass = diagonal(&vec![1.0; n * copies]);
    for count in [5, 9, 20, 31] {
        let modes = lowest_modes(&stiffness, &mass, count, 1e-10).unwrap();
        let exact = |k: usize| {
            let order = (k / copies) as f64;
            4.0 * (order * PI / (2.0 * n as f64)).sin().powi(2)
        };
        let elastic = exact(copies);
        let exact: Vec<f64> = (0..count).map(exact).collect();
        check(&modes, &stiffness, &mass, &exact, elastic, 1e-9);
    }
}

/// Every second mass is zero: springs in series between the others, `lambda` of a chain of half the
/// stiffness, and only as many modes as masses.
#[test]
fn massless_degrees_of_freedom() {
    let n = 41;
    let mut entries = springs(n, 1, 2.0);
    entries.extend([(0, 0, 2.0), (n - 1, n - 1, 2.0)]);
    let stiffness = SymmetricMatrix::from_entries(n, entries).unwrap();
    let mass = diagonal(&(0..n).map(|i| (i % 2) as f64).collect::<Vec<_>>());
    let modes = lowest_modes(&stiffness, &mass, 20, 1e-11).unwrap();
    let exact = |k: usize| 4.0 * (k as f64 * PI / 42.0).sin().powi(2);
    let exact: Vec<f64> = (1..=20).map(exact).collect();
    check(&modes, &stiffness, &mass, &exact, exact[0], 1e-9);
    let error = lowest_modes(&stiffness, &mass, 21, 1e-11).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("21 modes are wanted, but the matrices have 20"),
        "{error}"
    );
}

/// Masses and stiffnesses of very different sizes, and a soft suspension: the lowest eigenvalue is
/// `soft / (sum of masses)`, nearly zero, and is accurate relative to itself.
#[test]
fn soft_suspension() {
    let (n, soft) = (200, 1e-4);
    let mut entries = springs(n, 1, 1e3);
    entries.push((0, 0, soft));
    let stiffness = SymmetricMatrix::from_entries(n, entries).unwrap();
    let masses: Vec<f64> = (0..n)
        .map(|i| if i % 7 == 0 { 1e-9 } else { 1.0 })
        .collect();
    let total: f64 = masses.iter().sum();
    let modes = lowest_modes(&stiffness, &diagonal(&masses), 4, 1e-10).unwrap();
    let exact = soft / total;
    assert!(
        (modes.eigenvalue[0] / exact - 1.0).abs() < 1e-5,
        "{} {exact}",
        modes.eigenvalue[0]
    );
}
