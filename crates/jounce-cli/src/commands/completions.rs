//! `jounce completions SHELL`

use crate::arguments::Arguments;
use crate::failure::Failure;
use crate::output::text;
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
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::command(), "jounce", &mut script);
        text(&String::from_utf8_lossy(&script));
        Ok(())
    }
}
