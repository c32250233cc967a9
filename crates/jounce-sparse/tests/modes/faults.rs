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

/// Diagonal matrices need no iteration, and have the same faults.
#[test]
fn uncoupled_degrees_of_freedom() {
    let modes = |stiffness: &[f64], masses: &[f64], count| {
        lowest_modes(&diagonal(stiffness), &diagonal(masses), count, 1e-9)
    };
    let found = modes(&[8.0, 0.0, 3.0], &[4.0, 1.0, 0.0], 2).unwrap();
    assert_eq!(found.eigenvalue, [0.0, 2.0]);
    assert_eq!(found.shape.column(1).as_slice(), [0.5, 0.0, 0.0]);
    assert!(modes(&[8.0, 0.0, 3.0], &[4.0, 1.0, 0.0], 3).is_err());
    let negative = modes(&[-1.0, 1.0], &[1.0, 1.0], 1);
    assert_eq!(
        negative,
        Err(SparseError::IndefiniteStiffness { negative: 1 })
    );
    let negative = modes(&[1.0, 1.0], &[1.0, -1.0], 1);
    assert_eq!(negative, Err(SparseError::IndefiniteMass { negative: 1 }));
}

/// A degree of freedom with neither mass nor stiffness, in uncoupled and in coupled matrices.
#[test]
fn empty_rows_are_singular() {
    let coupled = [(0, 0, 1.0), (2, 0, 0.1), (2, 2, 1.0)];
    let coupled = SymmetricMatrix::from_lower(3, coupled).unwrap();
    for stiffness in [diagonal(&[1.0, 0.0, 2.0]), coupled] {
        let error = lowest_modes(&stiffness, &diagonal(&[1.0, 0.0, 1.0]), 1, 1e-9).unwrap_err();
        assert_eq!(error, SparseError::Singular { row: 1 });
    }
}
