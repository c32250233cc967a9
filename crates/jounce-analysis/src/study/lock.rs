//! Lock of a shard: one process works on it at a time.

use super::{Shard, StudyError};
use jounce_io::store;
use std::fs::File;
use std::path::Path;

/// Lock of a shard. On a file system without locks two processes may compute the same parts, which
/// are written atomically.
#[derive(Debug)]
pub(super) struct Lock(#[expect(dead_code, reason = "the open file is the lock")] File);

impl Lock {
    /// Takes the lock of a shard.
    pub(super) fn take(folder: &Path, shard: Shard) -> Result<Self, StudyError> {
        let path = folder.join(format!(".shard-{}-of-{}.lock", shard.index, shard.of));
        let unwritable = |reason: std::io::Error| StudyError::Folder {
            folder: folder.to_owned(),
            reason: store::reason(&reason),
        };
        match store::open_locked(&path).map_err(unwritable)? {
            Some(file) => Ok(Self(file)),
            None => Err(StudyError::Busy {
                folder: folder.to_owned(),
                shard: shard.to_string(),
            }),
        }
    }
}
