//! Finished points on disk, from which an interrupted sweep or diagram resumes.
//!
//! Each finished point is appended as one JSON line. One process at a time holds the journal. When
//! it is read, an incomplete last line is dropped. Numbers read back bit for bit. The journal is
//! removed when its sweep is complete.

use super::SweepPoint;
use jounce_io::store;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Error of reading or writing a journal.
#[derive(Debug, thiserror::Error, serde::Serialize)]
#[error(
    "the journal of finished points {path} cannot be used: {reason}; set JOUNCE_CACHE to another folder"
)]
pub struct JournalError {
    /// Path of the file.
    pub path: String,
    /// Reason of the failure.
    pub reason: String,
}

impl JournalError {
    fn new(path: &Path, reason: impl ToString) -> Self {
        Self {
            path: path.display().to_string(),
            reason: reason.to_string(),
        }
    }
}

/// Journal of one analysis over points `P`.
#[derive(Debug)]
pub struct Journal<P = SweepPoint> {
    path: PathBuf,
    file: Mutex<File>,
    found: Vec<P>,
}

impl<P: Serialize + DeserializeOwned> Journal<P> {
    /// Opens or creates the journal of a sweep; `key` (a digest of spec and options) identifies it.
    ///
    /// # Errors
    /// [`JournalError`]: a folder that cannot be written, another process that computes the same.
    pub fn open(folder: &Path, key: &str) -> Result<Self, JournalError> {
        let path = folder.join(format!("{key}.jsonl"));
        let fault = |error: std::io::Error| JournalError::new(&path, store::reason(&error));
        std::fs::create_dir_all(folder).map_err(fault)?;
        let Some(mut file) = store::open_locked(&path).map_err(fault)? else {
            const BUSY: &str = "another process computes the same; wait for it";
            return Err(JournalError::new(&path, BUSY));
        };
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(fault)?;
        let (mut entries, mut complete_bytes) = (Vec::new(), 0);
        // The bytes are read, not a text: in a text a damaged byte becomes a character of another
        // length, and the cut below would be at a wrong place.
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            match serde_json::from_slice::<P>(line) {
                Ok(point) if line.ends_with(b"\n") => entries.push(point),
                _ => break,
            }
            complete_bytes += line.len();
        }
        cut(&mut file, complete_bytes as u64).map_err(fault)?;
        Ok(Self {
            path,
            file: Mutex::new(file),
            found: entries,
        })
    }

    /// Returns the points that the journal held when it was opened.
    pub fn found(&self) -> &[P] {
        &self.found
    }

    /// Appends a finished point.
    ///
    /// # Errors
    /// [`JournalError`].
    pub fn keep(&self, point: &P) -> Result<(), JournalError> {
        let fault = |reason: String| JournalError::new(&self.path, reason);
        let mut line = serde_json::to_string(point).map_err(|error| fault(error.to_string()))?;
        line.push('\n');
        let mut file = self.file.lock().map_err(|error| fault(error.to_string()))?;
        let written = file.stream_position().and_then(|length| {
            let line = file.write_all(line.as_bytes());
            // Points of other threads must not follow a part of a line, after which none is read.
            line.inspect_err(|_| drop(cut(&mut file, length)))
        });
        written.map_err(|error| fault(store::reason(&error)))
    }

    /// Removes the journal of a complete sweep.
    ///
    /// # Errors
    /// [`JournalError`].
    pub fn finish(self) -> Result<(), JournalError> {
        match std::fs::remove_file(&self.path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(JournalError::new(&self.path, store::reason(&error)))
            }
            _ => Ok(()),
        }
    }
}

/// Cuts a file to a length and continues there.
fn cut(file: &mut File, length: u64) -> std::io::Result<()> {
    file.set_len(length)?;
    file.seek(SeekFrom::Start(length)).map(|_| ())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn a_journal_continues_after_a_damaged_byte() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("key.jsonl");
        std::fs::write(&path, b"\"a\"\n\"\xff\"\n\"c\"\n").unwrap();
        let open = || Journal::<String>::open(folder.path(), "key").unwrap();
        let journal = open();
        assert_eq!(journal.found(), ["a"]);
        journal.keep(&"b".to_owned()).unwrap();
        drop(journal);
        assert_eq!(open().found(), ["a", "b"]);
    }
}
