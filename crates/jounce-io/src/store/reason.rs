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
        _ => format!("{} cannot be read: {}", path.display(), reason(error)),
    }
}

/// Returns the message about a folder that cannot be created or written.
pub fn unwritable_folder(path: &Path, reason: impl Display) -> String {
    format!(
        "cannot write into the folder \"{}\": {reason}; choose another one, where you may write",
        path.display()
    )
}

/// Returns the reason of a failure, without the number of the system, the name of a temporary file
/// and the words of a library around it.
pub fn reason(error: &(dyn std::error::Error + 'static)) -> String {
    let system = std::iter::successors(Some(error), |error| error.source())
        .find_map(|error| error.downcast_ref::<Error>());
    let text = system.map_or_else(|| error.to_string(), ToString::to_string);
    let text = text.split(" (os error").next().unwrap_or_default();
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_lowercase());
    first.into_iter().chain(letters).collect()
}
