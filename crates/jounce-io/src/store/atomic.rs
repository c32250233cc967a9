//! Atomic writing of files.

use super::clean::clean;
use super::reason::reason;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Failure to write an output. No partial file remains, and an older file at the path is unchanged.
#[derive(Debug, thiserror::Error, serde::Serialize)]
#[error("cannot write \"{path}\": {reason}")]
pub struct StoreError {
    /// Path of the output.
    pub path: PathBuf,
    /// Reason, with a remedy if known.
    pub reason: String,
}

impl StoreError {
    pub(super) fn new(path: &Path, reason: impl ToString) -> Self {
        Self {
            path: path.to_owned(),
            reason: reason.to_string(),
        }
    }

    pub(super) fn of_system(path: &Path, error: &io::Error) -> Self {
        Self::new(path, reason(error))
    }
}

/// Beginning and end of the names of incomplete files; between them are random letters and digits.
pub(super) const PREFIX: &str = ".jounce-";
pub(super) const SUFFIX: &str = ".part";

/// Number of random letters and digits in the name of an incomplete file.
pub(super) const RANDOM_CHARACTERS: usize = 6;

/// A complete file under a temporary name, in the folder of its target. It is removed when it is
/// dropped.
#[derive(Debug)]
pub struct PendingFile {
    path: PathBuf,
    target: PathBuf,
    file: tempfile::NamedTempFile,
}

impl PendingFile {
    /// Gives the file its name, and replaces an older file atomically.
    ///
    /// # Errors
    /// The folder has vanished or is not writable.
    pub fn persist(self) -> Result<(), StoreError> {
        let (path, target) = (self.path, self.target);
        self.file
            .persist(&target)
            .map_err(|fault| StoreError::of_system(&path, &fault.error))?;
        flush_name(&target);
        Ok(())
    }
}

/// Writes `content` to `path` and replaces an older file atomically. Creates the folder if it is
/// missing. Symbolic links are followed.
///
/// # Errors
/// The folder cannot be created or written, the target is a folder, a device or read-only, or the
/// disk is full.
pub fn write(path: &Path, content: &[u8]) -> Result<(), StoreError> {
    write_from(path, |file| file.write_all(content))
}

/// Writes content that `fill` generates and replaces an older file atomically.
///
/// # Errors
/// Those of [`write()`], and the errors of `fill`.
pub fn write_from(
    path: &Path,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), StoreError> {
    prepare(path, fill)?.persist()
}

/// Writes content under a temporary name. Files that belong together are all prepared before the
/// first gets its name, so that a full disk leaves the older ones.
///
/// # Errors
/// Those of [`write_from`].
pub fn prepare(
    path: &Path,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<PendingFile, StoreError> {
    let target = target_of(path)?;
    let folder = made_folder_of(&target)?;
    pending(path, &target, folder, fill)
}

/// Writes a file of a folder that holds more than this file: the folder must exist, because what it
/// held is lost where it has vanished.
///
/// # Errors
/// Those of [`write()`], and a missing folder.
pub fn write_in_folder(path: &Path, content: &[u8]) -> Result<(), StoreError> {
    let target = target_of(path)?;
    let folder = folder_of(&target);
    if !folder.is_dir() {
        let reason = format!("the folder \"{}\" does not exist", folder.display());
        return Err(StoreError::new(path, reason));
    }
    pending(path, &target, folder, |file| file.write_all(content))?.persist()
}

/// Writes `content` to a new file at `path`; creates its folder if it is missing. An existing file
/// or link is unchanged, even if it appears during the call.
///
/// # Errors
/// The path exists, the folder cannot be created or written, or the disk is full.
pub fn create(path: &Path, content: &[u8]) -> Result<(), StoreError> {
    const TAKEN: &str = "it is there already; choose another name or ask for it to be replaced";
    if path.file_name().is_none() {
        return Err(StoreError::new(path, "it names no file"));
    }
    if fs::symlink_metadata(path).is_ok() {
        return Err(StoreError::new(path, TAKEN));
    }
    let folder = made_folder_of(path)?;
    pending(path, path, folder, |file| file.write_all(content))?
        .file
        .persist_noclobber(path)
        .map_err(|fault| match fault.error.kind() {
            io::ErrorKind::AlreadyExists => StoreError::new(path, TAKEN),
            _ => StoreError::of_system(path, &fault.error),
        })?;
    flush_name(path);
    Ok(())
}

/// Returns the folder of a file.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent()
        .filter(|parent| !parent.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// Returns the folder of a file; creates it if it is missing, and removes what killed processes
/// left in it.
fn made_folder_of(path: &Path) -> Result<&Path, StoreError> {
    let folder = folder_of(path);
    fs::create_dir_all(folder).map_err(|fault| {
        let name = folder.display();
        let reason = match folder.exists() {
            true => format!("\"{name}\" is not a folder"),
            false => format!(
                "the folder \"{name}\" cannot be created: {}",
                reason(&fault)
            ),
        };
        StoreError::new(path, reason)
    })?;
    clean(folder);
    Ok(folder)
}

/// Returns the regular file to replace: the end of a chain of links, or the path itself for a new
/// file.
pub(super) fn target_of(path: &Path) -> Result<PathBuf, StoreError> {
    if path.file_name().is_none() {
        return Err(StoreError::new(path, "it names no file"));
    }
    let Ok(metadata) = fs::metadata(path) else {
        return Ok(path.to_owned());
    };
    if metadata.is_dir() {
        return Err(StoreError::new(
            path,
            "it is a folder; give the name of a file in it",
        ));
    }
    if !metadata.is_file() {
        return Err(StoreError::new(path, "it is not a regular file"));
    }
    if metadata.permissions().readonly() {
        return Err(StoreError::new(
            path,
            "it is read-only; make it writable or choose another name",
        ));
    }
    fs::canonicalize(path).map_err(|fault| StoreError::of_system(path, &fault))
}

/// Creates a temporary file in the folder of the target, with the content, flushed to the disk.
fn pending(
    path: &Path,
    target: &Path,
    folder: &Path,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<PendingFile, StoreError> {
    let written = || -> io::Result<_> {
        let mut temporary = temporary_file(folder)?;
        // The lock protects the file from `clean`. On a file system without locks, `clean` removes
        // no file.
        let _ = temporary.as_file().try_lock();
        fill(temporary.as_file_mut())?;
        temporary.as_file().sync_all()?;
        Ok(temporary)
    };
    let file = written().map_err(|fault| StoreError::of_system(path, &fault))?;
    Ok(PendingFile {
        path: path.to_owned(),
        target: target.to_owned(),
        file,
    })
}

/// Flushes the new name to the disk, if the file system can flush a folder.
fn flush_name(target: &Path) {
    if let Ok(folder) = File::open(folder_of(target)) {
        let _ = folder.sync_all();
    }
}

/// Creates a temporary file with the permissions of an ordinary new file (the process's mask
/// applies).
fn temporary_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder
        .prefix(PREFIX)
        .suffix(SUFFIX)
        .rand_bytes(RANDOM_CHARACTERS);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
