//! Messages about values of options that are not numbers.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::error::Error;
use std::num::{IntErrorKind, ParseFloatError, ParseIntError};

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
