//! All errors of the arguments of a call. The parser stops at the first one, so each is repaired and
//! the arguments are parsed again.

use crate::value_error::{explained, with_tip};
use clap::builder::OsStringValueParser;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};
use std::ffi::OsString;

/// Paragraphs that the parser adds to an error.
const USAGE: &str = "Usage:";
const HINT: &str = "For more information, try '--help'.";

/// Returns one error with the texts of all errors of the arguments, of which `first` is the first.
pub fn complete(first: Error, command: &Command, arguments: &[OsString]) -> Error {
    let (mut lenient, mut repaired) = (command.clone(), arguments.to_vec());
    let mut errors: Vec<Error> = Vec::new();
    // An argument after an option that is not known may be its value.
    let mut has_unknown_option = false;
    let mut next = Some(first);
    while let Some(error) = next {
        let name = text_of(&error, ContextKind::InvalidArg).unwrap_or_default();
        let is_unknown = error.kind() == ErrorKind::UnknownArgument;
        let is_option = name.starts_with('-');
        let can_repeat = match error.kind() {
            ErrorKind::UnknownArgument => correct_name(&error, &name, &mut repaired),
            ErrorKind::InvalidValue | ErrorKind::ValueValidation => {
                accept_any_value(&mut lenient, &repaired[1..], &name)
            }
            _ => false,
        };
        if !(is_unknown && !is_option && has_unknown_option) {
            errors.push(explained(with_tip(error, command, arguments)));
        }
        has_unknown_option |= is_unknown && is_option;
        let parsed = can_repeat.then(|| lenient.clone().try_get_matches_from(&repaired));
        next = parsed.and_then(Result::err).filter(Error::use_stderr);
    }
    match errors.len() {
        1 => errors.remove(0),
        _ => joined(&errors),
    }
}

fn text_of(error: &Error, kind: ContextKind) -> Option<String> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        _ => None,
    }
}

/// Gives an argument that is not known its probable name, or removes it, also where that option is
/// given too; false where the argument is not found.
fn correct_name(error: &Error, name: &str, arguments: &mut Vec<OsString>) -> bool {
    let value_of = |argument: &OsString| {
        let text = argument.to_string_lossy().into_owned();
        let rest = text.strip_prefix(name)?.to_owned();
        let is_short = name.len() == 2 && name.starts_with('-');
        (is_short || rest.is_empty() || rest.starts_with('=')).then_some(rest)
    };
    let found = (0..arguments.len())
        .rev()
        .find_map(|index| Some((index, value_of(&arguments[index])?)));
    let Some((index, value)) = found.filter(|(index, _)| *index > 0) else {
        return false;
    };
    let is_given = |meant: &String| {
        let rest = |argument: &OsString| {
            let text = argument.to_string_lossy().into_owned();
            text.strip_prefix(meant.as_str()).map(str::to_owned)
        };
        let mut rests = arguments.iter().filter_map(rest);
        rests.any(|rest| rest.is_empty() || rest.starts_with('='))
    };
    let meant = text_of(error, ContextKind::SuggestedArg);
    match meant.filter(|meant| !is_given(meant)) {
        Some(meant) => arguments[index] = OsString::from(meant + &value),
        None => drop(arguments.remove(index)),
    }
    true
}

/// Lets an option of the called command take any value; false where it already does.
fn accept_any_value(command: &mut Command, arguments: &[OsString], name: &str) -> bool {
    let called = arguments.first().and_then(|first| {
        let inner = command.find_subcommand(first)?;
        Some(inner.get_name().to_owned())
    });
    if let Some(inner) = called.and_then(|inner| command.find_subcommand_mut(inner)) {
        return accept_any_value(inner, &arguments[1..], name);
    }
    let any = OsStringValueParser::new();
    let any_type = clap::builder::ValueParser::from(any).type_id();
    // `name` is that of an option with its value, as in `--threads <THREADS>`.
    let option = name.split([' ', '=', '[']).next().unwrap_or(name);
    let long = option.strip_prefix("--");
    let is_strict = |argument: &&clap::Arg| {
        let is_named = long.is_some() && argument.get_long() == long;
        is_named && argument.get_value_parser().type_id() != any_type
    };
    let Some(id) = (command.get_arguments().find(is_strict)).map(|found| found.get_id().clone())
    else {
        return false;
    };
    let lenient = std::mem::take(command).mut_arg(id, |argument| {
        argument.value_parser(OsStringValueParser::new())
    });
    *command = lenient;
    true
}

/// Returns one error with the texts of several, each paragraph once.
fn joined(errors: &[Error]) -> Error {
    let mut paragraphs: Vec<String> = Vec::new();
    for error in errors {
        let text = error.to_string();
        for paragraph in text.trim_end().split("\n\n") {
            let is_new = paragraphs.iter().all(|known| known != paragraph);
            if is_new && !paragraph.starts_with(USAGE) && paragraph != HINT {
                paragraphs.push(paragraph.to_owned());
            }
        }
    }
    let text = paragraphs.join("\n\n");
    // The error that is made of this text begins with this word.
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    Error::raw(ErrorKind::ValueValidation, format!("{text}\n\n{HINT}\n"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use clap::{Arg, value_parser};

    fn command() -> Command {
        let option = |name: &'static str| Arg::new(name).long(name);
        let arguments = [
            Arg::new("spec").required(true),
            option("over").required(true),
            option("threads").value_parser(value_parser!(u16).range(1..)),
            option("spread").value_parser(value_parser!(f64)),
            option("direction").value_parser(["up", "down"]),
        ];
        let part = Command::new("part").args(arguments.clone());
        let study = Command::new("study").subcommand(part);
        let sweep = Command::new("sweep").args(arguments);
        Command::new("jounce").subcommands([sweep, study])
    }

    fn errors_of(text: &str) -> String {
        let arguments: Vec<OsString> = text.split(' ').map(OsString::from).collect();
        let first = command().try_get_matches_from(&arguments).unwrap_err();
        complete(first, &command(), &arguments).to_string()
    }

    /// Number of errors, and texts that the message has.
    #[test]
    fn all_errors_are_reported_at_once() {
        for (arguments, count, expected) in [
            (
                "sweep a --over k=1 --bogus --wrong=2 --threads x --spread y --direction left",
                5,
                &["'--bogus'", "'--wrong'", "threads", "spread", "'left'"][..],
            ),
            (
                "study part a --over k=1 --threads 0 --threads-per 3 -q",
                3,
                &["0 is not in", "'--threads-per'", "'-q'"],
            ),
            ("sweep --bogus a", 2, &["'--bogus'", "--over <over>"]),
            // The misspelt option is the required one, and has its value.
            (
                "sweep a --ovr k=1 --spread y",
                2,
                &["a similar argument exists: '--over'", "--spread is y"],
            ),
            // Which of two arguments is the value of the unknown option is not known.
            ("sweep a --over k=1 --bogus 3", 1, &["'--bogus'"]),
            ("sweep a sweep --over k=1 --spread y", 2, &["'sweep'"]),
            ("sweep a --over k=1 --spread", 1, &["a value is required"]),
        ] {
            let text = errors_of(&format!("jounce {arguments}"));
            assert_eq!(text.matches("error: ").count(), count, "{text}");
            for part in expected {
                assert!(text.contains(part), "{part}: {text}");
            }
        }
    }

    #[test]
    fn help_is_no_error() {
        let text = errors_of("jounce sweep --bogus --help");
        assert_eq!(text.matches("error: ").count(), 1, "{text}");
    }
}
