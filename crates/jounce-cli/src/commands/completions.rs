//! `jounce completions SHELL`

use crate::arguments::Arguments;
use crate::failure::Failure;
use clap::{Args, CommandFactory};

/// Arguments of `completions`.
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell.
    shell: clap_complete::Shell,
}

impl Completions {
    /// Prints the completion script.
    pub fn run(&self) -> Result<(), Failure> {
        clap_complete::generate(
            self.shell,
            &mut Arguments::command(),
            "jounce",
            &mut std::io::stdout(),
        );
        Ok(())
    }
}
