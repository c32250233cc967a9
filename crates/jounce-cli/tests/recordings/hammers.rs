//! `frf --measured` and `modes --measured` of hammer and shaker tests.

use super::{assert_keys, assert_written, csv, jounce};
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// Three hits of 4 s each at 500 Hz on a structure of two modes, 20 Hz with 2 % and 57 Hz with 1 % damping, seen at two places. The
/// recursion has the poles of the structure exactly.
fn write_hammer_test(folder: &Path, name: &str, change: impl Fn(usize, f64) -> f64) {
    const RATE: f64 = 500.0;
    let pulse = |k: usize| {
        if k % 2000 >= 40 && k % 2000 < 44 {
            50.0 * (PI * ((k % 2000 - 40) as f64 + 0.5) / 4.0).sin()
        } else {
            0.0
        }
    };
    let force: Vec<f64> = (0..6000).map(|k| change(k, pulse(k))).collect();
    let mode = |frequency_hz: f64, damping_ratio: f64| {
        let w = TAU * frequency_hz;
        let (size, angle) = (
            (-damping_ratio * w / RATE).exp(),
            w * (1.0 - damping_ratio * damping_ratio).sqrt() / RATE,
        );
        let (mut last, mut second_last, mut last_force) = (0.0, 0.0, 0.0);
        let step = |f: &f64| {
            let value = 2.0 * size * angle.cos() * last - size * size * second_last
                + size * angle.sin() / (w * RATE) * last_force;
            (second_last, last, last_force) = (last, value, *f);
            value
        };
        force.iter().map(step).collect::<Vec<f64>>()
    };
    let (first, second) = (mode(20.0, 0.02), mode(57.0, 0.01));
    let row = |k: usize| {
        vec![
            k as f64 / RATE,
            force[k],
            first[k] + second[k],
            0.6 * first[k] - 0.8 * second[k],
        ]
    };
    csv(
        &folder.join(name),
        "time [s],hammer [N],tip [m],middle [m]",
        (0..6000).map(row),
    );
}

#[test]
fn frf_of_a_hammer_test_has_every_hit() {
    let folder = tempfile::tempdir().unwrap();
    write_hammer_test(folder.path(), "hits.csv", |_, force| force);
    let (code, json, stderr) = jounce(
        folder.path(),
        &[
            "frf",
            "--measured",
            "hits.csv",
            "--force-window",
            "--json",
            "--out",
            "frf",
        ],
    );
    assert_eq!(code, 0, "{stderr}");
    assert_keys(
        &json,
        &[
            "frequency_hz",
            "responses",
            "hits",
            "block_s",
            "window_decay_per_s",
            "issues",
        ],
    );
    assert_keys(
        &json["responses"]["tip"],
        &["re", "im", "unit", "coherence"],
    );
    assert_eq!(
        (
            json["hits"].as_array().unwrap().len(),
            &json["responses"]["tip"]["unit"]
        ),
        (3, &Value::from("m/N"))
    );
    assert_written(&folder.path().join("frf"), &["frf"], &["frf"]);
}

/// Keys of `modes` of a recording.
const MODES_KEYS: [&str; 9] = [
    "modes",
    "responses",
    "mac",
    "misfit",
    "stabilisation",
    "hits",
    "block_s",
    "window_decay_per_s",
    "issues",
];

/// Keys of a mode.
const MODE_KEYS: [&str; 5] = [
    "frequency_hz",
    "frequency_deviation_hz",
    "damping_ratio",
    "damping_deviation",
    "shape",
];

/// Frequency, damping ratio and the ratio of the shape at the two places.
fn check_mode(mode: &Value, frequency_hz: f64, damping_ratio: f64, ratio: f64) {
    let number = |key: &str| mode[key].as_f64().unwrap();
    eprintln!(
        "{:.1e} {:.1e} off",
        number("frequency_hz") / frequency_hz - 1.0,
        number("damping_ratio") / damping_ratio - 1.0
    );
    assert!(
        (number("frequency_hz") / frequency_hz - 1.0).abs() < 1e-4,
        "{mode}"
    );
    assert!(
        (number("damping_ratio") / damping_ratio - 1.0).abs() < 5e-3,
        "{mode}"
    );
    assert!(
        (mode["shape"]["re"][1].as_f64().unwrap() - ratio).abs() < 1e-3,
        "{mode}"
    );
}

/// Measured: frequencies within 5.4e-6, damping ratios within 1.7e-4 relative.
#[test]
fn modes_of_a_hammer_test_are_those_of_the_structure() {
    let folder = tempfile::tempdir().unwrap();
    write_hammer_test(folder.path(), "hits.csv", |_, force| force);
    let arguments = [
        "modes",
        "--measured",
        "hits.csv",
        "--between",
        "5Hz:120Hz",
        "--order",
        "20",
        "--json",
        "--out",
        "modes",
    ];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    assert_keys(&json, &MODES_KEYS);
    let modes = json["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 2, "{json}");
    for (mode, (frequency_hz, damping_ratio, ratio)) in
        modes.iter().zip([(20.0, 0.02, 0.6), (57.0, 0.01, -0.8)])
    {
        assert_keys(mode, &MODE_KEYS);
        check_mode(mode, frequency_hz, damping_ratio, ratio);
    }
    // |1 - 0.48|^2 / ((1 + 0.36) (1 + 0.64))
    assert!(
        (json["mac"][0][1].as_f64().unwrap() - 0.121_234).abs() < 1e-3
            && (json["mac"][1][1].as_f64().unwrap() - 1.0).abs() < 1e-12
    );
    assert_written(
        &folder.path().join("modes"),
        &["modes", "modes-stabilisation"],
        &["modes-stabilisation", "modes-fit"],
    );
}

#[test]
fn faulty_hits_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    write_hammer_test(folder.path(), "double.csv", |k, force| {
        if k == 2050 { 20.0 } else { force }
    });
    let (code, json, _) = jounce(
        folder.path(),
        &["frf", "--measured", "double.csv", "--json"],
    );
    let warnings = |hit: usize| json["hits"][hit]["warnings"].to_string();
    assert!(
        code == 0 && warnings(1).contains("double") && warnings(0) == "[]",
        "{}",
        json["hits"]
    );
    write_hammer_test(folder.path(), "clipped.csv", |_, force| force.min(15.0));
    let (code, json, _) = jounce(
        folder.path(),
        &["frf", "--measured", "clipped.csv", "--json"],
    );
    assert!(
        code == 0 && json["hits"][0]["warnings"].to_string().contains("clipped"),
        "{}",
        json["hits"]
    );
}

/// A random force of both signs is recognised as a shaker: 15 blocks, and the response 2 of a scale.
#[test]
fn a_continuous_force_is_a_shaker() {
    let folder = tempfile::tempdir().unwrap();
    let folder_path = folder.path();
    let force = |k: u32| (f64::from(k) * 0.7).sin() + (f64::from(k).powi(2) * 1e-4).sin();
    csv(
        &folder_path.join("shaken.csv"),
        "time [s],force [N],a [m/s^2]",
        (0..8_000).map(|k| vec![f64::from(k) / 1000.0, force(k), 2.0 * force(k)]),
    );
    let (code, json, stderr) = jounce(folder_path, &["frf", "--measured", "shaken.csv", "--json"]);
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(
        (
            json["block_s"].as_f64(),
            json["hits"].as_array().map(Vec::len)
        ),
        (Some(1.0), Some(0))
    );
    assert!(
        (json["responses"]["a"]["re"][112].as_f64().unwrap() - 2.0).abs() < 1e-9,
        "{}",
        json["responses"]["a"]["re"][112]
    );
    let (code, _, stderr) = jounce(
        folder_path,
        &["frf", "--measured", "shaken.csv", "--end-ratio", "0.01"],
    );
    assert!(code != 0 && stderr.contains("is continuous"), "{stderr}");
}
