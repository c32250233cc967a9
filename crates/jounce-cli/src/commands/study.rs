//! `jounce study run|merge|status`

use crate::failure::Failure;
use crate::interruption;
use crate::output::{line, print};
use crate::progress;
use crate::spec_arguments::print_recording_issues;
use crate::threads::ThreadsArgument;
use clap::{Args, Subcommand};
use jounce_core::integrate::Control;
use jounce_core::study::{Folder, Shard, Status, Study as Survey, StudyError};
use std::path::PathBuf;

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
}

/// Arguments of `study run`.
#[derive(Debug, Args)]
struct Run {
    /// Study file (TOML): a spec, the keys to vary, the quantity to compute.
    study: PathBuf,
    /// Folder of the parts and the table.
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Share of one of several processes: I/N, I from 1 to N.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE)]
    shard: Shard,
    #[command(flatten)]
    threads: ThreadsArgument,
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

impl Study {
    /// True where the result is printed as JSON.
    pub fn wants_json(&self) -> bool {
        match &self.action {
            Action::Run(run) => run.json,
            Action::Merge(existing) | Action::Status(existing) => existing.json,
        }
    }

    /// Runs the action.
    pub fn run(&self) -> Result<(), Failure> {
        match &self.action {
            Action::Run(run) => run.run(),
            Action::Merge(existing) => {
                let path = Folder::open(&existing.folder)?.merge()?;
                match existing.json {
                    true => print(&serde_json::json!({ "table": path })),
                    false => line(path.display()),
                }
                Ok(())
            }
            Action::Status(existing) => {
                print_status(&Folder::open(&existing.folder)?.status(), existing.json);
                Ok(())
            }
        }
    }
}

impl Run {
    fn run(&self) -> Result<(), Failure> {
        let study = Survey::read(&self.study)?;
        print_recording_issues(&study.spec);
        let folder = Folder::of(&self.out, &study)?;
        let control = Control::default();
        interruption::install(&control);
        let point_count = (0..study.parts())
            .filter(|part| self.shard.takes(*part))
            .map(|part| study.points(part).len())
            .sum();
        let bar = progress::bar(point_count);
        self.threads.run(|| {
            folder.run(&study, self.shard, &control, &|points| {
                bar.inc(points as u64)
            })
        })??;
        bar.finish_and_clear();
        if control.is_stopped() {
            return Err(Failure::Interrupted(
                "stopped; finished parts are stored; the same command continues from there"
                    .to_owned(),
            ));
        }
        let status = folder.status();
        if status.finished == status.parts {
            folder.merge()?;
        }
        print_status(&folder.status(), self.json);
        Ok(())
    }
}

fn print_status(status: &Status, json: bool) {
    if json {
        print(&serde_json::json!(status));
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

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Study(error) => error.into(),
            error => Failure::Input(error.to_string()),
        }
    }
}
