//! Recordings of instruments, one reader for each format.

use super::text_of;
use crate::scratch;
use jounce_data::read::{self, Notes, summary_with_notes, vectors};
use std::path::Path;
use std::sync::LazyLock;

/// Reads a file whose first bytes are those of a format, so that each input reaches its reader.
fn recording(data: &[u8], marks: &[(usize, &[u8])]) {
    let mut bytes = data.to_vec();
    for (at, mark) in marks {
        let end = at + mark.len();
        bytes.resize(bytes.len().max(end), b' ');
        bytes[*at..end].copy_from_slice(mark);
    }
    check(&scratch::file("recording", &bytes));
}

/// All channels have a value for each place of the grid.
fn check(path: &Path) {
    let contents = match read::file(path) {
        Ok(contents) => contents,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    for recording in &contents.recordings {
        let samples = recording.grid.len();
        for channel in &recording.channels {
            assert_eq!(channel.values.len(), samples, "{}", channel.name);
            let imaginary = channel.imaginary.as_ref().map_or(samples, Vec::len);
            assert_eq!(imaginary, samples, "{}", channel.name);
        }
    }
    for shape in &contents.shapes {
        assert_eq!(shape.real.len(), shape.nodes.len());
    }
}

pub fn text(data: &[u8]) {
    recording(data, &[]);
}

pub fn uff(data: &[u8]) {
    recording(data, &[(0, b"    -1\n")]);
}

pub fn wav(data: &[u8]) {
    recording(data, &[(0, b"RIFF"), (8, b"WAVE")]);
}

pub fn mat(data: &[u8]) {
    recording(data, &[(0, b"MATLAB 5.0")]);
}

/// An array alone has no time: its notes state the rate.
pub fn npy(data: &[u8]) {
    static NOTES: LazyLock<Notes> =
        LazyLock::new(|| Notes::from_toml("rate = \"1 kHz\"").expect("notes"));
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend(data.get(6..).unwrap_or_default());
    let path = scratch::file("recording", &bytes);
    let Ok(summary) = summary_with_notes(&path, &NOTES) else {
        return;
    };
    for recording in summary.recordings {
        let recording = recording.into_recording().expect("the scratch file");
        let samples = recording.grid.len();
        assert!(
            recording
                .channels
                .iter()
                .all(|channel| channel.values.len() == samples)
        );
    }
}

pub fn npz(data: &[u8]) {
    recording(data, &[(0, b"PK\x03\x04")]);
    let _ = vectors(&scratch::folder().join("recording"));
}

pub fn hdf5(data: &[u8]) {
    recording(data, &[(0, b"\x89HDF\r\n\x1a\n")]);
}

pub fn parquet(data: &[u8]) {
    let end = data.len().max(12) - 4;
    recording(data, &[(0, b"PAR1"), (end, b"PAR1")]);
}

pub fn tdms(data: &[u8]) {
    recording(data, &[(0, b"TDSm")]);
}

pub fn lvm(data: &[u8]) {
    recording(data, &[(0, b"LabVIEW Measurement")]);
}

/// Notes of a file.
pub fn notes(data: &[u8]) {
    if let Err(faults) = Notes::from_toml(&text_of(data)) {
        assert!(!faults.is_empty() && faults.iter().all(|fault| !fault.is_empty()));
    }
}
