//! Harvester of the paper: mean power over 10 to 20 s from rest, against other solvers at tight
//! tolerance.

use crate::plants::{bench, from_rest, kernel, relative};

/// Amplitude N, frequency Hz, mean power W: DOP853 at relative tolerance 1e-13, confirmed by a
/// second solver.
const CASES: [(f64, f64, f64); 3] = [
    (50.0, 11.0, 7.0237364131e-5),
    (50.0, 6.0, 1.8880658277e-5),
    (100.0, 11.0, 1.26104875313e-4),
];

#[test]
fn power_of_the_harvester_agrees_with_other_solvers() {
    for (amplitude_n, frequency_hz, power_w) in CASES {
        let kernel = kernel(bench(amplitude_n, frequency_hz));
        for (tolerance, allowed) in [(1e-7, 1e-5), (1e-10, 1e-8)] {
            let result = from_rest(&kernel, 20.0, tolerance);
            let error = relative(result.mean_power_w, power_w);
            let residual = result.energies.residual_relative();
            eprintln!(
                "{amplitude_n} N {frequency_hz} Hz at {tolerance:e}: error {error:.1e}, energy {residual:.1e}"
            );
            assert!(
                error <= allowed,
                "{amplitude_n} N {frequency_hz} Hz at {tolerance:e}: {error:e}"
            );
            assert!(residual.abs() <= 10.0 * tolerance, "{residual:e}");
        }
    }
}

#[test]
fn error_falls_with_the_tolerance() {
    let kernel = kernel(bench(50.0, 11.0));
    let errors: Vec<f64> = [1e-3, 1e-5, 1e-7, 1e-9]
        .into_iter()
        .map(|tolerance| relative(from_rest(&kernel, 20.0, tolerance).mean_power_w, CASES[0].2))
        .collect();
    eprintln!("errors at 1e-3, 1e-5, 1e-7, 1e-9: {errors:?}");
    // Errors of single runs scatter: each must stay below its tolerance, and the tightest far below
    // the loosest.
    let below = errors
        .iter()
        .zip([1e-3, 1e-5, 1e-7, 1e-9])
        .all(|(error, tolerance)| *error <= tolerance);
    assert!(below && errors[3] < 1e-3 * errors[0], "{errors:?}");
}

#[test]
fn the_plant_agrees_with_itself_at_a_tighter_tolerance() {
    for (amplitude_n, frequency_hz, _) in CASES {
        let kernel = kernel(bench(amplitude_n, frequency_hz));
        let tight = from_rest(&kernel, 20.0, 1e-12);
        for (tolerance, allowed) in [(1e-7, 1e-5), (1e-10, 1e-8)] {
            let result = from_rest(&kernel, 20.0, tolerance);
            let error = relative(result.mean_power_w, tight.mean_power_w);
            eprintln!(
                "{amplitude_n} N {frequency_hz} Hz at {tolerance:e}: {error:.1e} of {:.10e} W",
                tight.mean_power_w
            );
            assert!(
                error <= allowed && result.energies.residual_relative().abs() <= 10.0 * tolerance,
                "{error:e}"
            );
        }
    }
}
