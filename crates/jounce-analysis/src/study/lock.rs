//! Lock of a shard: one process works on it at a time.

use super::{Shard, StudyError};
use std::fs::{File, OpenOptions, TryLockError};
use std::path::Path;

/// Lock of a shard; the system releases it when the process ends for any reason.
#[derive(Debug)]
pub(super) struct Lock(#[expect(dead_code, reason = "the open file is the lock")] Option<File>);

impl Lock {
    /// Takes the lock of a shard.
    pub(super) fn take(folder: &Path, shard: Shard) -> Result<Self, StudyError> {
        let path = folder.join(format!(".shard-{}-of-{}.lock", shard.index, shard.of));
        let unwritable = |reason: std::io::Error| StudyError::Folder {
            folder: folder.to_owned(),
            reason: reason.to_string(),
        };
        let file = OpenOptions::new()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&path)
            .map_err(unwritable)?;
        match file.try_lock() {
            Ok(()) => Ok(Self(Some(file))),
            Err(TryLockError::WouldBlock) => Err(StudyError::Busy {
                folder: folder.to_owned(),
                shard: shard.to_string(),
            }),
            // Some network file systems have no locks. Parts are written atomically, so the worst
            // result is duplicate work.
            Err(TryLockError::Error(_)) => Ok(Self(None)),
        }
    }
}
