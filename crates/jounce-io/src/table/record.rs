//! Record of the command that made a table: all that is needed to make it again.

use serde::{Deserialize, Serialize};

/// Command of a table, with its input files. Like the manifest it contains no time and no machine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Arguments of the program, without those that change no number: `--out`, `--json`,
    /// `--threads`, `--shard`, `--save-state`.
    pub arguments: Vec<String>,
    /// Name of the table among those of the command, which is the name of its first file without
    /// the extension.
    pub table: String,
    /// Input files: those that the arguments name, and those that these files name.
    pub inputs: Vec<RecordedInput>,
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
