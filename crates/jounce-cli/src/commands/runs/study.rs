//! `jounce study run|merge|status|page`

use crate::failure::{Failure, of_file};
use crate::interruption;
use crate::output::{self, line};
use crate::progress;
use crate::record;
use crate::spec_arguments::print_recording_issues;
use clap::{Args, Subcommand};
use jounce::parts::{StudyStatus, write_file};
use jounce::{Control, Error, StudyFolder, StudyOptions};
use jounce_explorer::study_page;
use std::path::{Path, PathBuf};

/// Arguments of `study`.
#[derive(Debug, Args)]
pub struct Study {
    #[command(subcommand)]
    action: Action,
}

/// Action on a study.
#[derive(Debug, Subcommand)]
enum Action {
    /// Computes the unfinished parts, and merges the table when all are finished.
    Run(Run),
    /// Joins all parts into one table, study.parquet.
    Merge(Existing),
    /// Reports the progress of a study.
    Status(Existing),
    /// Writes the table with charts as one HTML file, which needs no server and no net.
    Page(Page),
}

/// Arguments of `study run`.
#[derive(Debug, Args)]
struct Run {
    /// Study file (TOML): a spec, the keys to vary, the quantity to compute.
    study: PathBuf,
    /// Folder of the parts and the table.
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    #[command(flatten)]
    options: StudyOptions,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

/// Arguments of `study merge` and `study status`.
#[derive(Debug, Args)]
struct Existing {
    /// Folder of the study.
    folder: PathBuf,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

/// Arguments of `study page`.
#[derive(Debug, Args)]
struct Page {
    #[command(flatten)]
    study: Existing,
    /// File of the page: a name that ends in .html; its folder is created if missing, an existing file
    /// is replaced. By default the name of the folder with .html, in the current folder.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Study {
    /// True where the result is printed as JSON.
    pub fn wants_json(&self) -> bool {
        match &self.action {
            Action::Run(run) => run.json,
            Action::Merge(existing) | Action::Status(existing) => existing.json,
            Action::Page(page) => page.study.json,
        }
    }

    /// Runs the action.
    pub fn run(&self) -> Result<(), Failure> {
        match &self.action {
            Action::Run(run) => run.run(),
            Action::Merge(existing) => {
                let path = existing.open()?.merge().map_err(Error::from)?;
                match existing.json {
                    true => line(serde_json::json!({ "table": path })),
                    false => line(path.display()),
                }
                Ok(())
            }
            Action::Status(existing) => {
                let folder = existing.open()?;
                let status = folder.status();
                warn_of_transients(&folder, &status);
                print_status(&status, existing.json);
                Ok(())
            }
            Action::Page(page) => page.run(),
        }
    }
}

impl Existing {
    fn open(&self) -> Result<StudyFolder, Failure> {
        Ok(StudyFolder::open(&self.folder).map_err(Error::from)?)
    }
}

impl Page {
    fn run(&self) -> Result<(), Failure> {
        let study = self.study.open()?;
        let folder = self.study.folder.canonicalize();
        let name = folder.as_deref().ok().and_then(Path::file_name);
        let name = name.unwrap_or_default().to_string_lossy();
        let path = match &self.out {
            Some(path) => path.clone(),
            None => PathBuf::from(format!("{name}.html")),
        };
        if path.extension().is_none_or(|extension| extension != "html") {
            let path = path.display();
            let text = format!("--out {path}: give a file whose name ends in .html");
            return Err(Failure::usage(text));
        }
        let page = study_page(&study, &name)?;
        write_file(&path, page.as_bytes()).map_err(Error::from)?;
        match self.study.json {
            true => line(serde_json::json!({ "page": path })),
            false => line(path.display()),
        }
        Ok(())
    }
}

impl Run {
    fn run(&self) -> Result<(), Failure> {
        let control = Control::default();
        let study = jounce::Study::read(&self.study);
        let study = study.map_err(|error| of_file(&self.study, error))?;
        let study = study
            .with_control(&control)
            .with_record(record::of_file("study"));
        print_recording_issues(study.spec());
        interruption::install(&control);
        let work = || study.run(&self.out, &self.options);
        let status = progress::with_parts("points", &control, work)?;
        if control.is_stopped() {
            return Err(Failure::Interrupted(
                "stopped; finished parts are stored; the same command continues from there"
                    .to_owned(),
            ));
        }
        output::warn(&status.warnings);
        let folder = StudyFolder::open(&self.out).map_err(Error::from)?;
        warn_of_transients(&folder, &status);
        print_status(&status, self.json);
        if status.merged && !self.json {
            let (table, _) = folder.merged().map_err(Error::from)?;
            output::print_first_rows(&table);
            line(format!("all results in {}", folder.table().display()));
        }
        Ok(())
    }
}

/// Warns of points that had not settled, whose values contain the transient.
fn warn_of_transients(folder: &StudyFolder, status: &StudyStatus) {
    let (unsettled, points) = (folder.unsettled_points(), status.points);
    if unsettled > 0 {
        output::warn(&[format!(
            "points that had not settled when they were averaged: {unsettled} of {points}; increase run.duration, or compute a quantity of orbits"
        )]);
    }
}

fn print_status(status: &StudyStatus, json: bool) {
    if json {
        line(serde_json::json!(status));
        return;
    }
    line(format!(
        "parts      {} of {} finished",
        status.finished, status.parts
    ));
    line(format!(
        "points     {}, {} of the finished without a result",
        status.points, status.failed_points
    ));
    status
        .damaged
        .iter()
        .for_each(|path| line(format!("damaged    {}", path.display())));
    line(format!(
        "merged     {}",
        if status.merged { "yes" } else { "no" }
    ));
}
