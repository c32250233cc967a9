//! Recordings as drives: read by the same rules as any recording.

use super::drives::BODY;
use jounce_spec::{DriveSignal, Recording, Spec, SpecFile};
use std::path::Path;
use std::sync::Arc;

/// One g, m/s^2.
const G: f64 = 9.80665;

/// Spec with a base driven by `FILE` and the given keys.
fn spec(folder: &Path, (name, text): (&str, &str), keys: &str) -> Result<Spec, String> {
    std::fs::write(folder.join(name), text).unwrap();
    let drive = format!(
        "[drive.road]\nkind = \"base-acceleration\"\nsignal = \"recording\"\nfile = \"{name}\"\n{keys}"
    );
    SpecFile::from_text(format!("{BODY}{drive}"))
        .in_folder(folder)
        .spec()
        .map_err(|faults| faults.to_string())
}

fn record(spec: &Spec) -> Arc<Recording> {
    let DriveSignal::Recording {
        record: Some(record),
        ..
    } = &spec.drive["road"].signal
    else {
        panic!("no record")
    };
    record.clone()
}

fn issues(spec: &Spec) -> Vec<String> {
    spec.issues()
        .map(|(drive, issue)| format!("{drive}: {issue}"))
        .collect()
}

/// A recording of 5 s in a run of 2 s is cut, one of a run as long as itself is not.
#[test]
fn a_recording_that_goes_on_after_the_run_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let rows = (0..=50).map(|k| format!("{},{}\n", f64::from(k) / 10.0, k % 2));
    let text = format!("t (s),a (m/s^2)\n{}", rows.collect::<String>());
    std::fs::write(folder.path().join("road.csv"), text).unwrap();
    let cut = |duration: &str| {
        let run = format!("[run]\nduration = \"{duration}\"\naverage_over = \"1 s\"\n");
        let drive = "[drive.road]\nkind = \"base-acceleration\"\nsignal = \"recording\"\nfile = \"road.csv\"\n";
        let spec = SpecFile::from_text(format!("{BODY}{drive}{run}"));
        let spec = spec.in_folder(folder.path()).spec().unwrap();
        let cut = spec.cut_recordings();
        cut.map(|(name, ends_s)| (name.to_owned(), ends_s.round()))
            .collect::<Vec<_>>()
    };
    assert_eq!(cut("2 s"), [("road".to_owned(), 5.0)]);
    assert_eq!(cut("5 s"), []);
}

/// Keys of the drive, and a part of the fault.
const FAULTS: [(&str, &str); 7] = [
    (
        "channel = \"roof\"\n",
        "there is no channel \"roof\" in road; give a name, dead, out, floor, or a number from 1 to 3",
    ),
    (
        "channel = \"out\"\n",
        "channel out is in V, which does not convert to m/s^2",
    ),
    (
        "channel = \"dead\"\n",
        "channel dead is constant at 0 m/s^2 and excites nothing",
    ),
    (
        "unit = \"m/s^2\"\n",
        "the file gives channel floor a unit already (in SI m/s^2); omit `unit`",
    ),
    (
        "channel = \"out\"\nunit = \"mm\"\n",
        "drive.road.unit: `unit` = \"mm\" does not convert to m/s^2",
    ),
    (
        "sample_rate = \"100 Hz\"\n",
        "is sampled at 2.000000 Hz, not at `sample_rate` = 100 Hz",
    ),
    ("scale = \"1 g\"\n", "expected a plain number"),
];

#[test]
fn the_unit_and_the_channel_come_from_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let read = |file, keys| spec(folder.path(), file, keys);
    // Milliseconds, a dead channel, a voltage and the acceleration in g.
    let file = (
        "road.csv",
        "time (ms),dead (g),out (V),floor (g)\n0,0,1,0\n500,0,2,1\n1000,0,5,-4\n",
    );
    let spec_read = read(file, "").unwrap();
    assert_eq!(
        (record(&spec_read).step_s, &record(&spec_read).values[..]),
        (0.5, &[G, 2.0 * G, -3.0 * G][..])
    );
    assert_eq!(record(&spec_read).mean, -G);
    assert!(
        issues(&spec_read)
            .iter()
            .any(|message| message == "road: floor: its mean of -9.80665 m/s^2 is removed"),
        "{:?}",
        issues(&spec_read)
    );
    let unchanged = read(file, "mean = \"kept\"\nscale = 2\n").unwrap();
    assert_eq!(&record(&unchanged).values[..], &[0.0, G, -4.0 * G]);
    assert!(matches!(
        unchanged.drive["road"].signal,
        DriveSignal::Recording { scale: 2.0, .. }
    ));
    let by_number = read(file, "channel = \"3\"\nmean = \"kept\"\n").unwrap();
    assert_eq!(record(&by_number), record(&unchanged));
    for (keys, message) in FAULTS {
        let fault = read(file, keys).unwrap_err();
        assert!(fault.contains(message), "{keys}: {fault}");
    }
    // A sensor in V of 10 g/V.
    let sensed = read(
        file,
        "channel = \"out\"\nunit = \"g\"\nscale = 10\nmean = \"kept\"\n",
    )
    .unwrap();
    assert_eq!(&record(&sensed).values[..], &[G, 2.0 * G, 5.0 * G]);
}

#[test]
fn information_missing_from_the_file_is_given_by_a_key() {
    let folder = tempfile::tempdir().unwrap();
    let read = |file, keys| spec(folder.path(), file, keys);
    let bare = ("bare.csv", "a\n1\n-1\n3\n-3\n");
    let fault = read(bare, "").unwrap_err();
    assert!(
        fault.contains("no sampling times found")
            && fault.contains("give the drive a `sample_rate`"),
        "{fault}"
    );
    let spec_read = read(bare, "sample_rate = \"250 Hz\"\nunit = \"g\"\n").unwrap();
    assert_eq!(
        (record(&spec_read).step_s, &record(&spec_read).values[..]),
        (0.004, &[G, -G, 3.0 * G, -3.0 * G][..])
    );
    assert!(issues(&spec_read).is_empty(), "{:?}", issues(&spec_read));
    let assumed = read(bare, "sample_rate = \"250 Hz\"\n").unwrap();
    assert_eq!(
        issues(&assumed),
        ["road: a: no unit is given; m/s^2 is assumed"]
    );
    let two = ("two.csv", "time (s),left,right\n0,1,2\n0.5,-1,0\n1,1,2\n");
    let fault = read(two, "").unwrap_err();
    assert!(
        fault.contains("several channels fit (left, right); name one with `channel`"),
        "{fault}"
    );
}

#[test]
fn gaps_are_bridged_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    let rows: String = (0..40)
        .filter(|k| *k != 17)
        .map(|k| format!("{:.4},{}\n", 0.0101 * f64::from(k), k % 2))
        .collect();
    let rows = rows.replace("0.0505,1\n", "0.0505,nan\n");
    let spec_read = spec(
        folder.path(),
        ("road.csv", &format!("time (s),a (m/s^2)\n{rows}")),
        "mean = \"kept\"\n",
    )
    .unwrap();
    let values = &record(&spec_read).values;
    assert_eq!(
        (values.len(), values[5], values[17], values[18]),
        (40, 0.0, 0.0, 0.0)
    );
    let message = issues(&spec_read).join("; ");
    assert!(
        message.contains("not numbers") && message.contains("missing"),
        "{message}"
    );
}

#[test]
fn the_digest_depends_on_the_content_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let read = |text| {
        spec(folder.path(), ("road.csv", text), "")
            .unwrap()
            .hash_hex()
    };
    let before = read("time (s),a (g)\n0,0\n0.5,1\n1,-2\n");
    assert_ne!(read("time (s),a (g)\n0,0\n0.5,1\n1,-3\n"), before);
    let text = spec(
        folder.path(),
        ("road.csv", "time (s),a (g)\n0,0\n0.5,1\n1,-3\n"),
        "mean = \"kept\"\n",
    )
    .unwrap()
    .to_toml();
    assert_eq!(
        SpecFile::from_text(text.as_str())
            .in_folder(folder.path())
            .spec()
            .unwrap()
            .to_toml(),
        text
    );
}
