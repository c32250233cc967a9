//! `jounce rig SPEC --to FILE`

use crate::failure::Failure;
use crate::measured_file::print_issues;
use crate::output::{self, line};
use crate::record;
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce::parts::BaseMotion;
use jounce::{ReadOptions, Recording, RigOptions};
use std::path::PathBuf;

/// Arguments of `rig`.
#[derive(Debug, Args)]
pub struct Rig {
    #[command(flatten)]
    spec: SpecArguments,
    /// The recording to write: .uff, .parquet or .csv; an existing file is replaced.
    #[arg(long, value_name = "FILE")]
    to: PathBuf,
    #[command(flatten)]
    options: RigOptions,
    /// Moves the base as in this recording, for its duration, instead of the drives of the spec.
    #[arg(long, value_name = "FILE")]
    base: Option<PathBuf>,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl Rig {
    /// Simulates the test and writes the recording of its sensors.
    pub fn run(&self) -> Result<(), Failure> {
        let harvester = self.spec.harvester()?;
        let mut options = self.options.clone();
        if let Some(file) = &self.base {
            options.base = Some(Recording::read(file, &ReadOptions::default())?);
        }
        let result = harvester.rig(&options);
        let result = result.map_err(|error| self.spec.failure(error))?;
        if let Some(base) = &result.base {
            print_base(base);
        }
        result
            .recording
            .write_with(&self.to, record::of_path(&self.to))?;
        result.issues.iter().for_each(output::note);
        if self.json {
            let mut json = output::to_json(&result)?;
            json["file"] = self.to.display().to_string().into();
            line(&json);
            return Ok(());
        }
        line(format!(
            "{}: {} samples at {} Hz of {} (simulated)",
            self.to.display(),
            result.samples,
            result.rate_hz,
            result.channels.join(", ")
        ));
        Ok(())
    }
}

/// Prints on stderr how the base moves.
fn print_base(base: &BaseMotion) {
    print_issues(&base.issues);
    let mean_treatment = match base.is_mean_kept {
        true => "retained",
        false => "subtracted",
    };
    output::note(format!(
        "the base moves as {} of {}; its mean of {:.5} m/s^2 is {mean_treatment}",
        base.channel, base.recording, base.mean_m_s2
    ));
}
