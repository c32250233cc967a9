//! The command line of jounce: arguments in, library calls, answers out. It computes nothing itself.

mod arguments;
mod cache;
mod commands;
mod decay_arguments;
mod failure;
mod hammer_arguments;
mod measured_file;
mod output;
mod progress;
mod spec_arguments;
mod threads;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = arguments::Arguments::parse();
    let json = arguments.command.wants_json();
    match commands::run(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(json),
    }
}
