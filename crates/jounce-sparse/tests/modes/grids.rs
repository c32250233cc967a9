//! Membranes: square grids, whose modes `(a, b)` and `(b, a)` have the same eigenvalue.

use super::{check, diagonal, springs};
use jounce_sparse::{Symbolic, SymmetricMatrix, lowest_modes};
use std::f64::consts::PI;

fn one_direction(n: usize, order: usize) -> f64 {
    4.0 * (order as f64 * PI / (2.0 * (n as f64 + 1.0))).sin().powi(2)
}

fn membrane(n: usize) -> SymmetricMatrix {
    let mut entries = springs(n, n, 1.0);
    for i in 0..n * n {
        let (row, column) = (i / n, i % n);
        let edges = [row == 0, row == n - 1, column == 0, column == n - 1];
        entries.push((i, i, edges.into_iter().filter(|edge| *edge).count() as f64));
    }
    SymmetricMatrix::from_entries(n * n, entries).unwrap()
}

#[test]
fn membrane_with_double_eigenvalues() {
    let n = 45;
    let stiffness = membrane(n);
    let mass = diagonal(&vec![1.0; n * n]);
    let orders = (1..9).flat_map(|a| (1..9).map(move |b| (a, b)));
    let mut exact: Vec<f64> = orders
        .map(|(a, b)| one_direction(n, a) + one_direction(n, b))
        .collect();
    exact.sort_by(f64::total_cmp);
    // 2 and 5 end between the two of a pair.
    for count in [1, 2, 3, 5, 24] {
        let modes = lowest_modes(&stiffness, &mass, count, 1e-10).unwrap();
        check(&modes, &stiffness, &mass, &exact[..count], exact[0], 1e-9);
    }
}

/// The number of negative pivots is the number of eigenvalues below a shift, and the factors solve
/// the indefinite system.
#[test]
fn pivots_count_eigenvalues() {
    let n = 30;
    let stiffness = membrane(n);
    let identity = diagonal(&vec![1.0; n * n]);
    let symbolic = Symbolic::new(&stiffness);
    for shift in [-0.1, 0.123, 1.01, 3.917, 6.6, 8.1] {
        let matrix = stiffness.plus(-shift, &identity).unwrap();
        let factor = symbolic.factor(&matrix).unwrap();
        let orders = (1..=n).flat_map(|a| (1..=n).map(move |b| (a, b)));
        let values = orders.map(|(a, b)| one_direction(n, a) + one_direction(n, b));
        assert_eq!(
            factor.negative(),
            values.filter(|value| *value < shift).count(),
            "{shift}"
        );
        let x: Vec<f64> = (0..n * n).map(|i| (i as f64).sin()).collect();
        let solution = factor.solve(&matrix.product(&x));
        let error = solution
            .iter()
            .zip(&x)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(error < 1e-9, "{shift}: {error}");
    }
    // 900 columns; nested dissection of this grid stores about 12 000 entries.
    assert!(symbolic.stored() < 25_000, "{}", symbolic.stored());
}
