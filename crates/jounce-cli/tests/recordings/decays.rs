//! `jounce modes --measured` without a measured force.

use super::{csv, has, jounce, written};
use jounce_core::drive::RandomStream;
use std::f64::consts::TAU;
use std::path::Path;

const RATE: f64 = 200.0;
/// Frequency, damping ratio, and the second place's share of each mode.
const MODES: [(f64, f64, f64); 2] = [(11.0, 0.01, 0.6), (37.0, 0.006, -0.8)];

/// Decays of two modes at two places; the first 0.1 s the structure is still held.
fn released(folder: &Path, name: &str, noise: f64) {
    let mut stream = RandomStream::new(4, 0);
    let mut row = |k: usize| {
        let t = k as f64 / RATE;
        let mode = |(f, zeta, _): &(f64, f64, f64)| {
            let w = TAU * f;
            if t < 0.1 {
                1.0
            } else {
                (-zeta * w * (t - 0.1)).exp() * (w * (1.0 - zeta * zeta).sqrt() * (t - 0.1)).cos()
            }
        };
        let [a, b] = stream.normal_pair();
        let [one, two] = [0, 1].map(|k| mode(&MODES[k]));
        vec![
            t,
            one + two + noise * a,
            MODES[0].2 * one + MODES[1].2 * two + noise * b,
        ]
    };
    csv(
        &folder.join(name),
        "time [s],tip [m],middle [m]",
        (0..700).map(&mut row),
    );
}

/// The same structure under white noise for 300 s.
fn shaken_by_noise(folder: &Path, name: &str) {
    let mut stream = RandomStream::new(7, 0);
    let (mut state, mut rows) = ([[0.0_f64; 2]; 2], Vec::new());
    for k in 0..60_000 {
        for (q, (f, zeta, _)) in state.iter_mut().zip(MODES) {
            let (size, turn) = (
                (-zeta * TAU * f / RATE).exp(),
                TAU * f * (1.0 - zeta * zeta).sqrt() / RATE,
            );
            let [a, b] = stream.normal_pair();
            *q = [
                size * (turn.cos() * q[0] - turn.sin() * q[1]) + a,
                size * (turn.sin() * q[0] + turn.cos() * q[1]) + b,
            ];
        }
        let [one, two] = [state[0][0], state[1][0]];
        rows.push(vec![
            f64::from(k) / RATE,
            one + two,
            MODES[0].2 * one + MODES[1].2 * two,
        ]);
    }
    csv(
        &folder.join(name),
        "time [s],tip [m],middle [m]",
        rows.into_iter(),
    );
}

/// Largest errors of frequencies and damping ratios, relative, and of the shape at the second place.
fn errors(json: &serde_json::Value) -> [f64; 3] {
    let modes = json["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 2, "{json}");
    let mut worst = [0.0_f64; 3];
    for (mode, (frequency_hz, damping_ratio, share)) in modes.iter().zip(MODES) {
        has(
            mode,
            &[
                "frequency_hz",
                "frequency_deviation_hz",
                "damping_ratio",
                "damping_deviation",
                "shape",
            ],
        );
        let off = |key: &str, truth: f64| mode[key].as_f64().unwrap() / truth - 1.0;
        let shape = mode["shape"]["re"][1].as_f64().unwrap()
            / mode["shape"]["re"][0].as_f64().unwrap()
            - share;
        for (worst, off) in worst.iter_mut().zip([
            off("frequency_hz", frequency_hz),
            off("damping_ratio", damping_ratio),
            shape,
        ]) {
            *worst = worst.max(off.abs());
        }
    }
    worst
}

/// Measured with noise of 1 % of the release: frequencies within 1.1e-5, damping ratios 6.2e-3, shapes 2.5e-3.
#[test]
fn modes_come_from_free_decays() {
    let folder = tempfile::tempdir().unwrap();
    released(folder.path(), "decay.csv", 0.01);
    let arguments = [
        "modes",
        "--measured",
        "decay.csv",
        "--free-decay",
        "--span",
        "0.1s:3.4s",
        "--order",
        "20",
        "--json",
        "--out",
        "out",
    ];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    has(
        &json,
        &[
            "modes",
            "responses",
            "mac",
            "misfit",
            "stabilisation",
            "hits",
            "block_s",
            "window_decay_per_s",
            "findings",
        ],
    );
    let [frequency, damping, shape] = errors(&json);
    eprintln!(
        "free decays: frequencies {frequency:.1e}, damping ratios {damping:.1e}, shapes {shape:.1e} off"
    );
    assert!(frequency < 2e-4 && damping < 0.02 && shape < 0.01, "{json}");
    written(
        &folder.path().join("out"),
        &["modes", "modes-stabilisation"],
        &["modes-stabilisation", "modes-fit"],
    );
}

/// Measured over 300 s: frequencies within 5.2e-4, damping ratios 0.21 (7 % is the best that 300 s allow on average), shapes 1.5e-3.
#[test]
fn modes_come_from_outputs_alone() {
    let folder = tempfile::tempdir().unwrap();
    shaken_by_noise(folder.path(), "ambient.csv");
    let arguments = [
        "modes",
        "--measured",
        "ambient.csv",
        "--output-only",
        "--reference",
        "tip",
        "--lags",
        "2s",
        "--order",
        "20",
        "--json",
    ];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    let [frequency, damping, shape] = errors(&json);
    eprintln!(
        "outputs alone: frequencies {frequency:.1e}, damping ratios {damping:.1e}, shapes {shape:.1e} off"
    );
    assert!(frequency < 3e-3 && damping < 0.3 && shape < 0.05, "{json}");
}

#[test]
fn what_holds_no_decay_is_told() {
    let folder = tempfile::tempdir().unwrap();
    released(folder.path(), "decay.csv", 0.0);
    for (arguments, code, words) in [
        (vec!["--free-decay", "--span", "3s:1s"], 2, "--span"),
        (vec!["--free-decay", "--span", "3.45s:4s"], 4, "samples"),
        (vec!["--free-decay", "--response", "tap"], 4, "tip"),
        (vec!["--free-decay", "--output-only"], 2, "--output-only"),
        (vec!["--output-only", "--lags", "2s"], 4, "quarter"),
        (vec!["--output-only", "--lags", "0.1s"], 4, "samples"),
        (vec!["--output-only", "--reference", "hammer"], 4, "middle"),
        (vec!["decay.csv", "--output-only"], 2, "--output-only"),
    ] {
        let (found, _, stderr) = jounce(
            folder.path(),
            &[&["modes", "--measured", "decay.csv"], &arguments[..]].concat(),
        );
        assert!(
            found == code && stderr.contains(words) && !stderr.contains("panicked"),
            "{arguments:?} {found}: {stderr}"
        );
    }
}
