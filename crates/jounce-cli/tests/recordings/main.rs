//! Commands on recordings from the outside: keys of their results, tables and pictures.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod base;
mod decays;
mod drives;
mod fit_curves;
mod fit_help;
mod fits;
mod force_tables;
mod hammers;
mod messages;
#[path = "../program/mod.rs"]
mod program;
mod reading;
mod two_hammer_points;
mod wrong_input;

use program::{jounce_in, outcome, program, with_json};
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::path::Path;

fn jounce(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    with_json(jounce_in(folder, arguments))
}

fn assert_keys(value: &Value, keys: &[&str]) {
    keys.iter()
        .for_each(|key| assert!(value.get(*key).is_some(), "{key} is missing in {value}"));
}

/// Every table and picture of these names.
fn assert_written(folder: &Path, tables: &[&str], pictures: &[&str]) {
    let assert_file = |name: &str, extension: &str| {
        assert!(
            folder.join(format!("{name}.{extension}")).is_file(),
            "{name}.{extension} is missing"
        )
    };
    tables.iter().for_each(|name| {
        ["csv", "manifest.json", "parquet", "json"]
            .iter()
            .for_each(|extension| assert_file(name, extension))
    });
    pictures.iter().for_each(|name| {
        ["svg", "png", "pdf"]
            .iter()
            .for_each(|extension| assert_file(name, extension))
    });
    for table in tables {
        let manifest =
            std::fs::read_to_string(folder.join(format!("{table}.manifest.json"))).unwrap();
        assert!(manifest.contains("recording_sha256"), "{manifest}");
    }
}

fn csv(path: &Path, head: &str, rows: impl Iterator<Item = Vec<f64>>) {
    let row = |row: Vec<f64>| {
        row.iter()
            .map(|x| format!("{x:?}"))
            .collect::<Vec<_>>()
            .join(",")
    };
    std::fs::write(
        path,
        format!("{head}\n{}\n", rows.map(row).collect::<Vec<_>>().join("\n")),
    )
    .unwrap();
}

/// 20 s at 512 Hz under 8 Hz: 1 V peak, from the middle on 3 V with a subharmonic of 1 V; the base moves with 2 m/s^2 peak.
fn write_switching_recording(folder: &Path) {
    let value = |k: u32| {
        let t = f64::from(k) / 512.0;
        let voltage = if k < 5120 {
            (TAU * 8.0 * t).sin()
        } else {
            3.0 * (TAU * 8.0 * t).sin() + (TAU * 4.0 * t).cos()
        };
        vec![t, voltage, 2.0 * (TAU * 8.0 * t).sin()]
    };
    csv(
        &folder.join("switch.csv"),
        "time [s],piezo [V],base [m/s^2]",
        (0..10_240).map(value),
    );
}

/// Two half sines of 1 ms, 40 N and 30 N, at 50 kHz: a hammer on a linear spring.
fn write_contact_recording(folder: &Path) {
    let force = |k: u32| {
        let pulse = |start: u32, peak: f64| {
            let x = f64::from(k.wrapping_sub(start)) / 50.0;
            if k >= start && x < 1.0 {
                peak * (PI * x).sin()
            } else {
                0.0
            }
        };
        let noise = 1e-3 * (f64::from(k) * 1.7).sin();
        vec![
            f64::from(k) / 50_000.0,
            pulse(1000, 40.0) + pulse(11_000, 30.0) + noise,
        ]
    };
    csv(
        &folder.join("hammer.csv"),
        "time [s],hammer [N]",
        (0..20_000).map(force),
    );
    let row = |k: u32| {
        let [time_s, force_n] = force(k)[..] else {
            unreachable!("a time and a force")
        };
        vec![time_s, force_n, 2.0 * force_n]
    };
    csv(
        &folder.join("motion.csv"),
        "time [s],hammer [N],motion [m/s^2]",
        (0..20_000).map(row),
    );
}

/// Keys of a record of `power`.
const POWER_KEYS: [&str; 12] = [
    "name",
    "channel",
    "resistance_ohm",
    "mean_square_base_acceleration_m2_s4",
    "orders",
    "issues",
    "mean_power_w",
    "half_width_w",
    "batches",
    "batch_correlation",
    "correlated",
    "mean_voltage_v",
];

/// 1 V peak for one half, 3 V and 1 V peak for the other, over 1 kohm: (0.5 + 5) / 2 mW. The base's mean square is 2.
#[test]
fn power_is_printed_for_each_load() {
    let folder = tempfile::tempdir().unwrap();
    write_switching_recording(folder.path());
    let loads = [
        "--resistance",
        "1kohm",
        "--resistance",
        "4kohm",
        "--base",
        "base",
        "--drive",
        "8Hz",
    ];
    let arguments = [
        &[
            "power",
            "switch.csv",
            "switch.csv",
            "--json",
            "--out",
            "out",
        ],
        &loads[..],
    ]
    .concat();
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    let records = json["records"].as_array().unwrap();
    assert_keys(&records[0], &POWER_KEYS);
    assert_keys(
        &records[0]["orders"][0],
        &["order", "frequency_hz", "amplitude_peak_v"],
    );
    for (record, expected) in records.iter().zip([2.75e-3, 2.75e-3 / 4.0]) {
        let power = record["mean_power_w"].as_f64().unwrap();
        let normalised_power = record["mean_power_per_mean_square_w_s4_m2"]
            .as_f64()
            .unwrap();
        assert!(
            (power / expected - 1.0).abs() < 1e-9
                && (normalised_power / expected * 2.0 - 1.0).abs() < 1e-9,
            "{power} {normalised_power}"
        );
    }
    // Half of the record has another power: that the interval is too narrow must be said.
    assert_eq!(records[0]["correlated"], true);
    assert_written(
        &folder.path().join("out"),
        &["power"],
        &["power-load", "power-spectrum"],
    );
}

#[test]
fn segments_find_the_switch_and_its_subharmonic() {
    let folder = tempfile::tempdir().unwrap();
    write_switching_recording(folder.path());
    let arguments = [
        "segments",
        "switch.csv",
        "--drive",
        "8Hz",
        "--resistance",
        "1kohm",
        "--json",
        "--out",
        "out",
    ];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    assert_keys(
        &json,
        &["channel", "segments", "joints", "uncertainty_s", "issues"],
    );
    let segments = json["segments"].as_array().unwrap();
    assert_eq!(segments.len(), 2, "{json}");
    assert_keys(
        &segments[0],
        &["start_s", "end_s", "rms", "period_cycles", "mismatch"],
    );
    assert!((segments[1]["start_s"].as_f64().unwrap() - 10.0).abs() < 0.75);
    assert_eq!(
        (&segments[0]["period_cycles"], &segments[1]["period_cycles"]),
        (&Value::from(1), &Value::from(2))
    );
    assert!(
        (segments[1]["mean_power_w"].as_f64().unwrap() / 5e-3 - 1.0).abs() < 0.1,
        "{json}"
    );
    assert_written(
        &folder.path().join("out"),
        &["segments"],
        &["segments-time", "segments-spectra"],
    );
}

/// Keys of a hit of `contact`.
const HIT_KEYS: [&str; 15] = [
    "time_s",
    "start_s",
    "end_s",
    "peak_force_n",
    "contact_time_s",
    "impulse_n_s",
    "warnings",
    "law_contact_time_s",
    "exponent",
    "exponent_deviation",
    "restitution",
    "restitution_deviation",
    "stiffness",
    "speed_m_s",
    "allowed_laws",
];

/// The spring of `write_contact_recording`, within its interval.
fn check_linear_spring(spring: &Value) {
    assert_keys(
        spring,
        &[
            "restitution",
            "stiffness",
            "stiffness_low",
            "stiffness_high",
            "speed_m_s",
            "relative_error",
        ],
    );
    let [low, high] = ["stiffness_low", "stiffness_high"].map(|end| spring[end].as_f64().unwrap());
    let expected_stiffness = 0.1 * (PI / 1e-3).powi(2);
    assert!(
        (low..=high).contains(&spring["stiffness"].as_f64().unwrap())
            && (spring["stiffness"].as_f64().unwrap() / expected_stiffness - 1.0).abs() < 5e-3
    );
}

/// A half sine is what a hammer of mass m shows on a spring of m (pi / 1 ms)^2, coming with peak * 1 ms / (pi m).
#[test]
fn contact_gives_the_spring_that_made_the_pulses() {
    let folder = tempfile::tempdir().unwrap();
    write_contact_recording(folder.path());
    let (code, json, stderr) = jounce(
        folder.path(),
        &[
            "contact",
            "hammer.csv",
            "--mass",
            "100g",
            "--json",
            "--out",
            "out",
        ],
    );
    assert_eq!(code, 0, "{stderr}");
    assert_keys(&json, &["channel", "mass_kg", "hits", "issues"]);
    let hits = json["hits"].as_array().unwrap();
    assert_eq!(hits.len(), 2);
    for (hit, peak) in hits.iter().zip([40.0, 30.0]) {
        assert_keys(hit, &HIT_KEYS);
        let number = |key: &str| hit[key].as_f64().unwrap();
        assert!(
            (number("exponent") - 1.0).abs() < 5e-3 && (number("restitution") - 1.0).abs() < 5e-3,
            "{hit}"
        );
        assert!(
            (number("stiffness") / (0.1 * (PI / 1e-3).powi(2)) - 1.0).abs() < 0.05,
            "{hit}"
        );
        assert!(
            (number("speed_m_s") / (peak * 1e-3 / (PI * 0.1)) - 1.0).abs() < 5e-3,
            "{hit}"
        );
        check_linear_spring(&hit["linear"]);
    }
    let table = std::fs::read_to_string(folder.path().join("out/contact.csv")).unwrap();
    for column in ["stiffness_low", "linear_stiffness_high", "hertz_stiffness"] {
        assert!(table.lines().next().unwrap().contains(column), "{table}");
    }
    assert_written(
        &folder.path().join("out"),
        &["contact"],
        &["contact-pulses"],
    );
}
