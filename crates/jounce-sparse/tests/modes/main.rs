//! The lowest modes of structures with known eigenvalues.
#![allow(clippy::unwrap_used, reason = "tests")]

mod chains;
mod faults;
mod grids;
mod networks;
mod plates;

use jounce_sparse::{LowestModes, SymmetricMatrix};

/// Compares eigenvalues with exact ones to a share of the last one, or of the first above zero if it
/// is larger, checks the error bounds, and checks that the shapes are orthonormal in the mass and satisfy the eigenproblem.
fn check(
    modes: &LowestModes,
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
    exact: &[f64],
    first_elastic: f64,
    tolerance: f64,
) {
    assert_eq!(modes.eigenvalue.len(), exact.len());
    let scale = exact[exact.len() - 1].max(first_elastic);
    for (k, (value, exact)) in modes.eigenvalue.iter().zip(exact).enumerate() {
        assert!(
            (value - exact).abs() < tolerance * scale,
            "mode {k}: {value} for {exact}"
        );
        assert!(
            modes.error_bound[k] < tolerance * scale,
            "mode {k}: {:?}",
            modes.error_bound[k]
        );
    }
    let column = |k: usize| modes.shape.column(k).iter().copied().collect::<Vec<f64>>();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for (k, exact) in exact.iter().enumerate() {
        let momentum = mass.product(&column(k));
        for j in 0..=k {
            let expected = if j == k { 1.0 } else { 0.0 };
            let product = dot(&column(j), &momentum);
            assert!((product - expected).abs() < 1e-9, "({j}, {k}): {product}");
        }
        let energy = dot(&column(k), &stiffness.product(&column(k)));
        assert!(
            (energy - exact).abs() < 10.0 * tolerance * scale,
            "mode {k}: energy {energy}"
        );
    }
}

/// A diagonal matrix.
fn diagonal(entries: &[f64]) -> SymmetricMatrix {
    let entries = entries.iter().enumerate().map(|(i, x)| (i, i, *x));
    SymmetricMatrix::from_lower(entries.len(), entries).unwrap()
}

/// Springs of the given stiffness between neighbours, `row` entries in a row, `rows` rows.
fn springs(row: usize, rows: usize, stiffness: f64) -> Vec<(usize, usize, f64)> {
    let pair = |i: usize, j: usize| {
        [
            (i, i, stiffness),
            (j, j, stiffness),
            (i, j, -stiffness),
            (j, i, -stiffness),
        ]
    };
    let across = (0..row * rows)
        .filter(|i| (i + 1) % row > 0)
        .flat_map(|i| pair(i, i + 1));
    let down = (0..row * (rows - 1)).flat_map(|i| pair(i, i + row));
    across.chain(down).collect()
}
