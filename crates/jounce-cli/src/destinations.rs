//! Test before a command that the files and folders of its results can be written.

use crate::failure::Failure;
use clap::{ArgMatches, Command};
use jounce::Error;
use jounce::parts::{check_file, check_folder};
use std::path::PathBuf;

/// Options that name a file or a folder to write, where their value is one.
const OUTPUTS: [&str; 5] = ["out", "to", "save_state", "matrices", "spice"];

/// Checks the files and folders that a call writes. A later failure would lose the result.
///
/// # Errors
/// One of them cannot be written.
pub fn check(command: &Command, matches: &ArgMatches) -> Result<(), Failure> {
    if let Some((name, matches)) = matches.subcommand()
        && let Some(command) = command.find_subcommand(name)
    {
        return check(command, matches);
    }
    for argument in command.get_arguments() {
        let id = argument.get_id().as_str();
        let path = OUTPUTS
            .contains(&id)
            .then(|| matches.try_get_one::<PathBuf>(id));
        let Some(Ok(Some(path))) = path else {
            continue;
        };
        let kind = argument.get_value_names().and_then(<[_]>::first);
        let checked = match kind.map(|kind| kind.as_str()) {
            Some("FILE") => check_file(path),
            Some("DIR" | "FOLDER") => check_folder(path),
            _ => Ok(()),
        };
        checked.map_err(Error::from)?;
    }
    Ok(())
}
