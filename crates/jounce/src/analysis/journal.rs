//! Finished points on disk, so that an interrupted sweep or diagram goes on where it stopped.
//!
//! One JSON line per point, appended and flushed as soon as the point is finished. A line that a kill cut short is dropped when
//! the journal is read. Numbers are written so that they read back bit for bit. The journal goes when its sweep is complete.

use super::SweepPoint;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// A journal that cannot be kept.
#[derive(Debug, thiserror::Error, serde::Serialize)]
#[error(
    "the journal of finished points {path} cannot be used: {reason}; set JOUNCE_CACHE to a folder that can be written"
)]
pub struct JournalError {
    /// The file.
    pub path: String,
    /// What is wrong.
    pub reason: String,
}

/// The journal of one study over points `P`.
#[derive(Debug)]
pub struct Journal<P = SweepPoint> {
    path: PathBuf,
    file: Mutex<File>,
    found: Vec<P>,
}

impl<P: Serialize + DeserializeOwned> Journal<P> {
    /// Opens or creates the journal of a sweep, told apart by `key` (a digest of spec and options).
    ///
    /// # Errors
    /// [`JournalError`].
    pub fn open(folder: &Path, key: &str) -> Result<Self, JournalError> {
        let path = folder.join(format!("{key}.jsonl"));
        let fault = |error: std::io::Error| JournalError {
            path: path.display().to_string(),
            reason: error.to_string(),
        };
        std::fs::create_dir_all(folder).map_err(fault)?;
        let text = match std::fs::read(&path) {
            Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(fault(error)),
        };
        let (mut found, mut whole) = (Vec::new(), 0);
        for line in text.split_inclusive('\n') {
            match serde_json::from_str::<P>(line) {
                Ok(point) if line.ends_with('\n') => found.push(point),
                _ => break,
            }
            whole += line.len();
        }
        let mut file = OpenOptions::new()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&path)
            .map_err(fault)?;
        file.set_len(whole as u64).map_err(fault)?;
        file.seek(SeekFrom::End(0)).map_err(fault)?;
        Ok(Self {
            path,
            file: Mutex::new(file),
            found,
        })
    }

    /// Points found when the journal was opened.
    pub fn found(&self) -> &[P] {
        &self.found
    }

    /// Keeps a finished point.
    ///
    /// # Errors
    /// [`JournalError`].
    pub fn keep(&self, point: &P) -> Result<(), JournalError> {
        let fault = |reason: String| JournalError {
            path: self.path.display().to_string(),
            reason,
        };
        let mut line = serde_json::to_string(point).map_err(|error| fault(error.to_string()))?;
        line.push('\n');
        let mut file = self.file.lock().map_err(|error| fault(error.to_string()))?;
        file.write_all(line.as_bytes())
            .and_then(|()| file.flush())
            .map_err(|error| fault(error.to_string()))
    }

    /// Removes the journal of a complete sweep.
    ///
    /// # Errors
    /// [`JournalError`].
    pub fn finish(self) -> Result<(), JournalError> {
        std::fs::remove_file(&self.path).map_err(|error| JournalError {
            path: self.path.display().to_string(),
            reason: error.to_string(),
        })
    }
}
