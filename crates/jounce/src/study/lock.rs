//! A shard that one process works on at a time.

use super::{Shard, StudyError};
use std::fs::{File, OpenOptions, TryLockError};
use std::path::Path;

/// Held while a shard is worked on; the system lets go of it when the process ends, however it ends.
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
            // Some network file systems know no locks. Parts are whole whoever writes them, so that work done twice is all that can happen.
            Err(TryLockError::Error(_)) => Ok(Self(None)),
        }
    }
}
