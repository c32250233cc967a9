//! Where the spec of a page comes from.

use jounce::spec::{ReadError, SpecFile};
use std::path::{Path, PathBuf};

/// Name of a spec that no file holds: that of the file which the page saves it to, so that the exported lines find it there.
const UNSAVED: &str = "harvester.toml";

/// The spec of a page.
#[derive(Debug, Clone)]
pub enum Source {
    /// A file; the page follows it.
    File(PathBuf),
    /// A text that no file holds and that stays as it is.
    Text {
        /// The spec.
        text: String,
        /// Where the state files and recordings are looked for that it names.
        folder: PathBuf,
    },
}

impl Source {
    /// The spec as it is now.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(&self) -> Result<SpecFile, ReadError> {
        match self {
            Self::File(path) => SpecFile::read(path),
            Self::Text { text, folder } => Ok(SpecFile::from_text(text.as_str()).in_folder(folder)),
        }
    }

    /// The file, where there is one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Text { .. } => None,
        }
    }

    /// The path by which faults and exported lines name the spec.
    pub fn name(&self) -> &Path {
        self.file().unwrap_or(Path::new(UNSAVED))
    }

    /// Where the state files and recordings are looked for that the spec names.
    pub fn folder(&self) -> &Path {
        let folder = match self {
            Self::File(path) => path.parent().unwrap_or(Path::new("")),
            Self::Text { folder, .. } => folder,
        };
        if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            folder
        }
    }
}
