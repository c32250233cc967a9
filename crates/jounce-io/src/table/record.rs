//! Record of the command that made a file of results: all that is needed to make it again.

use serde::{Deserialize, Serialize};

/// Command of a file of results, with its input files. Like the manifest it contains no time and no
/// machine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Arguments of the program, without those that change no number: `--out`, `--json`,
    /// `--threads`, `--shard`, `--save-state`.
    pub arguments: Vec<String>,
    /// Name of the table or the picture among those of the command, which is the name of its file
    /// without the extension; with its folder where the command writes into several.
    pub table: String,
    /// Input files: those that the arguments name, and those that these files name.
    pub inputs: Vec<RecordedInput>,
}

impl Record {
    /// Returns the name of the command.
    pub fn command(&self) -> &str {
        self.arguments.first().map_or("", String::as_str)
    }
}

/// Input file of a command.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordedInput {
    /// Path as given, relative to the folder in which the command ran.
    pub path: String,
    /// SHA-256 of the bytes of the file, in hexadecimal.
    pub sha256: String,
    /// Contents of a TOML file; `None` for other files, such as recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
}
