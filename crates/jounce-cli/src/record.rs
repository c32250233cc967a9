//! Record of this call, which every file of results carries, so that `jounce rerun` can make it again.

use crate::arguments::Arguments;
use clap::CommandFactory;
use jounce::parts::{Record, RecordedInput, recorded_inputs};
use std::ffi::OsString;
use std::path::Path;
use std::sync::OnceLock;

/// Options with a value that change no result.
const WITHOUT_EFFECT: [&str; 4] = ["--out", "--threads", "--save-state", "--shard"];

/// Commands whose files can be made again from their record.
pub const COMMANDS: [&str; 22] = [
    "basins",
    "bifurcations",
    "branch",
    "contact",
    "design",
    "diagram",
    "ensemble",
    "fit",
    "frf",
    "modes",
    "noise",
    "power",
    "read",
    "reproduce",
    "rig",
    "run",
    "segments",
    "sensitivity",
    "show",
    "spectra",
    "study",
    "sweep",
];

/// Where a command writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// Files in the folder of `--out`.
    Folder,
    /// One file, whose path this option gives.
    File(&'static str),
}

impl Destination {
    /// Returns the destination of a command.
    pub fn of(command: &str) -> Self {
        match command {
            "rig" => Self::File("--to"),
            "show" => Self::File("--out"),
            _ => Self::Folder,
        }
    }

    /// Returns the option that gives the folder or the file.
    pub fn option(self) -> &'static str {
        match self {
            Self::Folder => "--out",
            Self::File(option) => option,
        }
    }
}

/// Folder of the recording that `read --to` writes, when the command runs again.
pub const CONVERTED: &str = "to";

/// Arguments and input files of this call, as they were at its start.
static CALL: OnceLock<(Vec<String>, Vec<RecordedInput>)> = OnceLock::new();

/// Records a call that writes results: input files are read before the computation, during which
/// they may change. A call with arguments that are not text has no record.
pub fn begin(arguments: impl IntoIterator<Item = OsString>) {
    let texts = arguments.into_iter().map(OsString::into_string);
    let Ok(mut arguments) = texts.collect::<Result<Vec<String>, _>>() else {
        return;
    };
    // An alias is recorded under the name of its command.
    let program = Arguments::command();
    if let Some(first) = arguments.first_mut()
        && let Some(command) = program.find_subcommand(&*first)
    {
        command.get_name().clone_into(first);
    }
    let writes = |argument: &String| {
        let name = argument
            .split_once('=')
            .map_or(&**argument, |(name, _)| name);
        name == "--out" || name == "--to"
    };
    let command = arguments.first().map_or("", String::as_str);
    let writes = command == "show" || arguments.iter().any(writes);
    if writes && COMMANDS.contains(&command) {
        let arguments = essential(&arguments);
        let inputs = recorded_inputs(&arguments);
        let _ = CALL.set((arguments, inputs));
    }
}

/// Returns the record of a file of this call, by its name without extension; `None` for a call that
/// is not recorded.
pub fn of_file(name: &str) -> Option<Record> {
    let (arguments, inputs) = CALL.get()?;
    Some(Record {
        arguments: arguments.clone(),
        table: name.to_owned(),
        inputs: inputs.clone(),
    })
}

/// Returns the record of a file of this call, by its path.
pub fn of_path(path: &Path) -> Option<Record> {
    of_file(&path.file_stem()?.to_string_lossy())
}

/// Returns the record of the recording that `read --to` writes. Its name has a folder, so that it
/// differs from the tables of the command.
pub fn of_converted(path: &Path) -> Option<Record> {
    let stem = path.file_stem()?.to_string_lossy();
    of_file(&format!("{CONVERTED}/{stem}"))
}

/// Returns arguments without the options that change no result. `--to` of `read` writes a file: it
/// keeps the name without the folder.
pub fn essential(arguments: &[String]) -> Vec<String> {
    let command = arguments.first().map_or("", String::as_str);
    let destination = Destination::of(command).option();
    let mut essential: Vec<String> = Vec::new();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let (name, value) = match argument.split_once('=') {
            Some((name, value)) if name.starts_with("--") => (name, Some(value)),
            _ => (argument.as_str(), None),
        };
        if name == destination || WITHOUT_EFFECT.contains(&name) {
            if value.is_none() {
                rest.next();
            }
        } else if command == "read" && name == "--to" {
            let path = value.or_else(|| rest.next().map(String::as_str));
            essential.push(name.to_owned());
            essential.extend(path.map(file_name));
        } else if argument != "--json" {
            essential.push(argument.clone());
        }
    }
    essential
}

fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name();
    name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> String {
        let arguments: Vec<String> = text.split(' ').map(str::to_owned).collect();
        essential(&arguments).join(" ")
    }

    #[test]
    fn options_without_effect_are_not_recorded() {
        assert_eq!(
            of("sweep a.toml --over k=1:2 --out x --json --threads 2"),
            "sweep a.toml --over k=1:2"
        );
        assert_eq!(
            of("run a.toml --out=x --save-state=/tmp/s.json --set run.duration=1"),
            "run a.toml --set run.duration=1"
        );
        assert_eq!(
            of("study run a.toml --shard 1/2 --out x"),
            "study run a.toml"
        );
        assert_eq!(
            of("read a.csv --to /home/b.uff --out x"),
            "read a.csv --to b.uff"
        );
        assert_eq!(
            of("fit a.toml --to /home/f.toml --out x"),
            "fit a.toml --to /home/f.toml"
        );
        assert_eq!(
            of("rig a.toml --to /home/b.csv --seed 2"),
            "rig a.toml --seed 2"
        );
    }
}
