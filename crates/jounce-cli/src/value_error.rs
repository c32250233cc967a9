//! Messages about values of options that are not numbers, and about keys of the spec given as options.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::error::Error;
use std::ffi::OsString;
use std::num::{IntErrorKind, ParseFloatError, ParseIntError};

/// Returns the arguments with each negative value joined to the option before it, `--gap=-1mm`, so
/// that the option itself can refuse it by name. No option begins with a digit.
pub fn with_joined_values(arguments: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    for argument in arguments {
        let option = joined.last_mut().filter(|last| {
            let last = last.to_string_lossy();
            last.len() > 2 && last.starts_with("--") && !last.contains('=')
        });
        match option {
            Some(option) if is_negative(&argument.to_string_lossy()) => {
                option.push("=");
                option.push(argument);
            }
            _ => joined.push(argument),
        }
    }
    joined
}

/// True for a minus followed by a number.
fn is_negative(text: &str) -> bool {
    let number = text.strip_prefix('-');
    let first = number.and_then(|number| number.chars().next());
    first.is_some_and(|first| first.is_ascii_digit() || first == '.')
}

/// Returns the error with a tip where an argument is not known: what to write for a key of the spec,
/// a second file, a short option, or the options of the command. Other errors are unchanged.
pub fn with_tip(
    mut error: clap::Error,
    command: &clap::Command,
    arguments: &[OsString],
) -> clap::Error {
    let Some(ContextValue::String(argument)) = error.get(ContextKind::InvalidArg) else {
        return error;
    };
    let (command, name) = called(command, arguments);
    let has = |name: &str| {
        let mut options = command.get_arguments();
        options.any(|option| option.get_long() == Some(name))
    };
    let is_similar = error.get(ContextKind::SuggestedArg).is_some();
    let tip = match argument.strip_prefix("--") {
        _ if error.kind() != ErrorKind::UnknownArgument => return error,
        Some("set") => Some(format!(
            "`{name}` has no --set; write the keys in its file, or in the spec"
        )),
        Some(_) if is_similar => None,
        Some(key) if key.contains('.') && has("set") => Some(set_tip(key)),
        Some(_) => Some(format!("`{name}` has {}", options(command, ""))),
        None if argument.starts_with('-') => Some(format!("`{name}` has {}", short(command, argument))),
        None if argument.starts_with('=') || argument.ends_with('=') => Some(
            "write KEY=VALUE as one argument, without blanks around =, as in --set stop.tip.gap=\"0.5 mm\""
                .to_owned(),
        ),
        None if argument.contains('=') && has("set") => Some(set_tip(argument)),
        None => Some(positional_tip(command, &name, argument)),
    };
    if let Some(tip) = tip {
        error.remove(ContextKind::SuggestedArg);
        error.insert(
            ContextKind::Suggested,
            ContextValue::StyledStrs(vec![tip.into()]),
        );
    }
    error
}

/// Returns the command that the arguments call and its name, as in `jounce study run`.
fn called<'c>(command: &'c clap::Command, arguments: &[OsString]) -> (&'c clap::Command, String) {
    let mut called = (command, "jounce".to_owned());
    for argument in arguments.iter().skip(1) {
        let Some(inner) = called.0.find_subcommand(argument) else {
            break;
        };
        called = (inner, format!("{} {}", called.1, inner.get_name()));
    }
    called
}

/// States how a key of the spec is set.
fn set_tip(assignment: &str) -> String {
    let key = assignment.split('=').next().unwrap_or(assignment);
    format!(
        "to set a key of the spec, write --set {key}=VALUE, as in --set stop.tip.gap=\"0.5 mm\""
    )
}

/// Lists the options of a command whose names begin with a text.
fn options(command: &clap::Command, start: &str) -> String {
    let names = command.get_arguments().filter_map(clap::Arg::get_long);
    let names = names.filter(|name| name.starts_with(start));
    let names: Vec<String> = names.map(|name| format!("--{name}")).collect();
    match names.len() {
        0 => "no options".to_owned(),
        _ => names.join(", "),
    }
}

/// Lists the options with the letter of a short option, else all.
fn short(command: &clap::Command, argument: &str) -> String {
    let letter = argument.trim_start_matches('-').chars().next();
    let start = letter.map(String::from).unwrap_or_default();
    let names = options(command, &start);
    match names.as_str() {
        "no options" => options(command, ""),
        _ => names,
    }
}

/// States how many files or folders a command takes.
fn positional_tip(command: &clap::Command, name: &str, argument: &str) -> String {
    let taken = command.get_positionals();
    let taken: Vec<String> = taken
        .map(|one| one.get_id().as_str().to_uppercase())
        .collect();
    match taken.len() {
        0 => format!("`{name}` takes only options: {}", options(command, "")),
        1 => format!(
            "`{name}` takes one {}; give {argument} in a call of its own",
            taken[0]
        ),
        _ => format!("`{name}` takes {}, and no more", taken.join(" ")),
    }
}

/// Returns the error with the option, its value and the allowed values, where a value is not a
/// number; other errors are unchanged.
pub fn explained(error: clap::Error) -> clap::Error {
    let context = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text),
        _ => None,
    };
    let (Some(argument), Some(value), Some(allowed)) = (
        context(ContextKind::InvalidArg),
        context(ContextKind::InvalidValue),
        error.source().and_then(allowed),
    ) else {
        return error;
    };
    // The name of the argument without that of its value: `--starts <STARTS>`.
    let option = argument.split(' ').next().unwrap_or(argument);
    let text = format!("{option} is {value}; it must be {allowed}\n");
    clap::Error::raw(ErrorKind::ValueValidation, text)
}

/// Returns the values that the parser of a number allows.
fn allowed(reason: &(dyn Error + 'static)) -> Option<&'static str> {
    if reason.is::<ParseFloatError>() {
        return Some("a number, as in 0.5 or 1e-8");
    }
    match reason.downcast_ref::<ParseIntError>()?.kind() {
        IntErrorKind::PosOverflow => Some("smaller: it exceeds the largest integer"),
        _ => Some("a whole number, 0 or greater, as in 12"),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use clap::{Arg, Command, value_parser};

    /// Tips name what the command takes; `--set` stands only where a key of the spec is given.
    #[test]
    fn an_unknown_argument_gets_a_tip_that_fits() {
        let option = |name: &'static str| Arg::new(name).long(name);
        let run = Command::new("run").args([option("set"), option("out"), Arg::new("spec")]);
        let study = Command::new("study").subcommand(Command::new("run").arg(option("out")));
        let command = Command::new("jounce").subcommands([run, study]);
        for (arguments, expected) in [
            (&["run", "--stop.tip.gap"][..], "--set stop.tip.gap=VALUE"),
            (
                &["run", "a", "stop.tip.gap=1mm"],
                "--set stop.tip.gap=VALUE",
            ),
            (
                &["run", "a", "b.toml"],
                "takes one SPEC; give b.toml in a call of its own",
            ),
            (&["run", "a", "="], "without blanks around ="),
            (&["run", "--threads", "2"], "`jounce run` has --set, --out"),
            (&["run", "-o", "x"], "`jounce run` has --out"),
            (&["run", "--ouf", "x"], "'--out'"),
            (
                &["study", "run", "--set", "a=1"],
                "`jounce study run` has no --set",
            ),
        ] {
            let arguments: Vec<OsString> = (["jounce"].iter().chain(arguments))
                .map(OsString::from)
                .collect();
            let result = command.clone().try_get_matches_from(&arguments);
            let text = with_tip(result.unwrap_err(), &command, &arguments).to_string();
            assert!(text.contains(expected), "{arguments:?}: {text}");
        }
    }

    #[test]
    fn negative_values_are_joined_to_their_option() {
        let join = |arguments: &[&str]| {
            let joined = with_joined_values(arguments.iter().map(OsString::from));
            joined
                .into_iter()
                .map(|one| one.into_string().unwrap())
                .collect::<Vec<_>>()
                .join("|")
        };
        assert_eq!(
            join(&["power", "--resistance", "-5ohm", "a"]),
            "power|--resistance=-5ohm|a"
        );
        assert_eq!(
            join(&["--a=1", "-.5", "--b", "--c", "-o"]),
            "--a=1|-.5|--b|--c|-o"
        );
    }

    #[test]
    fn a_value_that_is_no_number_is_explained() {
        let command = Command::new("jounce")
            .arg(
                Arg::new("starts")
                    .long("starts")
                    .value_parser(value_parser!(usize)),
            )
            .arg(
                Arg::new("spread")
                    .long("spread")
                    .value_parser(value_parser!(f64)),
            );
        for (option, value, expected) in [
            ("--starts", "x", "--starts is x; it must be a whole number"),
            (
                "--starts",
                "1.5",
                "--starts is 1.5; it must be a whole number",
            ),
            ("--starts", "99999999999999999999", "it must be smaller"),
            (
                "--spread",
                "wide",
                "--spread is wide; it must be a number, as in 0.5",
            ),
        ] {
            let result = command
                .clone()
                .try_get_matches_from(["jounce", option, value]);
            let text = explained(result.unwrap_err()).to_string();
            assert!(text.contains(expected), "{text}");
        }
    }
}
