//! Arguments that all commands on a spec share.

use crate::failure::Failure;
use crate::output;
use clap::Args;
use jounce::parts::{Manifest, Quantity};
use jounce::{Error, Harvester, Spec, SpecFile};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The spec and its overrides.
#[derive(Debug, Args)]
pub struct SpecArguments {
    /// The spec file (TOML).
    pub spec: PathBuf,
    /// Sets a key for this call, as in --set stop.tip.gap="0.5 mm", or removes it, as in --set
    /// run.tolerance=; can be given several times, once for each key; by default the spec is used
    /// unchanged.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// Output options.
#[derive(Debug, Args)]
pub struct OutputArguments {
    /// Prints one JSON object on stdout; by default lines of text.
    #[arg(long)]
    pub json: bool,
    /// Writes tables (CSV, Parquet, JSON) and pictures (SVG, PNG, PDF) into this folder, which
    /// is created if missing and whose files of these names are replaced; by default no files.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// The spec of a command that also takes recordings, and the options of its question.
#[derive(Debug, Args)]
#[command(mut_arg("spec", |spec| spec.required(false)))]
pub struct ModelArguments<O: Args> {
    #[command(flatten)]
    spec: Option<SpecArguments>,
    #[command(flatten)]
    pub options: O,
}

impl<O: Args> ModelArguments<O> {
    /// Returns the spec; without one, and so without recordings too, the failure.
    pub fn spec(&self) -> Result<&SpecArguments, Failure> {
        let text = "give a SPEC, or recordings of a hammer test with --measured FILE...";
        self.spec
            .as_ref()
            .ok_or_else(|| Failure::usage(text.to_owned()))
    }
}

impl SpecArguments {
    /// Returns the keys and values of `--set`.
    ///
    /// # Errors
    /// An assignment without `=`, and two of one key.
    pub fn assignments(&self) -> Result<Vec<(&str, &str)>, Failure> {
        let mut assignments: Vec<(&str, &str)> = Vec::with_capacity(self.set.len());
        for assignment in &self.set {
            let Some((key, value)) = assignment.split_once('=') else {
                return Err(Failure::usage(format!(
                    "--set {assignment}: write KEY=VALUE, as in --set stop.tip.gap=\"0.5 mm\""
                )));
            };
            if let Some((_, first)) = assignments.iter().find(|(other, _)| *other == key) {
                return Err(Failure::usage(format!(
                    "--set gives {key} twice: {key}={first} and {key}={value}; keep one of them"
                )));
            }
            assignments.push((key, value));
        }
        Ok(assignments)
    }

    /// Refuses to set the key of a range, `KEY=RANGE`, which has its own values.
    ///
    /// # Errors
    /// The key is set.
    pub fn refuse_set(&self, range: &str) -> Result<(), Failure> {
        let swept = range.split('=').next().unwrap_or_default();
        let assignments = self.assignments()?;
        match assignments.iter().find(|(key, _)| *key == swept) {
            Some((key, value)) => Err(Failure::usage(format!(
                "--over gives the values of {key}; omit --set {key}={value}"
            ))),
            None => Ok(()),
        }
    }

    /// Reads the file and applies the overrides.
    pub fn file(&self) -> Result<SpecFile, Failure> {
        let mut file = SpecFile::read(&self.spec).map_err(Error::from)?;
        let mut faults = Vec::new();
        for (key, value) in self.assignments()? {
            if let Err(fault) = file.set(key, value) {
                faults.push(fault);
            }
        }
        if faults.is_empty() {
            return Ok(file);
        }
        let others = file.spec().err();
        let others = others.iter().flat_map(|faults| faults.as_slice());
        faults.extend(others.filter(|fault| fault.set.is_some()).cloned());
        Err(Failure::faults(&self.spec, faults))
    }

    /// Returns the harvester; prints the issues of the recordings of its drives on stderr.
    pub fn harvester(&self) -> Result<Harvester, Failure> {
        let harvester = Harvester::of(self.file()?, self.folder());
        let harvester = harvester.map_err(|error| self.failure(error))?;
        print_recording_issues(harvester.spec());
        Ok(harvester)
    }

    /// Returns the failure of a computation; faults of the spec get the name of the file.
    pub fn failure(&self, error: Error) -> Failure {
        match error {
            Error::Spec(faults) => Failure::faults(&self.spec, faults.as_slice().to_vec()),
            error => error.into(),
        }
    }

    /// Returns the folder of the spec file.
    pub fn folder(&self) -> PathBuf {
        self.spec
            .parent()
            .map_or_else(PathBuf::new, Path::to_path_buf)
    }

    /// Returns the manifest of a result.
    pub fn manifest(
        &self,
        harvester: &Harvester,
        command: &str,
        options: &impl Serialize,
    ) -> Result<Manifest, Failure> {
        let manifest = harvester.manifest(command, options)?;
        Ok(manifest.with("set", self.set.join(" ")))
    }
}

/// Prints the issues of the recordings of the drives, and which of them the run cuts, on stderr.
pub fn print_recording_issues(spec: &Spec) {
    for (drive, issue) in spec.issues() {
        let kind = if issue.kind.is_note() {
            "note"
        } else {
            "warning"
        };
        output::note(format!("{kind}: drive {drive}: {issue}"));
    }
    for (drive, ends_s) in spec.cut_recordings() {
        let duration = Quantity::Time.write(spec.run.duration_s);
        output::note(format!(
            "note: drive {drive}: its recording lasts until {ends_s:.6} s, but a run ends at run.duration = {duration}; increase run.duration to use all of it"
        ));
    }
}
