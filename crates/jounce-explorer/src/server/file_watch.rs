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
    modified: SystemTime,
}

fn file_state(path: &Path) -> Option<FileState> {
    let metadata = std::fs::metadata(path).ok()?;
    Some(FileState {
        length: metadata.len(),
        modified: metadata.modified().ok()?,
    })
}

/// Watches a file permanently and returns the count of its states. Without a file there is one
/// state.
pub fn start(path: Option<PathBuf>) -> watch::Receiver<u64> {
    let (sender, receiver) = watch::channel(0);
    tokio::spawn(async move {
        let Some(path) = path else {
            return sender.closed().await;
        };
        let mut previous = file_state(&path);
        let mut interval = tokio::time::interval(CHECK_INTERVAL);
        loop {
            tokio::select! {
                () = sender.closed() => return,
                _ = interval.tick() => {
                    let current = file_state(&path);
                    if current != previous {
                        previous = current;
                        sender.send_modify(|version| *version += 1);
                    }
                }
            }
        }
    });
    receiver
}
