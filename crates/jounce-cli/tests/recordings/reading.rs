//! `jounce read`: what is told of a recording, and what is written of it.

use super::{has, jounce, switching, written};
use serde_json::Value;

#[test]
fn read_tells_channels_and_findings_and_writes_them() {
    let folder = tempfile::tempdir().unwrap();
    switching(folder.path());
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
    has(
        &json,
        &["recordings", "shape_frequencies_hz", "shapes", "findings"],
    );
    let recording = &json["recordings"][0];
    has(
        recording,
        &["name", "over", "samples", "rate", "channels", "findings"],
    );
    assert_eq!(
        (&recording["samples"], &recording["channels"][0]["unit"]),
        (&Value::from(10_240), &Value::from("V"))
    );
    has(
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
    written(
        &folder.path().join("out"),
        &["read", "read-findings"],
        &["read-1"],
    );
    let (_, again, _) = jounce(folder.path(), &["read", "again.uff", "--json"]);
    assert_eq!(
        again["recordings"][0]["channels"][1]["quantity"],
        "acceleration"
    );
}

/// The louder half alone: 3 V and 1 V peak over 1 kohm are 5 mW. What lies outside of the record is refused with its ends.
#[test]
fn a_part_of_a_recording_is_written_for_other_commands() {
    let folder = tempfile::tempdir().unwrap();
    switching(folder.path());
    for name in ["part.csv", "part.parquet", "part.uff"] {
        let (code, _, told) = jounce(
            folder.path(),
            &["read", "switch.csv", "--to", name, "--span", "12s:18s"],
        );
        assert!(
            code == 0 && told.contains("3073 of 10240 samples"),
            "{told}"
        );
        let (_, json, _) = jounce(
            folder.path(),
            &["power", name, "--resistance", "1kohm", "--json"],
        );
        let power_w = json["records"][0]["power"]["mean_power_w"]
            .as_f64()
            .unwrap();
        assert!((power_w / 5e-3 - 1.0).abs() < 1e-3, "{name}: {power_w}");
    }
    for (span, why) in [
        ("30s:40s", "extends from 0 s to 19.998"),
        ("8s:2s", "the smaller one first"),
        ("1Hz:2Hz", "Hz"),
    ] {
        let (code, _, told) = jounce(
            folder.path(),
            &["read", "switch.csv", "--to", "none.csv", "--span", span],
        );
        assert!(
            code == 2 && told.contains(why) && !folder.path().join("none.csv").exists(),
            "{span}: {code} {told}"
        );
    }
}
