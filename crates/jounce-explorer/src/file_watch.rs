//! Notices when the spec changes on disk.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use tokio::sync::watch;

/// Time between two looks.
const LOOK: Duration = Duration::from_millis(250);

/// What tells one state of a file from another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Look {
    length: u64,
    changed: SystemTime,
}

fn look(path: &Path) -> Option<Look> {
    let about = std::fs::metadata(path).ok()?;
    Some(Look { length: about.len(), changed: about.modified().ok()? })
}

/// Looks at a file for ever; what is returned counts its states. Without a file there is one state.
pub fn follow(path: Option<PathBuf>) -> watch::Receiver<u64> {
    let (told, hears) = watch::channel(0);
    tokio::spawn(async move {
        let Some(path) = path else { return told.closed().await };
        let mut before = look(&path);
        let mut pace = tokio::time::interval(LOOK);
        loop {
            tokio::select! {
                () = told.closed() => return,
                _ = pace.tick() => {
                    let now = look(&path);
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
