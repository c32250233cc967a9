//! Matrices that are not those of a structure.

use super::{diagonal, springs};
use jounce_sparse::{SparseError, SymmetricMatrix, lowest_modes};

fn chain() -> SymmetricMatrix {
    let mut entries = springs(20, 1, 3.0);
    entries.push((0, 0, 3.0));
    SymmetricMatrix::from_entries(20, entries).unwrap()
}

#[test]
fn indefinite_matrices_are_named() {
    let mut masses = vec![1.0; 20];
    let modes = |stiffness: &SymmetricMatrix, masses: &[f64]| {
        lowest_modes(stiffness, &diagonal(masses), 3, 1e-9).unwrap_err()
    };
    let negative = chain()
        .plus(1.0, &diagonal(&[vec![-9.0], vec![0.0; 19]].concat()))
        .unwrap();
    assert_eq!(
        modes(&negative, &masses),
        SparseError::IndefiniteStiffness { negative: 1 }
    );
    masses[4] = -0.1;
    masses[7] = -1e-3;
    assert_eq!(
        modes(&chain(), &masses),
        SparseError::IndefiniteMass { negative: 2 }
    );
    let massless = modes(&chain(), &[0.0; 20]);
    assert_eq!(
        massless,
        SparseError::TooManyModes {
            count: 3,
            available: 0
        }
    );
}

#[test]
fn sizes_must_agree() {
    let error = lowest_modes(&chain(), &diagonal(&[1.0; 19]), 3, 1e-9).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("stiffness has 20 rows, but mass has 19"),
        "{error}"
    );
}

/// A degree of freedom with neither mass nor stiffness.
#[test]
fn empty_rows_are_singular() {
    let stiffness = chain()
        .row(0)
        .next()
        .map(|_| diagonal(&[1.0, 0.0, 2.0]))
        .unwrap();
    let error = lowest_modes(&stiffness, &diagonal(&[1.0, 0.0, 1.0]), 1, 1e-9).unwrap_err();
    assert_eq!(error, SparseError::Singular { row: 1 });
}
