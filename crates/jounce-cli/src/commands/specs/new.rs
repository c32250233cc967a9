//! `jounce new [KIND]`

use crate::failure::Failure;
use crate::output::{line, text};
use clap::Args;
use jounce::{Error, starters};
use std::path::PathBuf;

/// Arguments of `new`.
#[derive(Debug, Args)]
pub struct New {
    /// Kind of harvester; without it, the kinds are listed.
    #[arg(value_name = "KIND")]
    kind: Option<String>,
    /// Writes the spec into this file, which must not exist yet; by default it goes to stdout.
    #[arg(long, value_name = "FILE", requires = "kind")]
    out: Option<PathBuf>,
    /// Replaces an existing file.
    #[arg(long, requires = "out")]
    force: bool,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl New {
    /// Lists the kinds, or writes the spec of one.
    pub fn run(&self) -> Result<(), Failure> {
        let Some(kind) = &self.kind else {
            self.list();
            return Ok(());
        };
        let starter = jounce::starter(kind)?;
        match &self.out {
            Some(path) => {
                if !self.force && path.symlink_metadata().is_ok() {
                    let message = format!(
                        "{} already exists; choose another name, or replace it with --force",
                        path.display()
                    );
                    return Err(Failure::Input(message));
                }
                starter.write(path, self.force).map_err(Error::from)?;
                match self.json {
                    true => line(serde_json::json!({ "kind": starter.kind, "file": path })),
                    false => line(path.display()),
                }
            }
            None if self.json => line(serde_json::json!(starter)),
            None => text(starter.spec),
        }
        Ok(())
    }

    fn list(&self) {
        if self.json {
            let kind = |starter: &jounce::parts::Starter| serde_json::json!({ "kind": starter.kind, "summary": starter.summary });
            let kinds: Vec<_> = starters().iter().map(kind).collect();
            line(serde_json::json!({ "kinds": kinds }));
            return;
        }
        let width = starters()
            .iter()
            .map(|starter| starter.kind.len())
            .max()
            .unwrap_or(0);
        starters()
            .iter()
            .for_each(|starter| line(format!("{:width$}  {}", starter.kind, starter.summary)));
    }
}
