//! The command line of jounce: arguments in, library calls, answers out. It computes nothing itself.

mod arguments;
mod cache;
mod commands;
mod decay_arguments;
mod failure;
mod hammer_arguments;
mod interruption;
mod level_arguments;
mod limit_warnings;
mod measured_file;
mod output;
mod progress;
mod spec_arguments;
mod threads;

use clap::{CommandFactory, FromArgMatches};
use mimalloc::MiMalloc;
use std::process::ExitCode;

/// Branches make and drop many small matrices: a quarter of their time went into the system's allocator.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    // A negative number is a value, which its option may refuse by name, and no option of its own.
    let command = arguments::Arguments::command()
        .mut_subcommands(|command| command.allow_negative_numbers(true));
    let arguments = arguments::Arguments::from_arg_matches(&command.get_matches())
        .unwrap_or_else(|error| error.exit());
    let json = arguments.command.wants_json();
    match commands::run(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(json),
    }
}
