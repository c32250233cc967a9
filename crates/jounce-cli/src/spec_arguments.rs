//! The arguments that every command on a spec shares.

use crate::failure::Failure;
use clap::Args;
use jounce::analysis::AnalysisError;
use jounce::orbit::OrbitError;
use jounce::plant::Plant;
use jounce::spec::{Faults, KeyRange, NumericKey, Quantity, Spec, SpecFile};
use jounce::table::Manifest;
use std::path::{Path, PathBuf};

/// The spec and its overrides.
#[derive(Debug, Args)]
pub struct SpecArguments {
    /// The spec file (TOML).
    pub spec: PathBuf,
    /// Sets a key for this call, as in --set stop.tip.gap="0.5 mm"; can be given several times; by default the spec holds as it stands.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// Where answers go.
#[derive(Debug, Args)]
pub struct OutputArguments {
    /// Prints one JSON object on stdout; by default lines to read.
    #[arg(long)]
    pub json: bool,
    /// Writes tables (CSV, Parquet, JSON) and pictures (SVG, PNG) into this folder, which is made where it is missing; by default none.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl SpecArguments {
    /// Reads the file and applies the overrides.
    pub fn file(&self) -> Result<SpecFile, Failure> {
        let mut file = SpecFile::read(&self.spec)?;
        let mut faults = Vec::new();
        for assignment in &self.set {
            let Some((key, value)) = assignment.split_once('=') else {
                return Err(Failure::usage(format!(
                    "--set {assignment}: write KEY=VALUE, as in --set stop.tip.gap=\"0.5 mm\""
                )));
            };
            if let Err(fault) = file.set(key, value) {
                faults.push(fault);
            }
        }
        if faults.is_empty() {
            Ok(file)
        } else {
            Err(Failure::faults(&self.spec, faults))
        }
    }

    /// The spec itself.
    pub fn spec(&self) -> Result<Spec, Failure> {
        self.read(&self.file()?)
    }

    /// The spec of the file with its overrides; prints on stderr what was noticed of the recordings of its drives.
    pub fn read(&self, file: &SpecFile) -> Result<Spec, Failure> {
        let spec = self.checked(file.spec())?;
        print_recording_issues(&spec);
        Ok(spec)
    }

    /// Faults with the name of the file.
    pub fn checked<T>(&self, result: Result<T, Faults>) -> Result<T, Failure> {
        result.map_err(|faults| Failure::faults(&self.spec, faults.as_slice().to_vec()))
    }

    /// Reads `KEY=FROM:TO`.
    pub fn key_and_ends(
        &self,
        file: &SpecFile,
        over: &str,
    ) -> Result<(NumericKey, (f64, f64)), Failure> {
        let wrong = || {
            Failure::usage(format!(
                "{over}: write KEY=FROM:TO, as in drive.shaker.frequency=4Hz:20Hz"
            ))
        };
        let (name, text) = over.split_once('=').ok_or_else(wrong)?;
        let (from, to) = text
            .split_once(':')
            .filter(|(_, to)| !to.contains(':'))
            .ok_or_else(wrong)?;
        let key = self.checked(file.numeric_key(name.trim()))?;
        let range = KeyRange::parse(key.clone(), &format!("{from},{to}"))
            .map_err(|fault| Failure::faults(&self.spec, vec![fault]))?;
        match range.values() {
            [low, high] if low < high => Ok((key, (*low, *high))),
            _ => Err(Failure::usage(format!(
                "{over}: the range must go from a smaller to a larger value"
            ))),
        }
    }

    /// Folder of the spec file.
    pub fn folder(&self) -> PathBuf {
        self.spec
            .parent()
            .map_or_else(PathBuf::new, Path::to_path_buf)
    }

    /// Manifest of an answer.
    pub fn manifest(&self, spec: &Spec, command: &str) -> Manifest {
        Manifest::new(&spec.hash_hex())
            .with("command", command)
            .with("set", self.set.join(" "))
    }
}

/// Prints on stderr what was noticed of the recordings of the drives.
pub fn print_recording_issues(spec: &Spec) {
    for (drive, finding) in spec.findings() {
        let kind = if finding.kind.is_note() {
            "note"
        } else {
            "warning"
        };
        eprintln!("{kind}: drive {drive}: {finding}");
    }
}

/// A frequency above 0 given with an option.
pub fn frequency_hz(option: &str, text: &str) -> Result<f64, Failure> {
    let fault = |reason: String| Failure::usage(format!("--{option} {text}: {reason}"));
    let value = Quantity::Frequency
        .read(text)
        .map_err(|error| fault(error.to_string()))?;
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(fault("a frequency must be above 0 Hz".into()))
    }
}

/// A tolerance for orbits: double precision carries no march below its smallest.
pub fn check_tolerance(tolerance: f64) -> Result<(), Failure> {
    let fits = (1e-14..1e-2).contains(&tolerance);
    if fits {
        Ok(())
    } else {
        Err(Failure::usage(format!(
            "--tolerance {tolerance:e}: give a number from 1e-14 to 0.01"
        )))
    }
}

/// Drives that repeat themselves together, and move: without them nothing attracts but rest.
pub fn check_drive(spec: &SpecArguments, plant: &Plant, what: &str) -> Result<(), Failure> {
    if let Some(drive) = plant.system.aperiodic() {
        return Err(AnalysisError::Aperiodic {
            drive: drive.to_owned(),
        }
        .into());
    }
    let moving = plant
        .system
        .drives
        .iter()
        .any(|drive| drive.amplitude_n != 0.0);
    match (plant.period_s(), moving) {
        (Some(_), true) => Ok(()),
        (Some(_), false) => Err(Failure::Input(format!(
            "{}: drive.amplitude is 0, but {what} needs a drive that moves: give it an amplitude greater than 0",
            spec.spec.display()
        ))),
        (None, _) => Err(OrbitError::<AnalysisError>::Frequencies {
            frequencies: plant.tones.len(),
        }
        .into()),
    }
}
