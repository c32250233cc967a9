//! Truncated and damaged files: a result or one clear error, never a panic.

use crate::samples::{lvm, mat, npy, record, response, uff58b};
use jounce_data::read;
use jounce_data::write::write;
use proptest::prelude::*;
use std::path::Path;

/// A complete file of each format.
fn complete_files() -> Vec<(&'static str, Vec<u8>)> {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes_of = |recording, name: &str| {
        let path = folder.path().join(name);
        write(recording, &path).unwrap_or_else(|fault| panic!("{fault}"));
        std::fs::read(&path).expect("it was written")
    };
    let rows = vec![
        (0..50).map(|k| f64::from(k) * 1e-3).collect(),
        (0..50).map(|k| f64::from(k).sin()).collect::<Vec<f64>>(),
    ];
    let shapes = b"    -1\n    55\nNONE\nNONE\nNONE\nNONE\nNONE\n         1         2         2         8         2         3\n         2         4         1         1\n  1.0e+01  0.0e+00  1.0e-02  0.0e+00\n         1\n -1.4e+00 -1.4e+00 -1.4e+00\n    -1\n";
    vec![
        ("a.csv", bytes_of(&record(), "a.csv")),
        ("a.parquet", bytes_of(&record(), "a.parquet")),
        ("a.uff", bytes_of(&record(), "a.uff")),
        ("b.uff", bytes_of(&response(), "b.uff")),
        ("c.uff", uff58b(false, true)),
        ("d.uff", shapes.to_vec()),
        ("a.npy", npy(&rows)),
        ("a.mat", mat("m", &rows)),
        ("a.lvm", lvm().into_bytes()),
    ]
}

/// Reads damaged bytes; an error must name the file.
fn survives(folder: &Path, name: &str, bytes: &[u8]) {
    let path = folder.join(name);
    std::fs::write(&path, bytes).expect("a file");
    if let Err(fault) = read::file(&path) {
        assert!(fault.to_string().contains(name), "{fault}");
    }
}

#[test]
fn every_cut_is_survived() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in complete_files() {
        read::file(&{
            let path = folder.path().join(name);
            std::fs::write(&path, &bytes).expect("a file");
            path
        })
        .unwrap_or_else(|fault| panic!("the whole file: {fault}"));
        // Every position in the header, which has lengths, then positions everywhere.
        let step = (bytes.len() / 150).max(1);
        for length in (0..bytes.len().min(250)).chain((250..bytes.len()).step_by(step)) {
            survives(folder.path(), name, &bytes[..length]);
        }
    }
}

/// A truncated number is a valid number, and a truncated time stamp lies before all others.
/// Whatever remains of the last row, the complete rows are read in order, and a cut inside a row is
/// reported.
#[test]
fn a_text_that_ends_inside_a_row_keeps_its_complete_rows() {
    let (folder, text) = (tempfile::tempdir().expect("a folder"), lvm());
    let path = folder.path().join("a.lvm");
    let data = text.find("Comment\n").expect("heads") + 8;
    let third = data + text[data..].match_indices('\n').nth(2).expect("rows").0 + 1;
    for end in third..text.len() {
        std::fs::write(&path, &text[..end]).expect("a file");
        let recording = read::record(&path).unwrap_or_else(|fault| panic!("cut at {end}: {fault}"));
        let last = text[data..end].rsplit('\n').next().unwrap_or_default();
        let rows = text[data..end].matches('\n').count();
        // Two delimiters with text behind them: whether more should follow is unknown.
        let seems_complete = last.matches('\t').count() == 2 && !last.ends_with(['\t', '-', '.']);
        let (least, most) = (rows, rows + usize::from(last.matches('\t').count() == 2));
        let count = recording.channels[0].values.len();
        assert!(
            (least..=most).contains(&count) && (!seems_complete || count == most),
            "cut at {end}: {count} of {rows}"
        );
        let cut = recording
            .issues
            .iter()
            .any(|issue| issue.about.contains("ends inside a row"));
        assert_eq!(cut, !last.is_empty() && count == rows, "cut at {end}");
        assert!(
            (recording.rate() - 800.0).abs() < 1e-6,
            "cut at {end}: {} Hz",
            recording.rate()
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_damage_is_survived(index in 0usize..9, position in 0.0f64..1.0, bytes in proptest::collection::vec(any::<u8>(), 1..9), cut in 0.0f64..1.5) {
        let (name, mut file) = complete_files().swap_remove(index);
        // Damage in the header has a larger effect than damage among the samples.
        let at = ((file.len() - 1) as f64 * position.powi(3)) as usize;
        file[at..].iter_mut().zip(&bytes).for_each(|(byte, damaged)| *byte = *damaged);
        file.truncate((file.len() as f64 * cut) as usize);
        let folder = tempfile::tempdir().expect("a folder");
        survives(folder.path(), name, &file);
    }
}
