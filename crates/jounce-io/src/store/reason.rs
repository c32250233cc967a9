//! Messages about files that cannot be read and folders that cannot be written.

use std::fmt::Display;
use std::io::{Error, ErrorKind};
use std::path::Path;

/// Returns the message about a file that does not exist.
pub fn missing(path: &Path) -> String {
    format!("{} does not exist", path.display())
}

/// Returns the message about a file that cannot be read.
pub fn unreadable(path: &Path, error: &Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => missing(path),
        ErrorKind::IsADirectory => {
            format!(
                "{} is a folder; give the name of a file in it",
                path.display()
            )
        }
        _ => format!("{} cannot be read: {error}", path.display()),
    }
}

/// Returns the message about a folder that cannot be created or written.
pub fn unwritable_folder(path: &Path, reason: impl Display) -> String {
    format!(
        "cannot write into the folder \"{}\": {reason}; choose another one, where you may write",
        path.display()
    )
}
