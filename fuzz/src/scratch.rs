//! Files of one input in the folder SCRATCH, which should be in memory; by default that for temporary files.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = std::env::var_os("SCRATCH").map_or_else(std::env::temp_dir, PathBuf::from);
    let folder = folder.join(format!("jounce-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
});

/// Returns the folder.
pub fn folder() -> &'static Path {
    &FOLDER
}

/// Writes a file of the folder and returns its path.
pub fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let path = FOLDER.join(name);
    std::fs::write(&path, bytes).expect("a file");
    path
}

/// Returns the parts of an input between lines `====`, as many as wanted; missing ones are empty.
pub fn parts<const N: usize>(data: &[u8]) -> [&[u8]; N] {
    let mut rest = data;
    std::array::from_fn(|_| {
        let mark = b"\n====\n";
        match rest.windows(mark.len()).position(|window| window == mark) {
            Some(at) => {
                let part = &rest[..at];
                rest = &rest[at + mark.len()..];
                part
            }
            None => std::mem::take(&mut rest),
        }
    })
}
