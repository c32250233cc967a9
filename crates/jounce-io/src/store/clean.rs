//! Removal of incomplete files of killed processes.

use super::atomic::{PREFIX, RANDOM_CHARACTERS, SUFFIX};
use std::fs::{self, DirEntry, File};
use std::path::Path;
use std::time::Duration;

/// Time within which the writer locks a new file.
const MIN_AGE: Duration = Duration::from_secs(5);

/// Removes the abandoned incomplete files of a folder. Files that another process is writing
/// remain. Files that cannot be removed also remain: they are hidden and never read.
pub fn clean(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten().filter(is_leftover) {
        let _ = fs::remove_file(entry.path());
    }
}

/// True for a name that an incomplete file has.
fn is_incomplete(name: &str) -> bool {
    let random = (name.strip_prefix(PREFIX)).and_then(|rest| rest.strip_suffix(SUFFIX));
    random.is_some_and(|random| {
        random.len() == RANDOM_CHARACTERS && random.bytes().all(|c| c.is_ascii_alphanumeric())
    })
}

fn is_leftover(entry: &DirEntry) -> bool {
    let name = entry.file_name();
    let is_ours = name.to_str().is_some_and(is_incomplete);
    let age = || entry.metadata().ok()?.modified().ok()?.elapsed().ok();
    let is_free = || File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok());
    is_ours && age().is_some_and(|age| age > MIN_AGE) && is_free()
}
