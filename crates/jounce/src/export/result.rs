//! Result of an export.

use serde::Serialize;
use std::path::PathBuf;

/// Files of an exported model, and what they name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ExportResult {
    /// Written files.
    pub files: Vec<PathBuf>,
    /// Number of modes.
    pub modes: usize,
    /// Names of the points.
    pub points: Vec<String>,
    /// Names of the electrodes, one per patch.
    pub electrodes: Vec<String>,
}
