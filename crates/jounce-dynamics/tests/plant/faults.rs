//! Plants that have no diagonal form or no steady state.

use jounce_model::plant::{Plant, PlantError};
use jounce_model::reference::{Harmonic, PiezoResistor};
use std::f64::consts::TAU;

/// Triple root: `(l + 1)^3 = l^3 + 3 l^2 + 3 l + 1` with `1 / (R C) = 3`, `w^2 = 1/3`,
/// `theta^2 / C = 8/3`.
#[test]
fn coinciding_eigenvectors_are_refused() {
    let problem = PiezoResistor {
        mass_kg: 1.0,
        frequency_rad_s: (1.0_f64 / 3.0).sqrt(),
        damping_ratio: 0.0,
        coupling_n_per_v: (8.0_f64 / 3.0).sqrt(),
        capacitance_f: 1.0,
        resistance_ohm: 1.0 / 3.0,
    };
    let error = Plant::new(problem.system(1.0, 1.0)).unwrap_err();
    assert!(
        matches!(error, PlantError::Defective { condition, .. } if condition > 1e7),
        "{error}"
    );
}

#[test]
fn drive_on_an_undamped_mode_is_refused() {
    let problem = Harmonic {
        mass_kg: 1.0,
        frequency_rad_s: TAU * 10.0,
        damping_ratio: 0.0,
        amplitude_n: 1.0,
        drive_hz: 10.0,
    };
    let error = Plant::new(problem.system()).unwrap_err();
    assert!(
        matches!(error, PlantError::UndampedResonance { .. }),
        "{error}"
    );
    assert!(
        Plant::new(
            Harmonic {
                drive_hz: 10.001,
                ..problem
            }
            .system()
        )
        .is_ok()
    );
}
