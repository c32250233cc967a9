//! Errors of files that cannot be read.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::fault::Fault;
use super::source::Lines;

/// Largest size of a spec, bytes.
pub(super) const MAX_SPEC_BYTES: usize = 16 << 20;

/// Reason why a file cannot be read as a spec.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file does not exist.
    #[error("{}", jounce_io::store::missing(path))]
    Missing {
        /// the path
        path: PathBuf,
    },
    /// The path is a folder.
    #[error("{} is a folder; name the spec file in it", path.display())]
    Folder {
        /// the path
        path: PathBuf,
    },
    /// The file exceeds the size limit.
    #[error("{} is larger than 16 MiB, the largest size of a spec", path.display())]
    TooLarge {
        /// the path
        path: PathBuf,
    },
    /// The file is not UTF-8.
    #[error("{} is not a text file: {fault}", path.display())]
    NotText {
        /// the path
        path: PathBuf,
        /// the first wrong byte and its place
        fault: Fault,
    },
    /// The operating system refuses to read the file.
    #[error("{}", jounce_io::store::unreadable(path, source))]
    Unreadable {
        /// the path
        path: PathBuf,
        /// message of the system
        source: std::io::Error,
    },
}

/// Reads the text of a file.
pub(super) fn read_text(path: &Path) -> Result<String, ReadError> {
    let owned = || path.to_path_buf();
    let unreadable = |source: std::io::Error| match source.kind() {
        std::io::ErrorKind::NotFound => ReadError::Missing { path: owned() },
        std::io::ErrorKind::IsADirectory => ReadError::Folder { path: owned() },
        _ => ReadError::Unreadable {
            path: owned(),
            source,
        },
    };
    if path.is_dir() {
        return Err(ReadError::Folder { path: owned() });
    }
    let mut bytes = Vec::new();
    // One byte more than allowed, so reading an endless device terminates.
    let limited = std::fs::File::open(path)
        .map_err(unreadable)?
        .take(MAX_SPEC_BYTES as u64 + 1);
    { limited }.read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() > MAX_SPEC_BYTES {
        return Err(ReadError::TooLarge { path: owned() });
    }
    String::from_utf8(bytes).map_err(|error| ReadError::NotText {
        path: owned(),
        fault: wrong_byte(&error),
    })
}

fn wrong_byte(error: &std::string::FromUtf8Error) -> Fault {
    let at = error.utf8_error().valid_up_to();
    let valid = String::from_utf8_lossy(&error.as_bytes()[..at]);
    let (line, column) = Lines::new(&valid).line_and_column(at);
    let bytes = error.as_bytes();
    let message = match bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        true => "it is UTF-16 text: save it as UTF-8".to_owned(),
        false => format!("the byte 0x{:02x} is not UTF-8", bytes[at]),
    };
    Fault {
        line,
        column,
        ..Fault::without_position("", message)
    }
}
