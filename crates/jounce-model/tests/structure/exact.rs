//! Modes against closed forms and the transfer matrix.

use crate::paper::{
    CLAMPED_HZ, ON_TABLE_HZ, bare_cantilever, frequency_hz, greatest_relative_difference, paper,
    table,
};
use jounce_model::structure::{
    Modes, modes, modes_holding, modes_on_cubic_mesh, shapes_along_beams,
};
use jounce_spec::Section;
use std::f64::consts::PI;

/// A second method without elements; measured: 4e-15.
#[test]
fn frequencies_are_those_of_the_transfer_matrix() {
    let spec = paper(Section::ThinSkin);
    let error = greatest_relative_difference(&frequency_hz(&modes(&spec).unwrap()), &ON_TABLE_HZ);
    assert!(error < 3e-14, "{error:e}");
    let error = greatest_relative_difference(
        &frequency_hz(&modes_holding(&spec, &table()).unwrap()),
        &CLAMPED_HZ,
    );
    assert!(error < 3e-14, "{error:e}");
}

/// Roots of `cos(b) cosh(b) = -1`, by Newton's method on `cos(b) + 1/cosh(b)`.
fn cantilever_root(mode: usize) -> f64 {
    let mut root = if mode == 0 {
        1.875
    } else {
        (mode as f64 + 0.5) * PI
    };
    for _ in 0..50 {
        root += (root.cos() + 1.0 / root.cosh()) / (root.sin() + root.tanh() / root.cosh());
    }
    root
}

/// Measured: frequencies 4e-15 (7 modes) and 2e-14 (40 modes), ends 3e-14 and 3e-13.
#[test]
fn uniform_cantilever_has_its_closed_form() {
    for (count, allowed) in [(7, 5e-14), (40, 2e-13)] {
        let modal = modes(&bare_cantilever(count)).unwrap();
        let scale = (65e9 * 0.98e-3_f64.powi(2) / 12.0 / 2750.0).sqrt() / 0.315_f64.powi(2);
        let exact: Vec<f64> = (0..count)
            .map(|mode| cantilever_root(mode).powi(2) * scale)
            .collect();
        let error = greatest_relative_difference(&modal.frequency_rad_s, &exact);
        assert!(error < allowed, "{count} modes: {error:e}");
        // Mass-normalised cantilever modes end at 2 / sqrt(mass).
        let end = 2.0 / (2750.0 * 0.03 * 0.98e-3 * 0.315_f64).sqrt();
        let error = modal.shape["beam.end"]
            .iter()
            .map(|value| (value / end - 1.0).abs())
            .fold(0.0, f64::max);
        assert!(error < 3e-12, "{count} modes, ends: {error:e}");
    }
}

/// Roundoff does not grow with the mesh: cubic elements approach the exact frequencies from above,
/// as `h^4`, and never from below.
#[test]
#[ignore = "long: runs with ./test --long"]
fn low_frequencies_hold_on_any_cubic_mesh() {
    let spec = paper(Section::ThinSkin);
    let mut before: Option<Vec<f64>> = None;
    for elements in [8, 32, 128, 512] {
        let modal = modes_on_cubic_mesh(&spec, &[], 0.315 / f64::from(elements)).unwrap();
        let errors: Vec<f64> = frequency_hz(&modal)
            .iter()
            .zip(&ON_TABLE_HZ)
            .map(|(one, exact)| one / exact - 1.0)
            .collect();
        assert!(
            errors.iter().all(|error| *error > -1e-13),
            "{elements}: {errors:?}"
        );
        if let Some(before) = before {
            assert!(
                errors
                    .iter()
                    .zip(&before)
                    .all(|(now, before)| *now < before / 100.0 + 1e-13),
                "{elements}: {errors:?} after {before:?}"
            );
        }
        before = Some(errors);
    }
}

/// A tighter tolerance does not change couplings and shapes; measured 6e-15.
#[test]
fn shapes_and_couplings_are_converged() {
    let mut spec = paper(Section::ThinSkin);
    let modal = modes(&spec).unwrap();
    spec.reduction.mesh_tolerance = 1e-12;
    let finer = modes(&spec).unwrap();
    for (name, values) in &finer.shape {
        let largest = values
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for (one, other) in modal.shape[name].iter().zip(values) {
            assert!(
                (one - other).abs() < 1e-13 * largest,
                "{name}: {one} {other}"
            );
        }
    }
    let couplings = |modes: &Modes| modes.patch["mfc"].coupling_n_per_v.clone();
    assert!(greatest_relative_difference(&couplings(&modal), &couplings(&finer)) < 1e-13);
    assert!(
        modal
            .discretisation_error
            .iter()
            .all(|error| *error > 0.0 && *error <= 1e-9)
    );
}

/// `sum shape^2 / w^2` is the static flexibility: `x^3 / (3 EI)` on a bare cantilever; omitted
/// modes would add only positive parts.
#[test]
fn modal_sum_approaches_the_static_deflection() {
    let flexibility = 0.305_f64.powi(3) / (3.0 * 65e9 * 0.03 * 0.98e-3_f64.powi(3) / 12.0);
    let missing = |count| {
        let modal = modes(&bare_cantilever(count)).unwrap();
        let sum: f64 = modal.shape["beam.tip"]
            .iter()
            .zip(&modal.frequency_rad_s)
            .map(|(phi, w)| (phi / w).powi(2))
            .sum();
        1.0 - sum / flexibility
    };
    let (few, many) = (missing(5), missing(60));
    assert!(few > 0.0 && few < 6e-5, "{few:e}");
    assert!(many > 0.0 && many < 6e-8, "{many:e}");
}

#[test]
fn shapes_along_beams_pass_through_the_points() {
    let spec = paper(Section::ThinSkin);
    let modal = modes(&spec).unwrap();
    let along = &shapes_along_beams(&spec, &[], 64).unwrap()["beam"];
    assert_eq!((along.place_m[0], along.place_m[63]), (0.0, 0.315));
    for mode in 0..8 {
        let shape = along.mode(mode).unwrap();
        assert!((shape[0] - modal.shape["table"][mode]).abs() < 1e-13);
        assert!(
            (shape[61] - modal.shape["beam.tip"][mode]).abs() < 1e-10,
            "305 mm is place 61 of 63 to rounding"
        );
        // Each mode adds one node; the first flexible mode also has one, because the table moves
        // against the beam.
        let nodes = shape
            .windows(2)
            .filter(|pair| pair[0] * pair[1] < 0.0)
            .count();
        assert_eq!(nodes, mode);
    }
    assert_eq!(along.mode(8), None);
}
