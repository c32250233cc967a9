//! Commands on recordings from the outside: keys of their answers, tables and pictures, and input that is wrong.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod decays;
mod fits;
mod reading;

use assert_cmd::Command;
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::path::Path;

fn jounce(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    let output = Command::cargo_bin("jounce").unwrap().args(arguments).current_dir(folder).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let json = serde_json::from_str(&text).unwrap_or(Value::Null);
    (output.status.code().unwrap(), json, String::from_utf8(output.stderr).unwrap())
}

fn has(value: &Value, keys: &[&str]) {
    keys.iter().for_each(|key| assert!(value.get(*key).is_some(), "{key} is missing in {value}"));
}

/// Every table and picture of these names.
fn written(folder: &Path, tables: &[&str], pictures: &[&str]) {
    let there = |name: &str, ending: &str| assert!(folder.join(format!("{name}.{ending}")).is_file(), "{name}.{ending} is missing");
    tables.iter().for_each(|name| ["csv", "manifest.json", "parquet", "json"].iter().for_each(|ending| there(name, ending)));
    pictures.iter().for_each(|name| ["svg", "png"].iter().for_each(|ending| there(name, ending)));
    for table in tables {
        let manifest = std::fs::read_to_string(folder.join(format!("{table}.manifest.json"))).unwrap();
        assert!(manifest.contains("recording_sha256"), "{manifest}");
    }
}

fn csv(path: &Path, head: &str, rows: impl Iterator<Item = Vec<f64>>) {
    let row = |row: Vec<f64>| row.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",");
    std::fs::write(path, format!("{head}\n{}\n", rows.map(row).collect::<Vec<_>>().join("\n"))).unwrap();
}

/// 20 s at 512 Hz under 8 Hz: 1 V peak, from the middle on 3 V with a subharmonic of 1 V; the base moves with 2 m/s^2 peak.
fn switching(folder: &Path) {
    let value = |k: u32| {
        let t = f64::from(k) / 512.0;
        let voltage = if k < 5120 { (TAU * 8.0 * t).sin() } else { 3.0 * (TAU * 8.0 * t).sin() + (TAU * 4.0 * t).cos() };
        vec![t, voltage, 2.0 * (TAU * 8.0 * t).sin()]
    };
    csv(&folder.join("switch.csv"), "time [s],piezo [V],base [m/s^2]", (0..10_240).map(value));
}

/// Two half sines of 1 ms, 40 N and 30 N, at 50 kHz: a hammer on a linear spring.
fn struck(folder: &Path) {
    let force = |k: u32| {
        let pulse = |from: u32, peak: f64| {
            let x = f64::from(k.wrapping_sub(from)) / 50.0;
            if k >= from && x < 1.0 { peak * (PI * x).sin() } else { 0.0 }
        };
        let noise = 1e-3 * (f64::from(k) * 1.7).sin();
        vec![f64::from(k) / 50_000.0, pulse(1000, 40.0) + pulse(11_000, 30.0) + noise]
    };
    csv(&folder.join("hammer.csv"), "time [s],hammer [N]", (0..20_000).map(force));
    let answered = |k: u32| {
        let [time_s, force_n] = force(k)[..] else { unreachable!("a time and a force") };
        vec![time_s, force_n, 2.0 * force_n]
    };
    csv(&folder.join("answered.csv"), "time [s],hammer [N],answer [m/s^2]", (0..20_000).map(answered));
}

/// 1 V peak for one half, 3 V and 1 V peak for the other, over 1 kohm: (0.5 + 5) / 2 mW. The base's mean square is 2.
#[test]
fn power_is_told_for_each_load() {
    let folder = tempfile::tempdir().unwrap();
    switching(folder.path());
    let loads = ["--resistance", "1kohm", "--resistance", "4kohm", "--base", "base", "--drive", "8Hz"];
    let arguments = [&["power", "switch.csv", "switch.csv", "--json", "--out", "out"], &loads[..]].concat();
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    let records = json["records"].as_array().unwrap();
    let keys = ["recording", "channel", "resistance_ohm", "power", "mean_square_base_acceleration_m2_s4", "orders", "findings"];
    has(&records[0], &keys);
    has(&records[0]["power"], &["mean_power_w", "half_width_w", "batches", "batch_correlation", "correlated", "mean_voltage_v"]);
    has(&records[0]["orders"][0], &["order", "frequency_hz", "amplitude_peak_v"]);
    for (record, expected) in records.iter().zip([2.75e-3, 2.75e-3 / 4.0]) {
        let power = record["power"]["mean_power_w"].as_f64().unwrap();
        let per = record["mean_power_per_mean_square_base_acceleration"].as_f64().unwrap();
        assert!((power / expected - 1.0).abs() < 1e-9 && (per / expected * 2.0 - 1.0).abs() < 1e-9, "{power} {per}");
    }
    // Half of the record has another power: that the interval is too narrow must be said.
    assert_eq!(records[0]["power"]["correlated"], true);
    written(&folder.path().join("out"), &["power"], &["power-load", "power-spectrum"]);
}

#[test]
fn regimes_find_the_switch_and_its_subharmonic() {
    let folder = tempfile::tempdir().unwrap();
    switching(folder.path());
    let arguments = ["regimes", "switch.csv", "--drive", "8Hz", "--resistance", "1kohm", "--json", "--out", "out"];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    has(&json, &["channel", "regimes", "powers", "findings"]);
    has(&json["regimes"], &["stretches", "uncertainty_s"]);
    let stretches = json["regimes"]["stretches"].as_array().unwrap();
    assert_eq!(stretches.len(), 2, "{json}");
    has(&stretches[0], &["start_s", "end_s", "start", "end", "rms", "period"]);
    assert!((stretches[1]["start_s"].as_f64().unwrap() - 10.0).abs() < 0.75);
    assert_eq!((&stretches[0]["period"]["cycles"], &stretches[1]["period"]["cycles"]), (&Value::from(1), &Value::from(2)));
    assert!((json["powers"][1]["mean_power_w"].as_f64().unwrap() / 5e-3 - 1.0).abs() < 0.1, "{json}");
    written(&folder.path().join("out"), &["regimes"], &["regimes-time", "regimes-spectra"]);
}

/// A half sine is what a hammer of mass m shows on a spring of m (pi / 1 ms)^2, coming with peak * 1 ms / (pi m).
#[test]
fn contact_gives_the_spring_that_made_the_pulses() {
    let folder = tempfile::tempdir().unwrap();
    struck(folder.path());
    let (code, json, stderr) = jounce(folder.path(), &["contact", "hammer.csv", "--mass", "100g", "--json", "--out", "out"]);
    assert_eq!(code, 0, "{stderr}");
    has(&json, &["channel", "hits", "findings"]);
    let hits = json["hits"].as_array().unwrap();
    assert_eq!(hits.len(), 2);
    has(&hits[0]["hit"], &["start", "peak", "end", "peak_force_n", "contact_time_s", "impulse_n_s", "warnings"]);
    let keys =
        ["contact_time_s", "exponent", "exponent_deviation", "restitution", "restitution_deviation", "stiffness", "speed_m_s", "told"];
    for (hit, peak) in hits.iter().zip([40.0, 30.0]) {
        let law = &hit["law"];
        has(law, &keys);
        let number = |key: &str| law[key].as_f64().unwrap();
        assert!((number("exponent") - 1.0).abs() < 5e-3 && (number("restitution") - 1.0).abs() < 5e-3, "{law}");
        assert!((number("stiffness") / (0.1 * (PI / 1e-3).powi(2)) - 1.0).abs() < 0.05, "{law}");
        assert!((number("speed_m_s") / (peak * 1e-3 / (PI * 0.1)) - 1.0).abs() < 5e-3, "{law}");
        let spring = &law["linear"];
        has(spring, &["exponent", "restitution", "stiffness", "stiffness_95", "speed_m_s", "relative_error"]);
        let [low, high] = [0, 1].map(|end| spring["stiffness_95"][end].as_f64().unwrap());
        let truth = 0.1 * (PI / 1e-3).powi(2);
        assert!(
            (low..=high).contains(&spring["stiffness"].as_f64().unwrap())
                && (spring["stiffness"].as_f64().unwrap() / truth - 1.0).abs() < 5e-3
        );
    }
    let table = std::fs::read_to_string(folder.path().join("out/contact.csv")).unwrap();
    for column in ["stiffness_low", "linear_stiffness_high", "hertz_stiffness"] {
        assert!(table.lines().next().unwrap().contains(column), "{table}");
    }
    written(&folder.path().join("out"), &["contact"], &["contact-pulses"]);
}

/// Three hits of 4 s each at 500 Hz on a structure of two modes, 20 Hz with 2 % and 57 Hz with 1 % damping, seen at two places. The
/// recursion has the poles of the structure exactly.
fn hammer_test(folder: &Path, name: &str, change: impl Fn(usize, f64) -> f64) {
    const RATE: f64 = 500.0;
    let pulse = |k: usize| if k % 2000 >= 40 && k % 2000 < 44 { 50.0 * (PI * ((k % 2000 - 40) as f64 + 0.5) / 4.0).sin() } else { 0.0 };
    let force: Vec<f64> = (0..6000).map(|k| change(k, pulse(k))).collect();
    let mode = |frequency_hz: f64, damping_ratio: f64| {
        let w = TAU * frequency_hz;
        let (size, turn) = ((-damping_ratio * w / RATE).exp(), w * (1.0 - damping_ratio * damping_ratio).sqrt() / RATE);
        let (mut one, mut two, mut before) = (0.0, 0.0, 0.0);
        let step = |f: &f64| {
            let now = 2.0 * size * turn.cos() * one - size * size * two + size * turn.sin() / (w * RATE) * before;
            (two, one, before) = (one, now, *f);
            now
        };
        force.iter().map(step).collect::<Vec<f64>>()
    };
    let (first, second) = (mode(20.0, 0.02), mode(57.0, 0.01));
    let row = |k: usize| vec![k as f64 / RATE, force[k], first[k] + second[k], 0.6 * first[k] - 0.8 * second[k]];
    csv(&folder.join(name), "time [s],hammer [N],tip [m],middle [m]", (0..6000).map(row));
}

/// Measured: frequencies within 5.4e-6, damping ratios within 1.7e-4 relative.
#[test]
fn frf_and_modes_of_a_hammer_test_are_those_of_the_structure() {
    let folder = tempfile::tempdir().unwrap();
    hammer_test(folder.path(), "hits.csv", |_, force| force);
    let (code, json, stderr) = jounce(folder.path(), &["frf", "--measured", "hits.csv", "--force-window", "--json", "--out", "frf"]);
    assert_eq!(code, 0, "{stderr}");
    has(&json, &["frequency_hz", "responses", "hits", "block_s", "window_decay_per_s", "findings"]);
    has(&json["responses"]["tip"], &["re", "im", "unit", "coherence"]);
    assert_eq!((json["hits"].as_array().unwrap().len(), &json["responses"]["tip"]["unit"]), (3, &Value::from("m/N")));
    written(&folder.path().join("frf"), &["frf"], &["frf"]);
    let arguments = ["modes", "--measured", "hits.csv", "--between", "5Hz:120Hz", "--order", "20", "--json", "--out", "modes"];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    has(&json, &["modes", "responses", "mac", "misfit", "stabilisation", "hits", "block_s", "window_decay_per_s", "findings"]);
    let modes = json["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 2, "{json}");
    for (mode, (frequency_hz, damping_ratio, ratio)) in modes.iter().zip([(20.0, 0.02, 0.6), (57.0, 0.01, -0.8)]) {
        has(mode, &["frequency_hz", "frequency_deviation_hz", "damping_ratio", "damping_deviation", "shape"]);
        let number = |key: &str| mode[key].as_f64().unwrap();
        eprintln!("{:.1e} {:.1e} off", number("frequency_hz") / frequency_hz - 1.0, number("damping_ratio") / damping_ratio - 1.0);
        assert!((number("frequency_hz") / frequency_hz - 1.0).abs() < 1e-4, "{mode}");
        assert!((number("damping_ratio") / damping_ratio - 1.0).abs() < 5e-3, "{mode}");
        assert!((mode["shape"]["re"][1].as_f64().unwrap() - ratio).abs() < 1e-3, "{mode}");
    }
    // |1 - 0.48|^2 / ((1 + 0.36) (1 + 0.64))
    assert!((json["mac"][0][1].as_f64().unwrap() - 0.121_234).abs() < 1e-3 && (json["mac"][1][1].as_f64().unwrap() - 1.0).abs() < 1e-12);
    written(&folder.path().join("modes"), &["modes", "modes-stabilisation"], &["modes-stabilisation", "modes-fit"]);
}

#[test]
fn bad_hits_are_told() {
    let folder = tempfile::tempdir().unwrap();
    hammer_test(folder.path(), "double.csv", |k, force| if k == 2050 { 20.0 } else { force });
    let (code, json, _) = jounce(folder.path(), &["frf", "--measured", "double.csv", "--json"]);
    let warnings = |hit: usize| json["hits"][hit]["warnings"].to_string();
    assert!(code == 0 && warnings(1).contains("double") && warnings(0) == "[]", "{}", json["hits"]);
    hammer_test(folder.path(), "clipped.csv", |_, force| force.min(15.0));
    let (code, json, _) = jounce(folder.path(), &["frf", "--measured", "clipped.csv", "--json"]);
    assert!(code == 0 && json["hits"][0]["warnings"].to_string().contains("clipped"), "{}", json["hits"]);
}

#[test]
fn wrong_input_ends_with_its_code_and_one_clear_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    switching(here);
    struck(here);
    std::fs::write(here.join("cut.npy"), &b"\x93NUMPY\x01\x00v\x00{'descr': '<f8'"[..]).unwrap();
    let whole: String = (0..20).map(|k| format!("{k},{}\n", k % 3)).collect();
    std::fs::write(here.join("ragged.csv"), format!("time [s],piezo [V]\n{whole}20\n21,3,4\n")).unwrap();
    std::fs::write(here.join("timeless.csv"), "piezo [V],other\n5,1\n3,2\n4,3\n").unwrap();
    csv(&here.join("still.csv"), "time [s],piezo [V],force [N]", (0..4000).map(|k| vec![f64::from(k) * 1e-2, 3.0, 0.0]));
    csv(&here.join("dead.csv"), "time [s],piezo [V],base [g]", (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3), 0.0]));
    csv(&here.join("odd.csv"), "time [s],piezo [furlong]", (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3)]));
    csv(&here.join("short.csv"), "time [s],piezo [V]", (0..12).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3)]));
    for (arguments, code, words) in [
        (vec!["read", "missing.csv"], 4, "missing.csv"),
        (vec!["read", "."], 4, "no file"),
        (vec!["read", "cut.npy"], 4, "NPY"),
        (vec!["read", "timeless.csv"], 4, "no column ascends"),
        (vec!["read", "switch.csv", "--to", "a.xlsx"], 4, ".parquet"),
        (vec!["read", "switch.csv", "--out", "/proc/nowhere"], 4, "/proc/nowhere"),
        (vec!["power", "switch.csv"], 2, "--resistance"),
        (vec!["power", "switch.csv", "--resistance", "3 mm"], 2, "--resistance"),
        (vec!["power", "switch.csv", "--resistance", "0ohm"], 2, "above 0"),
        (vec!["power", "switch.csv", "--resistance", "1ohm", "--resistance", "2ohm"], 2, "one for each"),
        (vec!["power", "switch.csv", "--resistance", "1kohm", "--voltage", "pieso"], 4, "piezo"),
        (vec!["power", "switch.csv", "--resistance", "1kohm", "--voltage", "base"], 4, "m/s^2"),
        (vec!["power", "switch.csv", "--resistance", "1kohm", "--base", "piezo"], 4, "is in V"),
        (vec!["power", "short.csv", "--resistance", "1kohm"], 4, "too few"),
        (vec!["power", "still.csv", "--resistance", "1kohm"], 4, "no signal"),
        (vec!["power", "dead.csv", "--resistance", "1kohm", "--base", "base"], 4, "samples of base are 0"),
        (vec!["power", "odd.csv", "--resistance", "1kohm", "--voltage", "piezo"], 4, "is in furlong"),
        (vec!["spectra", "still.csv"], 4, "all 4000 samples of piezo are 3"),
        (vec!["modes", "--measured", "still.csv", "--free-decay"], 4, "no signal"),
        (vec!["regimes", "switch.csv"], 2, "--drive"),
        (vec!["regimes", "switch.csv", "--drive", "400Hz"], 4, "quarter"),
        (vec!["regimes", "switch.csv", "--drive", "0.1Hz"], 4, "drive cycles"),
        (vec!["regimes", "still.csv", "--drive", "5Hz"], 4, "no signal"),
        (vec!["contact", "still.csv"], 4, "no hit"),
        (vec!["contact", "switch.csv"], 2, "--force"),
        (vec!["contact", "hammer.csv", "--mass", "0kg"], 2, "--mass"),
        (vec!["frf"], 2, "SPEC"),
        (vec!["modes"], 2, "SPEC"),
        (vec!["frf", "--measured", "hammer.csv"], 4, "no channel beside"),
        (vec!["frf", "--measured", "switch.csv"], 4, "newtons"),
        (vec!["frf", "--measured", "switch.csv", "--force", "base"], 4, "not in newtons"),
        (vec!["frf", "--measured", "hammer.csv", "--response", "hamer"], 4, "hammer"),
        (vec!["frf", "--measured", "hammer.csv", "--response", "hammer"], 4, "cannot respond to itself"),
        (vec!["frf", "--measured", "answered.csv", "--block", "3s"], 4, "segments"),
        (vec!["frf", "--measured", "hammer.csv", "--end-ratio", "2"], 2, "--end-ratio"),
        (vec!["modes", "--measured", "answered.csv", "--between", "9Hz:3Hz"], 2, "--between"),
        (vec!["modes", "--measured", "answered.csv", "--between", "1Hz:20Hz"], 4, "widen the band"),
    ] {
        let (found, _, stderr) = jounce(here, &arguments);
        assert_eq!(found, code, "{arguments:?}: {stderr}");
        assert!(stderr.contains(words) && !stderr.contains("panicked"), "{arguments:?}: {stderr}");
    }
    let (code, json, _) = jounce(here, &["read", "ragged.csv", "--json"]);
    let kinds: Vec<&str> = json["recordings"][0]["findings"].as_array().unwrap().iter().filter_map(|f| f["kind"].as_str()).collect();
    assert!(code == 0 && kinds.contains(&"ragged") && kinds.contains(&"not-a-number"), "{json}");
    let (code, json, _) = jounce(here, &["power", "timeless.csv", "--resistance", "1ohm", "--json"]);
    assert!(code == 4 && json["error"].is_string() && json["exit_code"] == 4, "{json}");
}

/// A mode shape is no recording: `--to` refuses it instead of writing nothing. Of two recordings the one left out is told.
#[test]
fn what_is_not_written_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let function = |points: u32| {
        let line = |text: &str| format!("{text:<80}\n");
        let mut set = line("    -1") + &line("    58") + &"NONE\n".repeat(5);
        set += "    1         0    0         0 NONE               1   3 NONE               0   0\n";
        set += &format!("         4{points:>10}         1  0.00000e+00  1.00000e-03  0.00000e+00\n");
        set += "        17    0    0    0 Time                 s\n        12    0    0    0 a                    m/s^2\n";
        set += &"         0    0    0    0 NONE                 NONE\n".repeat(2);
        set += &(0..points).map(|k| format!("{:>20.11e}\n", f64::from(k).sin())).collect::<String>();
        set + &line("    -1")
    };
    std::fs::write(here.join("two.uff"), function(20) + &function(30)).unwrap();
    let (code, _, told) = jounce(here, &["read", "two.uff", "--to", "one.csv"]);
    assert!(code == 0 && here.join("one.csv").is_file() && told.contains("left out"), "{code} {told}");
    for command in
        [vec!["power", "two.uff", "--resistance", "1ohm"], vec!["spectra", "two.uff"], vec!["regimes", "two.uff", "--drive", "1Hz"]]
    {
        let (_, _, told) = jounce(here, &command);
        assert!(told.contains("is taken") && told.contains("left out: two 2"), "{command:?}: {told}");
    }
}

/// A random force of both signs is a shaker's, without being told so: 15 blocks, and the response 2 of a scale.
#[test]
fn a_force_that_goes_on_is_a_shaker() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let force = |k: u32| (f64::from(k) * 0.7).sin() + (f64::from(k).powi(2) * 1e-4).sin();
    csv(
        &here.join("shaken.csv"),
        "time [s],force [N],a [m/s^2]",
        (0..8_000).map(|k| vec![f64::from(k) / 1000.0, force(k), 2.0 * force(k)]),
    );
    let (code, json, told) = jounce(here, &["frf", "--measured", "shaken.csv", "--json"]);
    assert_eq!(code, 0, "{told}");
    assert_eq!((json["block_s"].as_f64(), json["hits"].as_array().map(Vec::len)), (Some(1.0), Some(0)));
    assert!((json["responses"]["a"]["re"][112].as_f64().unwrap() - 2.0).abs() < 1e-9, "{}", json["responses"]["a"]["re"][112]);
    let (code, _, told) = jounce(here, &["frf", "--measured", "shaken.csv", "--end-ratio", "0.01"]);
    assert!(code != 0 && told.contains("goes on"), "{told}");
}

/// Hits at two places and two sensors, one file for each place, as CSV whose notes keep the places: one matrix of responses, and modes whose
/// participation at the places is, by reciprocity, their shape at the sensors there.
#[test]
fn hits_at_two_places_give_a_matrix_and_modes_of_both() {
    let folder = tempfile::tempdir().unwrap();
    let spec = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/impact-harvester-2019/harvester.toml");
    for (point, to) in [("beam.hammer", "one.csv"), ("beam.tip", "two.csv")] {
        let test = ["--hammer", point, "--at", "beam.tip", "--at", "beam.hammer", "--fixed-table", "--hits", "1", "--block", "8s"];
        let more = ["--rate", "1024Hz", "--contact", "4ms", "--set", "circuit.load.resistance=1Mohm", "--noise", "0.0001", "--to", to];
        let (code, _, stderr) = jounce(folder.path(), &[&["rig", spec], &test[..], &more].concat());
        assert_eq!(code, 0, "{stderr}");
    }
    let measured = ["--measured", "one.csv", "two.csv", "--end-ratio", "0.01", "--json", "--out", "out"];
    let (code, json, stderr) = jounce(folder.path(), &[&["frf"], &measured[..]].concat());
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(json["references"], serde_json::json!(["beam.hammer", "beam.tip"]));
    assert_eq!((json["responses"].as_object().unwrap().len(), json["outputs"].as_array().unwrap().len()), (4, 2));
    // Reciprocity: the tip under a hit at the other point answers as that point under a hit at the tip.
    let of = |name: &str| (json["responses"][name]["re"].as_array().unwrap().clone(), json["responses"][name]["reference"].clone());
    let (there, from) = of("beam.tip.acceleration from beam.hammer");
    let (back, _) = of("beam.hammer.acceleration from beam.tip");
    assert_eq!(from, "beam.hammer");
    let number = |value: &Value| value.as_f64().unwrap();
    let largest = there.iter().map(|x| number(x).abs()).fold(0.0, f64::max);
    let off = there[1..800].iter().zip(&back[1..800]).map(|(a, b)| (number(a) - number(b)).abs() / largest).fold(0.0, f64::max);
    eprintln!("off by {off:.1e} of the largest");
    assert!(off < 0.02, "{off}");
    let (code, json, stderr) = jounce(folder.path(), &[&["modes"], &measured[..], &["--between", "20Hz:200Hz", "--order", "14"]].concat());
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(json["references"], serde_json::json!(["beam.hammer", "beam.tip"]));
    for mode in json["modes"].as_array().unwrap() {
        let (shape, moved) = (&mode["shape"]["re"], &mode["participation"]["re"]);
        eprintln!("{} Hz: {shape} {moved}", mode["frequency_hz"]);
        // Sensors stand at tip and hammer, hits at hammer and tip.
        let off = (number(&shape[0]) * number(&moved[0]) - number(&shape[1]) * number(&moved[1])).abs();
        assert!(off < 0.02, "{mode}");
    }
    let head = std::fs::read_to_string(folder.path().join("out/modes.csv")).unwrap();
    assert!(head.lines().next().unwrap().contains("beam.hammer.participation.re"), "{head}");
}
