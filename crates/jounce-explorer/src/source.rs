//! Source of the spec of a page.

use jounce::{Error, Harvester};
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
    /// The file cannot be read, or the spec has faults.
    pub fn read(&self) -> Result<Harvester, Error> {
        match self {
            Self::File(path) => Harvester::read(path),
            Self::Text { text, folder } => Harvester::from_text(text, folder),
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
}
