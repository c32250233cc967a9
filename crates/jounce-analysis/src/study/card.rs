//! `study.json`, which identifies the study of a folder.

use super::StudyError;
use jounce_io::store;
use jounce_io::table::Record;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Name of the file.
const CARD_FILE: &str = "study.json";

/// Content of the file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct StudyCard {
    pub created_by: String,
    pub version: String,
    pub study_sha256: String,
    pub command: String,
    pub points: usize,
    pub parts: usize,
    /// Command that makes the table again; `None` where no command began the study.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<Record>,
}

impl StudyCard {
    /// Reads the card of a folder.
    ///
    /// # Errors
    /// A folder without a study; a damaged file.
    pub fn read(folder: &Path) -> Result<Self, StudyError> {
        let path = folder.join(CARD_FILE);
        let text = std::fs::read_to_string(&path).map_err(|_| StudyError::NoStudy {
            folder: folder.to_owned(),
        })?;
        serde_json::from_str(&text).map_err(|_| StudyError::Damaged {
            path,
            reason: "it is no card of a study".to_owned(),
        })
    }

    /// Writes the card into a folder.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default() + "\n";
        Ok(store::write_in_folder(
            &folder.join(CARD_FILE),
            text.as_bytes(),
        )?)
    }

    /// True where both cards are of one study, whichever command began it.
    pub fn is_of(&self, other: &Self) -> bool {
        let without_record = Self {
            record: other.record.clone(),
            ..self.clone()
        };
        without_record == *other
    }
}
