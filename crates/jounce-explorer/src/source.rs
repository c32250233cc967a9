//! Source of the spec of a page.

use jounce_core::spec::{ReadError, SpecFile};
use std::path::{Path, PathBuf};

/// Name of a spec without a file: the name under which the page saves it, so that the exported
/// commands find it.
const UNSAVED: &str = "harvester.toml";

/// Source of a spec.
#[derive(Debug, Clone)]
pub enum Source {
    /// File; the page follows its changes.
    File(PathBuf),
    /// Constant text without a file.
    Text {
        /// The spec.
        text: String,
        /// Folder of the state files and recordings that the spec names.
        folder: PathBuf,
    },
}

impl Source {
    /// Reads the spec.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(&self) -> Result<SpecFile, ReadError> {
        match self {
            Self::File(path) => SpecFile::read(path),
            Self::Text { text, folder } => Ok(SpecFile::from_text(text.as_str()).in_folder(folder)),
        }
    }

    /// Returns the path of a file.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Text { .. } => None,
        }
    }

    /// Returns the path of the spec in faults and exported commands.
    pub fn name(&self) -> &Path {
        self.file().unwrap_or(Path::new(UNSAVED))
    }

    /// Returns the folder of the state files and recordings that the spec names.
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
