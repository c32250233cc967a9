//! Input that is wrong, and what a command leaves out.

use super::{csv, jounce, write_contact_recording, write_switching_recording};
use std::path::Path;

/// Recordings that a command or another refuses.
fn write_invalid_files(folder_path: &Path) {
    write_switching_recording(folder_path);
    write_contact_recording(folder_path);
    std::fs::write(
        folder_path.join("cut.npy"),
        &b"\x93NUMPY\x01\x00v\x00{'descr': '<f8'"[..],
    )
    .unwrap();
    let rows: String = (0..20).map(|k| format!("{k},{}\n", k % 3)).collect();
    std::fs::write(
        folder_path.join("ragged.csv"),
        format!("time [s],piezo [V]\n{rows}20\n21,3,4\n"),
    )
    .unwrap();
    std::fs::write(
        folder_path.join("timeless.csv"),
        "piezo [V],other\n5,1\n3,2\n4,3\n",
    )
    .unwrap();
    csv(
        &folder_path.join("still.csv"),
        "time [s],piezo [V],force [N]",
        (0..4000).map(|k| vec![f64::from(k) * 1e-2, 3.0, 0.0]),
    );
    csv(
        &folder_path.join("dead.csv"),
        "time [s],piezo [V],base [g]",
        (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3), 0.0]),
    );
    csv(
        &folder_path.join("odd.csv"),
        "time [s],piezo [furlong]",
        (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3)]),
    );
    csv(
        &folder_path.join("short.csv"),
        "time [s],piezo [V]",
        (0..12).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3)]),
    );
}

/// Arguments, exit code and a part of the error.
const CASES: &[(&[&str], i32, &str)] = &[
    (&["read", "missing.csv"], 4, "missing.csv"),
    (&["read", "."], 4, "not a file"),
    (&["read", "cut.npy"], 4, "NPY"),
    (&["read", "timeless.csv"], 4, "no sampling times found"),
    (&["read", "switch.csv", "--to", "a.xlsx"], 4, ".parquet"),
    (
        &["read", "switch.csv", "--to", "./switch.csv"],
        2,
        "it is the file that is read",
    ),
    (
        &["read", "switch.csv", "--out", "/proc/nowhere"],
        4,
        "/proc/nowhere",
    ),
    (&["power", "switch.csv"], 2, "--resistance"),
    (
        &["power", "switch.csv", "--resistance", "3 mm"],
        2,
        "--resistance",
    ),
    (
        &["power", "switch.csv", "--resistance", "0ohm"],
        2,
        "above 0",
    ),
    (
        &[
            "power",
            "switch.csv",
            "--resistance",
            "1ohm",
            "--resistance",
            "2ohm",
        ],
        2,
        "one for each",
    ),
    (
        &[
            "power",
            "switch.csv",
            "--resistance",
            "1kohm",
            "--voltage",
            "pieso",
        ],
        4,
        "piezo",
    ),
    (
        &[
            "power",
            "switch.csv",
            "--resistance",
            "1kohm",
            "--voltage",
            "base",
        ],
        4,
        "m/s^2",
    ),
    (
        &[
            "power",
            "switch.csv",
            "--resistance",
            "1kohm",
            "--base",
            "piezo",
        ],
        4,
        "is in V",
    ),
    (
        &["power", "short.csv", "--resistance", "1kohm"],
        4,
        "too few",
    ),
    (
        &["power", "still.csv", "--resistance", "1kohm"],
        4,
        "no signal",
    ),
    (
        &[
            "power",
            "dead.csv",
            "--resistance",
            "1kohm",
            "--base",
            "base",
        ],
        4,
        "samples of base are 0",
    ),
    (
        &[
            "power",
            "odd.csv",
            "--resistance",
            "1kohm",
            "--voltage",
            "piezo",
        ],
        4,
        "is in furlong",
    ),
    (
        &["spectra", "still.csv"],
        4,
        "all 4000 samples of piezo are 3",
    ),
    (
        &["spectra", "switch.csv", "--drive", "1MHz"],
        2,
        "--drive is 1000000 Hz; it must be below half the sampling rate",
    ),
    (
        &["modes", "--measured", "still.csv", "--set", "a.b=1"],
        2,
        "--set does not apply to recordings",
    ),
    (
        &["modes", "--measured", "still.csv", "--free-decay"],
        4,
        "no signal",
    ),
    (&["segments", "switch.csv"], 2, "--drive"),
    (
        &["segments", "switch.csv", "--drive", "400Hz"],
        2,
        "quarter",
    ),
    (
        &["segments", "switch.csv", "--drive", "0.1Hz"],
        4,
        "drive cycles",
    ),
    (&["segments", "still.csv", "--drive", "5Hz"], 4, "no signal"),
    (&["contact", "still.csv"], 4, "no hit"),
    (&["contact", "switch.csv"], 2, "--force"),
    (&["contact", "hammer.csv", "--mass", "0kg"], 2, "--mass"),
    (&["frf"], 2, "SPEC"),
    (&["modes"], 2, "SPEC"),
    (
        &["frf", "--measured", "hammer.csv"],
        4,
        "no channel other than",
    ),
    (&["frf", "--measured", "switch.csv"], 4, "newtons"),
    (
        &["frf", "--measured", "switch.csv", "--force", "base"],
        4,
        "not in newtons",
    ),
    (
        &["frf", "--measured", "hammer.csv", "--response", "hamer"],
        4,
        "hammer",
    ),
    (
        &["frf", "--measured", "hammer.csv", "--response", "hammer"],
        4,
        "cannot respond to itself",
    ),
    (
        &["frf", "--measured", "motion.csv", "--block", "3s"],
        4,
        "segments",
    ),
    (
        &["frf", "--measured", "hammer.csv", "--end-ratio", "2"],
        2,
        "--end-ratio",
    ),
    (
        &["modes", "--measured", "motion.csv", "--between", "9Hz:3Hz"],
        2,
        "--between",
    ),
    (
        &["modes", "--measured", "motion.csv", "--between", "1Hz:20Hz"],
        4,
        "widen the band",
    ),
];

#[test]
fn wrong_input_ends_with_its_code_and_one_clear_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let folder_path = folder.path();
    write_invalid_files(folder_path);
    for (arguments, code, message) in CASES {
        let (exit_code, _, stderr) = jounce(folder_path, arguments);
        assert_eq!(exit_code, *code, "{arguments:?}: {stderr}");
        assert!(
            stderr.contains(message) && !stderr.contains("panicked"),
            "{arguments:?}: {stderr}"
        );
    }
    let (code, json, _) = jounce(folder_path, &["read", "ragged.csv", "--json"]);
    let kinds: Vec<&str> = json["recordings"][0]["issues"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|f| f["kind"].as_str())
        .collect();
    assert!(
        code == 0 && kinds.contains(&"ragged") && kinds.contains(&"not-a-number"),
        "{json}"
    );
    let (code, json, _) = jounce(
        folder_path,
        &["power", "timeless.csv", "--resistance", "1ohm", "--json"],
    );
    assert!(
        code == 4 && json["error"].is_string() && json["exit_code"] == 4,
        "{json}"
    );
}

/// A mode shape is no recording: `--to` refuses it instead of writing nothing. An omitted second recording is reported.
#[test]
fn recordings_that_are_not_written_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let folder_path = folder.path();
    let function = |points: u32| {
        let line = |text: &str| format!("{text:<80}\n");
        let mut set = line("    -1") + &line("    58") + &"NONE\n".repeat(5);
        set += "    1         0    0         0 NONE               1   3 NONE               0   0\n";
        set +=
            &format!("         4{points:>10}         1  0.00000e+00  1.00000e-03  0.00000e+00\n");
        set += "        17    0    0    0 Time                 s\n        12    0    0    0 a                    m/s^2\n";
        set += &"         0    0    0    0 NONE                 NONE\n".repeat(2);
        set += &(0..points)
            .map(|k| format!("{:>20.11e}\n", f64::from(k).sin()))
            .collect::<String>();
        set + &line("    -1")
    };
    std::fs::write(folder_path.join("two.uff"), function(20) + &function(30)).unwrap();
    let (code, _, stderr) = jounce(folder_path, &["read", "two.uff", "--to", "one.csv"]);
    assert!(
        code == 0 && folder_path.join("one.csv").is_file() && stderr.contains("left out"),
        "{code} {stderr}"
    );
    for command in [
        vec!["power", "two.uff", "--resistance", "1ohm"],
        vec!["spectra", "two.uff"],
        vec!["segments", "two.uff", "--drive", "1Hz"],
    ] {
        let (_, _, stderr) = jounce(folder_path, &command);
        assert!(
            stderr.contains("is used") && stderr.contains("left out: two 2"),
            "{command:?}: {stderr}"
        );
    }
}
