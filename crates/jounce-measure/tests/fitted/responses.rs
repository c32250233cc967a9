//! Frequency responses.

use super::{HARVESTER, free, given, noisy, recovered, spec};
use faer::c64;
use jounce::drive::Stream;
use jounce::linear::{Input, Response, frf};
use jounce::plant::{Plant, System};
use jounce::structure;
use jounce_measure::fit::{Deviation, Features, Lines, ResponseFeature};

const KEYS: [(&str, f64); 3] = [("beam.beam.youngs_modulus", 0.1), ("patch.mfc.capacitance", 0.2), ("damping.beyond", 0.5)];
const TRUTH: [f64; 3] = [72.5e9, 66e-9, 0.016];

/// Voltage over the load per acceleration of the base, of the true harvester.
fn voltage() -> (Vec<f64>, Vec<c64>) {
    let (_, spec) =
        spec(HARVESTER, &[("beam.beam.youngs_modulus", "72.5 GPa"), ("patch.mfc.capacitance", "66 nF"), ("damping.beyond", "0.016")]);
    let plant = Plant::new(System::assemble(&spec, structure::modes(&spec).expect("modes")).expect("system")).expect("plant");
    let frequency_hz: Vec<f64> = (0..40).map(|k| 40.0 + 1.5 * f64::from(k)).collect();
    let found = frf(&plant, &Input::BaseAcceleration, &[Response::Voltage("mfc".to_owned())], &frequency_hz).expect("responses");
    (frequency_hz, found[0].value.clone())
}

fn features(lines: Lines, deviation: Deviation) -> Features {
    let feature =
        ResponseFeature { input: Input::BaseAcceleration, output: Response::Voltage("mfc".to_owned()), lines, deviation, set: Vec::new() };
    Features { free: free(&KEYS), responses: vec![feature], ..Features::default() }
}

/// Noise of 2 % on every line. The deviation that residuals tell is the one that was put in, within its own: measured 2.0e-2.
#[test]
fn keys_come_back_from_sizes_and_their_deviation_from_residuals() {
    let (frequency_hz, value) = voltage();
    let sizes: Vec<f64> = value.iter().map(|h| h.norm()).collect();
    let answer =
        recovered(HARVESTER, &features(Lines::Magnitude(frequency_hz, noisy(&sizes, 0.02, 1)), Deviation::Residuals), &TRUTH, 0.05);
    let found = &answer.deviations[0];
    eprintln!("deviation {:.2e} with {:.1?} degrees of freedom", found.deviation, found.degrees_of_freedom);
    assert!((found.deviation / 0.02 - 1.0).abs() < 0.3 && found.degrees_of_freedom.is_some_and(|freedom| (freedom - 37.0).abs() < 1.0));
    let curve = &answer.curves[0];
    let (before, after) = curve.errors();
    assert!(before > 0.2 && after < 0.03, "{before} {after}");
    // 95 % of the measurements lie within the interval for a further one, more or less.
    let inside = (0..curve.at.len()).filter(|k| (curve.low[*k]..=curve.high[*k]).contains(&curve.measured[*k])).count();
    assert!((34..=40).contains(&inside), "{inside}");
}

#[test]
fn keys_come_back_from_complex_values() {
    let (frequency_hz, value) = voltage();
    let mut stream = Stream::new(5, 0);
    let noisy = |h: &c64| {
        let [re, im] = stream.normal_pair();
        h + c64::new(re, im) * (0.02 * h.norm())
    };
    let value = value.iter().map(noisy).collect();
    let answer = recovered(HARVESTER, &features(Lines::Complex(frequency_hz, value), given(0.02)), &TRUTH, 0.03);
    assert_eq!((answer.curves.len(), answer.features.len()), (2, 0));
    eprintln!("chi square {:.1} for 80 numbers", answer.chi_square);
    assert!((40.0..125.0).contains(&answer.chi_square) && answer.warnings.is_empty(), "{:?}", answer.warnings);
}
