//! `jounce read`: its printed summary and its files.

use super::{assert_keys, assert_written, jounce, write_switching_recording};
use serde_json::Value;

#[test]
fn read_prints_and_writes_channels_and_issues() {
    let folder = tempfile::tempdir().unwrap();
    write_switching_recording(folder.path());
    let (code, json, _) = jounce(
        folder.path(),
        &[
            "read",
            "switch.csv",
            "--json",
            "--out",
            "out",
            "--to",
            "again.uff",
        ],
    );
    assert_eq!(code, 0);
    assert_keys(
        &json,
        &["recordings", "shape_frequencies_hz", "shapes", "issues"],
    );
    let recording = &json["recordings"][0];
    assert_keys(
        recording,
        &["name", "over", "samples", "rate", "channels", "issues"],
    );
    assert_eq!(
        (&recording["samples"], &recording["channels"][0]["unit"]),
        (&Value::from(10_240), &Value::from("V"))
    );
    assert_keys(
        &recording["channels"][0],
        &[
            "name",
            "quantity",
            "unit",
            "place",
            "direction",
            "complex",
            "rms",
            "peak",
            "mean",
        ],
    );
    assert_written(
        &folder.path().join("out"),
        &["read", "read-issues"],
        &["read-1"],
    );
    let (_, copy_json, _) = jounce(folder.path(), &["read", "again.uff", "--json"]);
    assert_eq!(
        copy_json["recordings"][0]["channels"][1]["quantity"],
        "acceleration"
    );
}

/// The louder half alone: 3 V and 1 V peak over 1 kohm are 5 mW. What lies outside of the record is refused with its ends.
#[test]
fn a_part_of_a_recording_is_written_for_other_commands() {
    let folder = tempfile::tempdir().unwrap();
    write_switching_recording(folder.path());
    for name in ["part.csv", "part.parquet", "part.uff"] {
        let (code, _, stderr) = jounce(
            folder.path(),
            &["read", "switch.csv", "--to", name, "--span", "12s:18s"],
        );
        assert!(
            code == 0 && stderr.contains("3073 of 10240 samples"),
            "{stderr}"
        );
        let (_, json, _) = jounce(
            folder.path(),
            &["power", name, "--resistance", "1kohm", "--json"],
        );
        let power_w = json["records"][0]["mean_power_w"].as_f64().unwrap();
        assert!((power_w / 5e-3 - 1.0).abs() < 1e-3, "{name}: {power_w}");
    }
    for (span, message) in [
        ("30s:40s", "extends from 0 s to 19.998"),
        ("8s:2s", "the smaller one first"),
        ("1Hz:2Hz", "Hz"),
    ] {
        let (code, _, stderr) = jounce(
            folder.path(),
            &["read", "switch.csv", "--to", "none.csv", "--span", span],
        );
        assert!(
            code == 2 && stderr.contains(message) && !folder.path().join("none.csv").exists(),
            "{span}: {code} {stderr}"
        );
    }
}
