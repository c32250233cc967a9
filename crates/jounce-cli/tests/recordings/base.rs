//! What commands on recordings say: responses to a base, warnings in words, issues once, peaks by height.

use super::{csv, jounce, jounce_in, write_switching_recording};
use std::f64::consts::TAU;
use std::path::Path;

/// A base and a voltage of 2 V per m/s^2, both in units of their own, beside a dead channel.
fn write_shaker_recording(folder: &Path) {
    let base = |k: u32| (f64::from(k) * 0.7).sin() + (f64::from(k).powi(2) * 1e-4).sin();
    let row = |k: u32| {
        vec![
            f64::from(k) / 1000.0,
            0.0,
            base(k) / 9.80665,
            2000.0 * base(k),
        ]
    };
    csv(
        &folder.join("shaken.csv"),
        "time [s],dead [V],base [g],piezo [mV]",
        (0..8_000).map(row),
    );
}

#[test]
fn a_base_is_an_input_in_its_own_unit() {
    let folder = tempfile::tempdir().unwrap();
    write_shaker_recording(folder.path());
    let measured = [
        "frf",
        "--measured",
        "shaken.csv",
        "--input",
        "base",
        "--response",
        "piezo",
    ];
    let (code, json, stderr) = jounce(folder.path(), &[&measured[..], &["--json"]].concat());
    assert_eq!(code, 0, "{stderr}");
    let piezo = &json["responses"]["piezo"];
    assert_eq!(
        (
            piezo["unit"].as_str(),
            piezo["per_g"]["unit"].as_str(),
            json["input"].as_str()
        ),
        (Some("V/(m/s^2)"), Some("V/g"), Some("base"))
    );
    assert!(
        (piezo["re"][112].as_f64().unwrap() - 2.0).abs() < 1e-9,
        "{}",
        piezo["re"][112]
    );
    let (code, text, stderr) = jounce_in(folder.path(), &measured);
    assert!(
        code == 0 && text.contains("V/(m/s^2) (1.96133e1 V/g)"),
        "{text} {stderr}"
    );
    // The dead channel is not in use: nothing is said of it. A conversion is a note.
    assert!(
        !stderr.contains("dead") && stderr.contains("note: base: values in g"),
        "{stderr}"
    );
    let (code, _, stderr) = jounce_in(folder.path(), &["frf", "--measured", "shaken.csv"]);
    assert!(code == 4 && stderr.contains("--input"), "{code} {stderr}");
    let (code, _, stderr) = jounce_in(
        folder.path(),
        &[
            "frf",
            "--measured",
            "shaken.csv",
            "--input",
            "base",
            "--force",
            "base",
        ],
    );
    assert!(code == 2, "{code} {stderr}");
    let (code, _, stderr) = jounce_in(folder.path(), &["modes", "spec.toml", "--input", "base"]);
    assert!(
        code == 2 && stderr.contains("--measured"),
        "{code} {stderr}"
    );
}

/// The same file twice: each sentence once, with the number of recordings.
#[test]
fn issues_are_printed_once() {
    let folder = tempfile::tempdir().unwrap();
    write_shaker_recording(folder.path());
    let (code, _, stderr) = jounce_in(
        folder.path(),
        &[
            "frf",
            "--measured",
            "shaken.csv",
            "shaken.csv",
            "--input",
            "base",
            "--response",
            "piezo",
        ],
    );
    assert_eq!(code, 0, "{stderr}");
    let times = |text: &str| stderr.matches(text).count();
    assert_eq!(
        (
            times("base: values in g"),
            times("piezo: values in mV"),
            times("(in 2 recordings)")
        ),
        (1, 1, 2),
        "{stderr}"
    );
    let (code, _, stderr) = jounce_in(
        folder.path(),
        &["spectra", "shaken.csv", "--channel", "piezo"],
    );
    assert!(
        code == 0 && stderr.matches("piezo: values in mV").count() == 1 && !stderr.contains("base"),
        "{stderr}"
    );
}

#[test]
fn a_warning_of_a_contact_is_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let pulse = |x: f64, start: f64, peak: f64| {
        if (start..start + 1e-3).contains(&x) {
            peak * (TAU * 500.0 * (x - start)).sin()
        } else {
            0.0
        }
    };
    let row = |k: u32| {
        let t = f64::from(k) / 50_000.0;
        vec![
            t,
            pulse(t, 0.02, 40.0) + pulse(t, 0.024, 12.0) + 1e-3 * (f64::from(k) * 1.7).sin(),
        ]
    };
    csv(
        &folder.path().join("double.csv"),
        "time [s],hammer [N]",
        (0..10_000).map(row),
    );
    let (code, text, stderr) = jounce_in(folder.path(), &["contact", "double.csv"]);
    assert!(
        code == 0 && text.contains("warning: the hit is double: 1") && !text.contains("Double {"),
        "{text} {stderr}"
    );
}

#[test]
fn spectra_take_a_live_channel_and_list_peaks_by_height() {
    let folder = tempfile::tempdir().unwrap();
    let row = |k: u32| {
        let t = f64::from(k) / 1000.0;
        vec![
            t,
            0.0,
            (TAU * 30.0 * t).sin() + 3.0 * (TAU * 90.3 * t).sin(),
        ]
    };
    csv(
        &folder.path().join("tones.csv"),
        "time [s],dead [V],piezo [V]",
        (0..32_000).map(row),
    );
    let (code, json, stderr) = jounce(
        folder.path(),
        &["spectra", "tones.csv", "--segment", "1s", "--json"],
    );
    assert_eq!(
        (code, json["channel"].as_str()),
        (0, Some("piezo")),
        "{stderr}"
    );
    let peaks: Vec<f64> = json["peaks"]
        .as_array()
        .unwrap()
        .iter()
        .map(|peak| peak["frequency_hz"].as_f64().unwrap())
        .collect();
    assert_eq!(peaks, [90.0, 30.0]);
}

/// Segments that are long enough have a power, with its uncertainty at one digit.
#[test]
fn a_segment_too_short_for_an_interval_does_not_fail_the_others() {
    let folder = tempfile::tempdir().unwrap();
    write_switching_recording(folder.path());
    let (code, text, stderr) = jounce_in(
        folder.path(),
        &[
            "segments",
            "switch.csv",
            "--drive",
            "8Hz",
            "--resistance",
            "1kohm",
        ],
    );
    assert!(code == 0 && text.contains(" +- "), "{text} {stderr}");
    // 26 cycles at 3 samples to a cycle: fewer samples than a mean with an interval needs lie in a segment.
    let row = |k: u32| {
        let t = f64::from(k) / 40.0;
        vec![
            t,
            if t < 3.3 { 1.0 } else { 4.0 } * (TAU * 8.0 * t).sin()
                + 1e-3 * (f64::from(k) * 1.7).cos(),
        ]
    };
    csv(
        &folder.path().join("short.csv"),
        "time [s],piezo [V]",
        (0..400).map(row),
    );
    let (code, json, stderr) = jounce(
        folder.path(),
        &[
            "segments",
            "short.csv",
            "--drive",
            "8Hz",
            "--resistance",
            "1kohm",
            "--json",
            "--out",
            "out",
        ],
    );
    assert_eq!(code, 0, "{stderr}");
    let segments = json["segments"].as_array().unwrap();
    assert!(
        segments.iter().all(|one| one.get("mean_power_w").is_some()),
        "{json}"
    );
    assert!(
        std::fs::read_to_string(folder.path().join("out/segments.csv"))
            .unwrap()
            .contains("mean_power_w")
    );
}

/// Columns of numbers alone: frequency, size and phase in degrees, one line of them missing.
#[test]
fn response_functions_without_a_header_are_read_and_their_gaps_bridged() {
    let folder = tempfile::tempdir().unwrap();
    let row = |k: u32| {
        let hz = 5.0 + 0.1 * f64::from(k);
        let (w, w1) = (TAU * hz, TAU * 20.0);
        let (re, im) = (w1 * w1 - w * w, 2.0 * 0.02 * w1 * w);
        let size = 1.0 / re.hypot(im);
        let phase = -im.atan2(re).to_degrees();
        if k == 40 {
            format!("{hz},nan,nan")
        } else {
            format!("{hz},{size:e},{phase}")
        }
    };
    let text: Vec<String> = (0..400).map(row).collect();
    std::fs::write(folder.path().join("bare.csv"), text.join("\n") + "\n").unwrap();
    std::fs::write(
        folder.path().join("bare.csv.channels.toml"),
        "over = \"frequency\"\ntime = \"1\"\n[channel.\"2\"]\nunit = \"m/N\"\n",
    )
    .unwrap();
    let modes = [
        "modes",
        "--measured",
        "bare.csv",
        "--functions",
        "size-degrees",
        "--between",
        "6Hz:40Hz",
        "--order",
        "8",
        "--json",
    ];
    let (code, _, stderr) = jounce(folder.path(), &modes);
    assert!(code == 4 && stderr.contains("--bridge"), "{code} {stderr}");
    let (code, json, stderr) = jounce(folder.path(), &[&modes[..], &["--bridge"]].concat());
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.contains("interpolated linearly"), "{stderr}");
    let mode = &json["modes"][0];
    let relative_errors = [
        mode["frequency_hz"].as_f64().unwrap() / 20.0 - 1.0,
        mode["damping_ratio"].as_f64().unwrap() / 0.02 - 1.0,
    ];
    eprintln!("{:.1e} {:.1e} off", relative_errors[0], relative_errors[1]);
    assert!(
        relative_errors[0].abs() < 1e-4 && relative_errors[1].abs() < 1e-2,
        "{relative_errors:?}"
    );
    let (code, _, stderr) = jounce(
        folder.path(),
        &["modes", "--measured", "bare.csv", "--json"],
    );
    assert!(
        code == 4 && stderr.contains("--functions"),
        "{code} {stderr}"
    );
}
