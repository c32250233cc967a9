//! Temporary folder with the input files of a record, in which the command runs again.
//!
//! The folder repeats the paths of the files from the root of the file system, so that relative
//! paths in arguments and specs hold. Texts come from the record; other files are copied if their
//! bytes are those of the record.

use crate::failure::Failure;
use crate::record::{CONVERTED, Destination, essential};
use jounce::parts::{Record, RecordedInput, file_sha256, system_reason, text_sha256};
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};

/// Exit codes of a command that wrote its tables: success, and no convergence.
const WITH_TABLES: [i32; 2] = [0, 3];

/// Exit code of a stopped command.
const INTERRUPTED: i32 = 130;

/// A temporary folder, removed when it is dropped.
pub struct Mirror {
    folder: tempfile::TempDir,
    /// Current folder of the command, an absolute path.
    current: PathBuf,
}

impl Mirror {
    /// Creates the folder and its input files.
    ///
    /// # Errors
    /// All recordings that are missing or have changed; a folder that cannot be written.
    pub fn new(record: &Record) -> Result<Self, Failure> {
        let unwritable = |error: std::io::Error| {
            Failure::Input(format!("temporary folder: {}", system_reason(&error)))
        };
        let mirror = Self {
            folder: tempfile::tempdir().map_err(unwritable)?,
            current: std::env::current_dir().map_err(unwritable)?,
        };
        let faults: Vec<String> = record.inputs.iter().filter_map(fault).collect();
        if !faults.is_empty() {
            return Err(Failure::Input(faults.join("\n")));
        }
        std::fs::create_dir_all(mirror.inside(Path::new(""))).map_err(unwritable)?;
        for input in &record.inputs {
            mirror.place(input).map_err(unwritable)?;
        }
        Ok(mirror)
    }

    /// Returns the path of a file of results; `name` may contain a folder.
    pub fn file(&self, name: &str, extension: &str) -> PathBuf {
        self.out().join(format!("{name}.{extension}"))
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// Returns the path in the temporary folder of a path relative to the current folder.
    fn inside(&self, path: &Path) -> PathBuf {
        let mut inside = PathBuf::new();
        for component in self.current.join(path).components() {
            match component {
                Component::Normal(name) => inside.push(name),
                Component::ParentDir => {
                    inside.pop();
                }
                Component::CurDir | Component::Prefix(_) | Component::RootDir => {}
            }
        }
        self.folder.path().join("files").join(inside)
    }

    fn place(&self, input: &RecordedInput) -> std::io::Result<()> {
        let path = self.inside(Path::new(&input.path));
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        match &input.text {
            Some(text) => std::fs::write(path, text),
            None => std::fs::copy(&input.path, path).map(|_| ()),
        }
    }

    /// Runs the command, which writes a file with an extension; its messages go to stderr.
    pub fn run(&self, record: &Record, extension: &str) -> Result<(), Failure> {
        let failed = |text: String| Failure::Input(format!("the command cannot run again: {text}"));
        let program = std::env::current_exe().map_err(|error| failed(error.to_string()))?;
        let destination = Destination::of(record.command());
        let out = match destination {
            Destination::Folder => self.out(),
            Destination::File(_) => self.file(&record.table, extension),
        };
        std::fs::create_dir_all(self.out().join(CONVERTED))
            .map_err(|error| failed(error.to_string()))?;
        let status = Command::new(program)
            .args(self.arguments(record))
            .arg(destination.option())
            .arg(out)
            .current_dir(self.inside(Path::new("")))
            // Finished points of an earlier call would be read, not computed.
            .env("JOUNCE_CACHE", self.folder.path().join("cache"))
            .stdout(Stdio::null())
            .status()
            .map_err(|error| failed(error.to_string()))?;
        match status.code() {
            Some(code) if WITH_TABLES.contains(&code) => Ok(()),
            Some(INTERRUPTED) | None => Err(Failure::Interrupted("stopped".to_owned())),
            Some(code) => Err(failed(format!("it ended with exit code {code}, see above"))),
        }
    }

    /// Returns the arguments of the command in the folder. `--to` of `read` has its own folder, so
    /// that the recording differs from the tables.
    fn arguments(&self, record: &Record) -> Vec<String> {
        let arguments = essential(&record.arguments).into_iter();
        let mut arguments: Vec<String> = arguments
            .map(|argument| self.argument(&argument, record))
            .collect();
        let to = arguments.iter().position(|argument| argument == "--to");
        if record.command() == "read"
            && let Some(name) = to.and_then(|to| arguments.get_mut(to + 1))
        {
            let path = self.out().join(CONVERTED).join(&*name);
            *name = path.to_string_lossy().into_owned();
        }
        arguments
    }

    /// Returns an argument with the absolute path of a text replaced by its path in the folder.
    fn argument(&self, argument: &str, record: &Record) -> String {
        let (before, value) = match argument.split_once('=') {
            Some((before, value)) if before.starts_with("--") => (format!("{before}="), value),
            _ => (String::new(), argument),
        };
        let is_absolute = Path::new(value).is_absolute();
        match record.inputs.iter().any(|input| input.path == value) && is_absolute {
            true => format!("{before}{}", self.inside(Path::new(value)).display()),
            false => argument.to_owned(),
        }
    }
}

/// Returns the fault of an input: a recording that is missing or has changed, or a text that is not
/// that of its checksum.
fn fault(input: &RecordedInput) -> Option<String> {
    let path = &input.path;
    if let Some(text) = &input.text {
        let changed =
            || format!("{path}: the text in the record was changed by hand: its SHA-256 differs");
        return (text_sha256(text) != input.sha256).then(changed);
    }
    match file_sha256(Path::new(path)) {
        Ok(sha256) if sha256 == input.sha256 => None,
        Ok(_) => Some(format!(
            "{path}: the file has changed since the result was computed: its SHA-256 differs"
        )),
        Err(error) => Some(format!(
            "{path}: {error}; run in the folder in which the command ran, which held this file"
        )),
    }
}
