//! Messages about channels without a usable unit, files without numbers, and options that do not suit
//! the record.

use super::{csv, jounce, write_switching_recording};

/// Arguments, exit code and a part of the error.
const CASES: &[(&[&str], i32, &str)] = &[
    (
        &["read", "pipe.csv"],
        4,
        "it begins with \"time [s]|piezo [V]\"",
    ),
    (
        &["read", "wrong.parquet"],
        4,
        "its name ends in .parquet, but it does not begin as such a file",
    ),
    (
        &["power", "counts.csv", "--resistance", "1kohm"],
        4,
        "channel \"piezo\" of counts holds whole numbers without a unit, up to 2000",
    ),
    (
        &["power", "odd.csv", "--resistance", "1kohm"],
        4,
        "is in furlong, an unknown unit, but a channel in V is needed",
    ),
    (
        &["power", "switch.csv", "--resistance", "-5ohm"],
        2,
        "--resistance is -5 ohm; it must be above 0",
    ),
    (
        &[
            "power",
            "switch.csv",
            "--resistance",
            "1kohm",
            "--drive",
            "1MHz",
        ],
        2,
        "--drive is 1000000 Hz; it must be below half the sampling rate",
    ),
    (
        &["segments", "switch.csv", "--drive", "1MHz"],
        2,
        "--drive is 1000000 Hz; it must be below a quarter of the sampling rate",
    ),
    (
        &["spectra", "switch.csv", "--segment", "1h"],
        2,
        "--segment is 3600 s; it must be from ",
    ),
    (
        &["spectra", "switch.csv", "--segment", "1ns"],
        2,
        "which is 8 samples, to ",
    ),
    (
        &[
            "power",
            "timed.csv",
            "--resistance",
            "1kohm",
            "--sample-rate",
            "10Hz",
        ],
        0,
        "its times, which give 100 Hz, are replaced by the given rate of 10 Hz",
    ),
    (
        &["power", "two.csv", "--resistance", "1kohm"],
        0,
        "piezo: it is the first of the 2 channels in V: piezo, other; choose another with --voltage",
    ),
];

#[test]
fn messages_name_the_cause_and_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let folder_path = folder.path();
    write_switching_recording(folder_path);
    csv(
        &folder_path.join("odd.csv"),
        "time [s],piezo [furlong]",
        (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3)]),
    );
    csv(
        &folder_path.join("timed.csv"),
        "time [s],piezo [V]",
        (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3)]),
    );
    csv(
        &folder_path.join("two.csv"),
        "time [s],piezo [V],other [V]",
        (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(k % 3), f64::from(k % 4)]),
    );
    csv(
        &folder_path.join("counts.csv"),
        "time [s],piezo",
        (0..400).map(|k| vec![f64::from(k) * 1e-2, f64::from(1000 * (k % 3))]),
    );
    std::fs::write(folder_path.join("pipe.csv"), "time [s]|piezo [V]\n0|1\n").unwrap();
    std::fs::write(folder_path.join("wrong.parquet"), "no table\n").unwrap();
    for (arguments, code, message) in CASES {
        let (exit_code, _, stderr) = jounce(folder_path, arguments);
        assert_eq!(exit_code, *code, "{arguments:?}: {stderr}");
        assert!(stderr.contains(message), "{arguments:?}: {stderr}");
    }
    let chosen = [
        "power",
        "two.csv",
        "--resistance",
        "1kohm",
        "--voltage",
        "other",
    ];
    let (_, _, stderr) = jounce(folder_path, &chosen);
    assert_eq!(stderr, "");
}
