//! Messages about values of options that are not numbers, and about keys of the spec given as options.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::error::Error;
use std::num::{IntErrorKind, ParseFloatError, ParseIntError};

/// Returns the error with a tip about `--set` where the command has this option and another one is
/// not known: it may be a key of the spec. Other errors are unchanged.
pub fn with_set_tip(mut error: clap::Error, command: &clap::Command, name: &str) -> clap::Error {
    let subcommand = command.find_subcommand(name);
    let mut options = subcommand
        .into_iter()
        .flat_map(clap::Command::get_arguments);
    let has_set = options.any(|option| option.get_long() == Some("set"));
    let is_similar = error.get(ContextKind::SuggestedArg).is_some();
    let Some(ContextValue::String(option)) = error.get(ContextKind::InvalidArg) else {
        return error;
    };
    if error.kind() == ErrorKind::UnknownArgument && has_set && !is_similar {
        let key = option.trim_start_matches('-');
        let tip = format!(
            "to set a key of the spec, write --set TABLE.{key}=VALUE, as in --set stop.tip.gap=\"0.5 mm\""
        );
        error.insert(
            ContextKind::Suggested,
            ContextValue::StyledStrs(vec![tip.into()]),
        );
    }
    error
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

    /// A command without `--set` keeps the message of clap, and so does an option that is only
    /// misspelt.
    #[test]
    fn a_key_given_as_an_option_leads_to_set() {
        let option = |name: &'static str| Arg::new(name).long(name);
        let command = Command::new("jounce")
            .subcommand(Command::new("run").args([option("set"), option("tolerance")]))
            .subcommand(Command::new("materials"));
        for (name, wrong, is_led) in [
            ("run", "--gap", true),
            ("run", "--tolerence", false),
            ("materials", "--gap", false),
        ] {
            let result = command
                .clone()
                .try_get_matches_from(["jounce", name, wrong]);
            let text = with_set_tip(result.unwrap_err(), &command, name).to_string();
            assert_eq!(text.contains("--set TABLE.gap=VALUE"), is_led, "{text}");
        }
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
