//! Thin plates of conforming elements: bicubic Hermite polynomials with the four unknowns
//! `w, w_x, w_y, w_xy` at each node (F. K. Bogner, R. L. Fox, L. A. Schmit, 1965).
//!
//! On straight edges, simply supported or free with Poisson's ratio 0, the energy of unit bending
//! stiffness is `integral of w_xx^2 + 2 w_xy^2 + w_yy^2`, so all matrices are Kronecker products of
//! matrices of one direction.

use super::check;
use jounce_sparse::{SymmetricMatrix, lowest_modes};
use std::f64::consts::PI;

type Dense = Vec<Vec<f64>>;

/// `integral h h`, `integral h' h'`, `integral h'' h''` on `elements` elements of unit length in
/// total; without the end values where they are supported.
fn one_direction(elements: usize, is_supported: bool) -> [Dense; 3] {
    let h = 1.0 / elements as f64;
    let symmetric = |factor: f64, e: [f64; 10]| -> [[f64; 4]; 4] {
        let place = |i: usize, j: usize| [0, 4, 7, 9][i.min(j)] + i.abs_diff(j);
        std::array::from_fn(|i| std::array::from_fn(|j| factor * e[place(i, j)]))
    };
    // Upper triangles for a unit element, with a factor h for each slope.
    let scaled = |e: [f64; 10]| {
        let slopes = [0, 1, 0, 1, 2, 1, 2, 0, 1, 2];
        std::array::from_fn(|k| e[k] * h.powi(slopes[k]))
    };
    let mass = scaled([156.0, 22.0, 54.0, -13.0, 4.0, 13.0, -3.0, 156.0, -22.0, 4.0]);
    let slope = scaled([36.0, 3.0, -36.0, 3.0, 4.0, -3.0, -1.0, 36.0, -3.0, 4.0]);
    let bending = scaled([12.0, 6.0, -12.0, 6.0, 4.0, -6.0, 2.0, 12.0, -6.0, 4.0]);
    let all = 2 * (elements + 1);
    let kept: Vec<usize> = (0..all)
        .filter(|i| !is_supported || ![0, all - 2].contains(i))
        .collect();
    [
        symmetric(h / 420.0, mass),
        symmetric(1.0 / (30.0 * h), slope),
        symmetric(1.0 / h.powi(3), bending),
    ]
    .map(|element| {
        let mut sum = vec![vec![0.0; all]; all];
        for start in (0..2 * elements).step_by(2) {
            for i in 0..4 {
                (0..4).for_each(|j| sum[start + i][start + j] += element[i][j]);
            }
        }
        kept.iter()
            .map(|i| kept.iter().map(|j| sum[*i][*j]).collect())
            .collect()
    })
}

/// Entries of `sum of factor A x B`.
fn kronecker(terms: &[(f64, &Dense, &Dense)]) -> SymmetricMatrix {
    let n = terms[0].1.len();
    let band = |i: usize| i.saturating_sub(4)..(i + 5).min(n);
    let mut entries = Vec::new();
    for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
        for (j, l) in band(i).flat_map(|j| band(k).map(move |l| (j, l))) {
            let value: f64 = terms.iter().map(|(f, a, b)| f * a[i][j] * b[k][l]).sum();
            let (row, column) = (i * n + k, j * n + l);
            if value != 0.0 && row >= column {
                entries.push((row, column, value));
            }
        }
    }
    SymmetricMatrix::from_lower(n * n, entries).unwrap()
}

fn plate(elements: usize, is_supported: bool) -> (SymmetricMatrix, SymmetricMatrix) {
    let [mass, slope, bending] = one_direction(elements, is_supported);
    let stiffness = kronecker(&[
        (1.0, &bending, &mass),
        (2.0, &slope, &slope),
        (1.0, &mass, &bending),
    ]);
    (stiffness, kronecker(&[(1.0, &mass, &mass)]))
}

/// `lambda = pi^4 (a^2 + b^2)^2`, the lowest first.
fn supported_eigenvalues(count: usize) -> Vec<f64> {
    let orders = (1..12).flat_map(|a| (1..12).map(move |b| (a * a + b * b) as f64));
    let mut values: Vec<f64> = orders.map(|sum| PI.powi(4) * sum * sum).collect();
    values.sort_by(f64::total_cmp);
    values.truncate(count);
    values
}

#[test]
fn simply_supported_plate() {
    let (stiffness, mass) = plate(30, true);
    let modes = lowest_modes(&stiffness, &mass, 20, 1e-9).unwrap();
    let exact = supported_eigenvalues(20);
    check(&modes, &stiffness, &mass, &exact, exact[0], 1e-4);
}

/// A free square plate has three rigid-body motions. Poisson's ratio is 0 here, for which strips bend
/// as free beams: `lambda = 4.730041^4` among the eigenvalues, twice.
#[test]
fn free_plate() {
    let (stiffness, mass) = plate(24, false);
    let modes = lowest_modes(&stiffness, &mass, 12, 1e-9).unwrap();
    let rigid = &modes.eigenvalue[..3];
    assert!(rigid.iter().all(|value| value.abs() < 1e-5), "{rigid:?}");
    assert!(modes.eigenvalue[3] > 100.0);
    let beam = 4.730_040_744_862_704_f64.powi(4);
    let bending = modes
        .eigenvalue
        .iter()
        .filter(|value| (*value / beam - 1.0).abs() < 1e-5);
    assert_eq!(bending.count(), 2, "{:?}", modes.eigenvalue);
}

/// 100,000 degrees of freedom: 7 s and 0.7 GB on one core in November 2026. The work is bounded here.
#[test]
#[ignore = "takes ten seconds"]
fn large_plate() {
    let (stiffness, mass) = plate(158, true);
    assert_eq!(stiffness.size(), 99_856);
    let modes = lowest_modes(&stiffness, &mass, 20, 1e-8).unwrap();
    assert!(modes.solves <= 110, "{}", modes.solves);
    for (value, exact) in modes.eigenvalue.iter().zip(supported_eigenvalues(20)) {
        assert!((value / exact - 1.0).abs() < 1e-6, "{value} for {exact}");
    }
}
