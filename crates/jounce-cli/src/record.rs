//! Record of this call, which every table carries, so that `jounce rerun` can make it again.

use crate::arguments::Arguments;
use clap::CommandFactory;
use jounce::parts::{Record, RecordedInput, recorded_inputs};
use std::ffi::OsString;
use std::path::Path;
use std::sync::OnceLock;

/// Options that change no number of a table; with a value, except `--json`.
const WITHOUT_EFFECT: [&str; 4] = ["--out", "--threads", "--save-state", "--shard"];

/// Commands whose tables can be made again from their record.
pub const COMMANDS: [&str; 19] = [
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
    "run",
    "segments",
    "sensitivity",
    "spectra",
    "study",
    "sweep",
];

/// Arguments and input files of this call, as they were at its start.
static CALL: OnceLock<(Vec<String>, Vec<RecordedInput>)> = OnceLock::new();

/// Records a call that writes tables: input files are read before the computation, during which
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
    let is_out = |argument: &String| argument == "--out" || argument.starts_with("--out=");
    let command = arguments.first().map_or("", String::as_str);
    if arguments.iter().any(is_out) && COMMANDS.contains(&command) {
        let arguments = essential(&arguments);
        let inputs = recorded_inputs(&arguments);
        let _ = CALL.set((arguments, inputs));
    }
}

/// Returns the record of a table of this call; `None` for a call that is not recorded.
pub fn of_table(name: &str) -> Option<Record> {
    let (arguments, inputs) = CALL.get()?;
    Some(Record {
        arguments: arguments.clone(),
        table: name.to_owned(),
        inputs: inputs.clone(),
    })
}

/// Returns arguments without the options that change no number. `--to` of `read` writes a file: it
/// keeps the name without the folder.
pub fn essential(arguments: &[String]) -> Vec<String> {
    let reads = arguments.first().is_some_and(|command| command == "read");
    let mut essential: Vec<String> = Vec::new();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let (name, value) = match argument.split_once('=') {
            Some((name, value)) if name.starts_with("--") => (name, Some(value)),
            _ => (argument.as_str(), None),
        };
        if WITHOUT_EFFECT.contains(&name) {
            if value.is_none() {
                rest.next();
            }
        } else if reads && name == "--to" {
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
    }
}
