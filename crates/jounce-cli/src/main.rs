//! The command line of jounce: it reads arguments, calls the library and prints results. It
//! computes nothing itself.
#![deny(
    clippy::print_stderr,
    reason = "a full disk behind stderr would end the program"
)]

mod arguments;
mod cache;
mod commands;
mod destinations;
mod failure;
mod hammer_arguments;
mod interruption;
mod measured_file;
mod model_or_measured;
mod option_names;
mod output;
mod progress;
mod record;
mod spec_arguments;
mod usage_errors;
mod value_error;

use clap::{ArgMatches, CommandFactory, FromArgMatches};
use jounce_allocator as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    // A negative number is a value, not an option, so that the option can refuse it by name.
    let command = arguments::Arguments::command()
        .mut_subcommands(|command| command.allow_negative_numbers(true));
    let given = value_error::with_joined_values(std::env::args_os());
    let read = |matches: ArgMatches| {
        arguments::Arguments::from_arg_matches(&matches).map(|arguments| (arguments, matches))
    };
    let (arguments, matches) = (command.clone().try_get_matches_from(&given))
        .and_then(read)
        .unwrap_or_else(|error| usage_errors::complete(error, &command, &given).exit());
    record::begin(std::env::args_os().skip(1));
    let json = arguments.command.wants_json();
    let work = || {
        destinations::check(&command, &matches)?;
        commands::run(arguments.command)?;
        output::check_printed()
    };
    match work() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(json),
    }
}
