//! `jounce show SPEC`

use crate::failure::Failure;
use crate::output::{line, origin};
use crate::record;
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce::Error;
use std::path::{Path, PathBuf};

/// Arguments of `show`.
#[derive(Debug, Args)]
pub struct Show {
    #[command(flatten)]
    spec: SpecArguments,
    /// File of the drawing: a name that ends in .svg, .png or .pdf; its folder is created if missing,
    /// an existing file is replaced. By default the name of the spec with .svg, in the current folder.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl Show {
    /// Draws the harvester and prints the name of the file.
    pub fn run(&self) -> Result<(), Failure> {
        let harvester = self.spec.harvester()?;
        let stem = self.spec.spec.file_stem().unwrap_or_default();
        let path = self
            .out
            .clone()
            .unwrap_or_else(|| Path::new(stem).with_extension("svg"));
        let drawing = harvester.drawing(&self.title());
        let manifest = origin(record::of_path(&path));
        drawing.write_with(&path, &manifest).map_err(Error::from)?;
        match self.json {
            true => line(serde_json::json!({ "drawing": path })),
            false => line(path.display()),
        }
        Ok(())
    }

    /// Returns the name of the spec, preceded by the name of its folder where the path contains
    /// one.
    fn title(&self) -> String {
        let path = &self.spec.spec;
        let folder = path.parent().and_then(Path::file_name);
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        folder.map_or_else(
            || stem.to_string(),
            |folder| format!("{}, {stem}", folder.to_string_lossy()),
        )
    }
}
