//! Proof that no mode was missed.

use super::*;

/// A single mode, or several equal ones, are the lowest only if no eigenvalue lies below them.
#[test]
fn a_mode_below_all_found_is_missed() {
    // Masses of 1 kg between fixed ends, with springs of 1 N/m: 2 - sqrt(2), 2, 2 + sqrt(2).
    let diagonal = |x: f64| (0..3).map(move |i| (i, i, x));
    let mass = SymmetricMatrix::from_lower(3, diagonal(1.0)).unwrap();
    let springs = [(1, 0, -1.0), (2, 1, -1.0)];
    let stiffness = SymmetricMatrix::from_lower(3, diagonal(2.0).chain(springs)).unwrap();
    let problem = Problem::new(&stiffness, &mass).unwrap();
    let shift = -1.0;
    let factor = problem.factor(shift).unwrap();
    let is_proved = |eigenvalue: f64| {
        let mut space = Krylov::new(&factor, &mass);
        space.extend();
        let mut ritz = space.ritz().unwrap();
        ritz.theta[0] = 1.0 / (eigenvalue - shift);
        let search = Search {
            problem: &problem,
            space,
            shift,
            count: 1,
            tolerance: 1e-10,
        };
        search.none_missed(&ritz).unwrap()
    };
    assert!(is_proved(2.0 - 2.0_f64.sqrt()) && !is_proved(2.0));
}
