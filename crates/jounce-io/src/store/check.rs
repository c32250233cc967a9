//! Tests before a computation whether its results can be written. They leave no file and no folder.

use super::atomic::{StoreError, folder_of, target_of};
use std::path::Path;

/// Checks that a file can be written at a path.
///
/// # Errors
/// The folder cannot be created or written; the path is a folder, a device or a read-only file.
pub fn check_file(path: &Path) -> Result<(), StoreError> {
    let target = target_of(path)?;
    check_writable(path, folder_of(&target))
}

/// Checks that files can be written into a folder, which may be missing.
///
/// # Errors
/// The folder is a file, or cannot be created or written.
pub fn check_folder(folder: &Path) -> Result<(), StoreError> {
    check_writable(folder, folder)
}

/// Tries a file in a folder; in place of a missing one, in the nearest folder above it. The file has
/// no name, so that a process killed at this moment leaves nothing in a folder that no later command
/// writes into.
fn check_writable(path: &Path, folder: &Path) -> Result<(), StoreError> {
    let mut nearest = folder;
    // The current folder may be unreadable too.
    while !nearest.exists() && nearest != folder_of(nearest) {
        nearest = folder_of(nearest);
    }
    if !nearest.is_dir() {
        let reason = format!("\"{}\" is not a folder", nearest.display());
        return Err(StoreError::new(path, reason));
    }
    match tempfile::tempfile_in(nearest) {
        Ok(_) => Ok(()),
        Err(error) => Err(StoreError::of_system(path, &error)),
    }
}
