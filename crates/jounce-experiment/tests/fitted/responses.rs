//! Frequency responses.

use super::{HARVESTER, fit_and_compare, free_keys, relative_deviation, spec, with_noise};
use jounce_control::Control;
use jounce_experiment::fit::{Deviation, Features, MeasuredLines, ResponseFeature, fit};
use jounce_linalg::c64;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, System};
use jounce_model::structure;
use jounce_signal::RandomStream;
use std::path::Path;

const KEYS: [(&str, f64); 3] = [
    ("beam.beam.youngs_modulus", 0.1),
    ("patch.mfc.capacitance", 0.2),
    ("damping.beyond", 0.5),
];
const TRUTH: [f64; 3] = [72.5e9, 66e-9, 0.016];

/// Voltage over the load per acceleration of the base, of the true harvester.
fn voltage() -> (Vec<f64>, Vec<c64>) {
    let (_, spec) = spec(
        HARVESTER,
        &[
            ("beam.beam.youngs_modulus", "72.5 GPa"),
            ("patch.mfc.capacitance", "66 nF"),
            ("damping.beyond", "0.016"),
        ],
    );
    let plant = Plant::new(
        System::assemble(&spec, structure::modes(&spec).expect("modes")).expect("system"),
    )
    .expect("plant");
    let frequency_hz: Vec<f64> = (0..40).map(|k| 40.0 + 1.5 * f64::from(k)).collect();
    let responses = frf(
        &plant,
        &FrfInput::BaseAcceleration,
        &[FrfOutput::Voltage("mfc".to_owned())],
        &frequency_hz,
    )
    .expect("responses");
    (frequency_hz, responses[0].value.clone())
}

fn features(lines: MeasuredLines, deviation: Deviation) -> Features {
    let (input, output) = (
        FrfInput::BaseAcceleration,
        FrfOutput::Voltage("mfc".to_owned()),
    );
    let feature = ResponseFeature {
        input,
        output,
        lines,
        absolute: false,
        deviation,
        set: Vec::new(),
    };
    Features {
        free: free_keys(&KEYS),
        responses: vec![feature],
        ..Features::default()
    }
}

/// Noise of 2 % on every line. The deviation estimated from residuals equals the true one within
/// its uncertainty: measured 2.0e-2.
#[test]
fn keys_come_back_from_sizes_and_their_deviation_from_residuals() {
    let (frequency_hz, value) = voltage();
    let sizes: Vec<f64> = value.iter().map(|h| h.norm()).collect();
    let result = fit_and_compare(
        HARVESTER,
        &features(
            MeasuredLines::Magnitude(frequency_hz, with_noise(&sizes, 0.02, 1)),
            Deviation::Residuals,
        ),
        &TRUTH,
        0.05,
    );
    let deviation = &result.deviations[0];
    eprintln!(
        "deviation {:.2e} with {:.1?} degrees of freedom",
        deviation.deviation, deviation.degrees_of_freedom
    );
    assert!(
        (deviation.deviation / 0.02 - 1.0).abs() < 0.3
            && deviation
                .degrees_of_freedom
                .is_some_and(|freedom| (freedom - 37.0).abs() < 1.0)
    );
    let curve = &result.curves[0];
    let (before, after) = curve.errors();
    assert!(before > 0.2 && after < 0.03, "{before} {after}");
    // About 95 % of the measurements lie within the interval for a further one.
    let inside = (0..curve.at.len())
        .filter(|k| (curve.low[*k]..=curve.high[*k]).contains(&curve.measured[*k]))
        .count();
    assert!((34..=40).contains(&inside), "{inside}");
}

#[test]
fn keys_come_back_from_complex_values() {
    let (frequency_hz, value) = voltage();
    let mut stream = RandomStream::new(5, 0);
    let with_noise = |h: &c64| {
        let [re, im] = stream.normal_pair();
        h + c64::new(re, im) * (0.02 * h.norm())
    };
    let value = value.iter().map(with_noise).collect();
    let result = fit_and_compare(
        HARVESTER,
        &features(
            MeasuredLines::Complex(frequency_hz, value),
            relative_deviation(0.02),
        ),
        &TRUTH,
        0.03,
    );
    assert_eq!((result.curves.len(), result.features.len()), (2, 0));
    eprintln!("chi square {:.1} for 80 numbers", result.chi_square);
    assert!(
        (40.0..125.0).contains(&result.chi_square) && result.warnings.is_empty(),
        "{:?}",
        result.warnings
    );
}

/// A sensor on the tip also moves with the base: its transmissibility is 1 plus the relative
/// response of the tip. It recovers the keys where it is specified as absolute.
#[test]
fn a_sensor_on_the_structure_moves_with_the_base() {
    let (file, model) = spec(HARVESTER, &[]);
    let (_, truth) = spec(
        HARVESTER,
        &[
            ("beam.beam.youngs_modulus", "72.5 GPa"),
            ("damping.beyond", "0.016"),
        ],
    );
    let plant = Plant::new(
        System::assemble(&truth, structure::modes(&truth).expect("modes")).expect("system"),
    )
    .expect("plant");
    let frequency_hz: Vec<f64> = (0..40).map(|k| 40.0 + 1.5 * f64::from(k)).collect();
    let output = FrfOutput::Acceleration("beam.end".to_owned());
    let responses = frf(
        &plant,
        &FrfInput::BaseAcceleration,
        std::slice::from_ref(&output),
        &frequency_hz,
    )
    .expect("responses");
    let on_structure = responses[0].value.iter().map(|h| h + 1.0).collect();
    let lines = MeasuredLines::Complex(frequency_hz, on_structure);
    let feature = ResponseFeature {
        input: FrfInput::BaseAcceleration,
        output,
        lines,
        absolute: true,
        deviation: relative_deviation(0.001),
        set: Vec::new(),
    };
    let keys = [("beam.beam.youngs_modulus", 0.1), ("damping.beyond", 0.5)];
    let on_structure = Features {
        free: free_keys(&keys),
        responses: vec![feature],
        ..Features::default()
    };
    let (result, _) = fit(
        &file,
        &model,
        &on_structure,
        Path::new("."),
        &Control::default(),
    )
    .expect("a fit");
    let errors = [
        result.keys[0].after / 72.5e9 - 1.0,
        result.keys[1].after / 0.016 - 1.0,
    ];
    eprintln!("absolute: {:.1e} {:.1e} off", errors[0], errors[1]);
    assert!(
        errors.iter().all(|error| error.abs() < 1e-4) && result.warnings.is_empty(),
        "{errors:?} {:?}",
        result.warnings
    );
}

/// A file in V/N is refused where voltage per acceleration of the base is expected; one in V/g is
/// converted.
#[test]
fn the_unit_of_a_file_is_used() {
    let (file, model) = spec(HARVESTER, &[]);
    let folder = tempfile::tempdir().expect("a folder");
    for (unit, fits) in [("V/g", true), ("V/N", false), ("V", false), ("", true)] {
        let (frequency_hz, value) = voltage();
        let row =
            |(hz, h): (&f64, &c64)| format!("{hz},{:e},{:e}\n", h.re * 9.80665, h.im * 9.80665);
        let rows: String = frequency_hz.iter().zip(&value).map(row).collect();
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" [{unit}]")
        };
        std::fs::write(
            folder.path().join("frf.csv"),
            format!("frequency [Hz],mfc.re{unit},mfc.im{unit}\n{rows}"),
        )
        .expect("a file");
        let lines = MeasuredLines::File {
            path: "frf.csv".into(),
            channel: "mfc".to_owned(),
            between_hz: (0.0, 1e3),
        };
        let features = Features {
            folder: folder.path().to_owned(),
            ..features(lines, relative_deviation(0.01))
        };
        match fit(
            &file,
            &model,
            &features,
            Path::new("."),
            &Control::default(),
        ) {
            Ok((result, _)) => {
                assert!(fits, "{unit}");
                assert_eq!(
                    result
                        .warnings
                        .iter()
                        .any(|message| message.contains("has no unit")),
                    unit.is_empty(),
                    "{:?}",
                    result.warnings
                );
                let error = result.keys[1].after / TRUTH[1] - 1.0;
                assert!(unit.is_empty() || error.abs() < 1e-3, "{error:e}");
            }
            Err(fault) => assert!(
                !fits && fault.to_string().contains("is in V/(m/s^2)"),
                "{unit}: {fault}"
            ),
        }
    }
}
