//! Removal of incomplete files of killed processes.

use super::atomic::PREFIX;
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

fn is_leftover(entry: &DirEntry) -> bool {
    let is_ours = entry.file_name().to_string_lossy().starts_with(PREFIX);
    let age = || entry.metadata().ok()?.modified().ok()?.elapsed().ok();
    let is_free = || File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok());
    is_ours && age().is_some_and(|age| age > MIN_AGE) && is_free()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::time::SystemTime;

    #[test]
    fn only_abandoned_files_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        let create_aged = |name: &str, age_s: u64| {
            let file = File::create(folder.path().join(name)).unwrap();
            file.set_modified(SystemTime::now() - Duration::from_secs(age_s))
                .unwrap();
            file
        };
        drop((
            create_aged(".jounce-left", 60),
            create_aged(".jounce-young", 0),
            create_aged("part.parquet", 60),
        ));
        let written = create_aged(".jounce-written", 60);
        written.lock().unwrap();
        clean(folder.path());
        let mut names: Vec<_> = fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .collect();
        names.sort();
        assert_eq!(names, [".jounce-written", ".jounce-young", "part.parquet"]);
    }
}
