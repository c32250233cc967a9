//! Damping ratios of a list, all of them and one.

use super::{fit_and_compare, free_keys, relative_deviation, spec, with_noise};
use jounce_control::Control;
use jounce_experiment::fit::{Features, ModeFeature, fit};
use jounce_model::structure;
use std::f64::consts::TAU;
use std::path::Path;

const CANTILEVER: &str = r#"
[beam.beam]
length = "300 mm"
width = "30 mm"
thickness = "2 mm"
youngs_modulus = "70 GPa"
density = "2700 kg/m^3"

[damping]
ratios = [0.01, 0.01, 0.01, 0.01]

[reduction]
modes = 4
mesh_tolerance = 1e-6
"#;
const TRUTH: [f64; 4] = [0.02, 0.006, 0.013, 0.008];
/// Relative standard deviations of the measured frequencies and damping ratios.
const FREQUENCY: f64 = 0.001;
const DAMPING: f64 = 0.05;

fn features(keys: &[(&str, f64)], ratios: &[f64]) -> Features {
    let (_, truth) = spec(CANTILEVER, &[("beam.beam.youngs_modulus", "72 GPa")]);
    let hz: Vec<f64> = structure::modes(&truth)
        .expect("modes")
        .frequency_rad_s
        .iter()
        .map(|w| w / TAU)
        .collect();
    let (hz, ratios) = (
        with_noise(&hz, FREQUENCY, 3),
        with_noise(ratios, DAMPING, 4),
    );
    let mode = |(k, (hz, ratio)): (usize, (&f64, &f64))| ModeFeature {
        number: k + 1,
        frequency: Some((*hz, relative_deviation(FREQUENCY))),
        damping_ratio: Some((*ratio, relative_deviation(DAMPING))),
        ..ModeFeature::default()
    };
    Features {
        free: free_keys(keys),
        modes: hz.iter().zip(&ratios).enumerate().map(mode).collect(),
        ..Features::default()
    }
}

/// One line frees all four, each with a separate row in the correlation. Every ratio depends only
/// on its measurement, so its deviation is that of measurement and prior combined,
/// `1 / sqrt(1 / 0.05^2 + 1 / 0.6^2)`.
#[test]
fn a_list_of_damping_ratios_comes_back_by_one_line() {
    let truth = [72e9, TRUTH[0], TRUTH[1], TRUTH[2], TRUTH[3]];
    let result = fit_and_compare(
        CANTILEVER,
        &features(
            &[("beam.beam.youngs_modulus", 0.05), ("damping.ratios", 0.6)],
            &TRUTH,
        ),
        &truth,
        0.15,
    );
    let keys: Vec<&str> = result.keys.iter().map(|key| key.key.as_str()).collect();
    let free_ratios = [
        "beam.beam.youngs_modulus",
        "damping.ratios.1",
        "damping.ratios.2",
        "damping.ratios.3",
        "damping.ratios.4",
    ];
    assert_eq!(keys, free_ratios);
    assert!(result.correlation.len() == 5 && result.correlation.iter().all(|row| row.len() == 5));
    let deviation = 1.0 / (DAMPING.powi(-2) + 0.6_f64.powi(-2)).sqrt();
    for key in &result.keys[1..] {
        assert!(
            (key.deviation / deviation - 1.0).abs() < 1e-3,
            "{key:?} {deviation}"
        );
    }
}

/// One number of the list changes, and the others retain their values in the spec.
#[test]
fn one_damping_ratio_of_a_list_comes_back() {
    let keys = [
        ("beam.beam.youngs_modulus", 0.05),
        ("damping.ratios.3", 0.6),
    ];
    let features = features(&keys, &[0.01, 0.01, TRUTH[2], 0.01]);
    fit_and_compare(CANTILEVER, &features, &[72e9, TRUTH[2]], 0.15);
    let (file, spec) = spec(CANTILEVER, &[]);
    let (_, fitted) =
        fit(&file, &spec, &features, Path::new("."), &Control::default()).expect("a fit");
    assert_eq!(
        [
            fitted.damping.ratios[0],
            fitted.damping.ratios[1],
            fitted.damping.ratios[3]
        ],
        [0.01; 3]
    );
}

#[test]
fn a_number_beyond_the_list_or_a_duplicate_is_refused() {
    let fault = |keys: &[(&str, f64)]| {
        let (file, spec) = spec(CANTILEVER, &[]);
        fit(
            &file,
            &spec,
            &features(keys, &TRUTH),
            Path::new("."),
            &Control::default(),
        )
        .expect_err("a fault")
        .to_string()
    };
    let expected = "free: damping.ratios.5: damping.ratios holds 4 numbers; write one of damping.ratios.1 to damping.ratios.4";
    assert_eq!(fault(&[("damping.ratios.5", 0.3)]), expected);
    let duplicate = fault(&[("damping.ratios", 0.3), ("damping.ratios.2", 0.3)]);
    assert!(
        duplicate.contains("damping.ratios.2 is free twice"),
        "{duplicate}"
    );
}
