//! Watch of the spec file for changes on disk.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use tokio::sync::watch;

/// Time between two checks.
const CHECK_INTERVAL: Duration = Duration::from_millis(250);

/// Data that identify the state of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct FileState {
    length: u64,
    changed: SystemTime,
}

fn file_state(path: &Path) -> Option<FileState> {
    let about = std::fs::metadata(path).ok()?;
    Some(FileState {
        length: about.len(),
        changed: about.modified().ok()?,
    })
}

/// Watches a file permanently and returns the count of its states. Without a file there is one
/// state.
pub fn follow(path: Option<PathBuf>) -> watch::Receiver<u64> {
    let (told, hears) = watch::channel(0);
    tokio::spawn(async move {
        let Some(path) = path else {
            return told.closed().await;
        };
        let mut before = file_state(&path);
        let mut pace = tokio::time::interval(CHECK_INTERVAL);
        loop {
            tokio::select! {
                () = told.closed() => return,
                _ = pace.tick() => {
                    let now = file_state(&path);
                    if now != before {
                        before = now;
                        told.send_modify(|version| *version += 1);
                    }
                }
            }
        }
    });
    hears
}
