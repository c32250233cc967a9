//! Arguments of tests without a measured force: free decays and output-only tests.

use crate::failure::Failure;
use crate::measured_file::{manifest, parse_interval, parse_positive, print_issues, record};
use clap::Args;
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::Manifest;
use jounce_measure::read;
use jounce_measure::recording::Over;
use jounce_measure::response::{AmbientSettings, Decays};
use std::path::PathBuf;

/// Options for recordings without a measured force.
#[derive(Debug, Args)]
pub struct DecayArguments {
    /// The recordings are free decays, one after each release or hit, each from its largest sample
    /// on or over --span; by default they are hammer or shaker tests.
    #[arg(long, requires = "measured", conflicts_with_all = ["output_only", "force", "input"])]
    pub free_decay: bool,
    /// The recording is the response to unmeasured noise, or one amplitude spectrum over frequency;
    /// by default the recordings contain a force.
    #[arg(long, requires = "measured", conflicts_with_all = ["force", "input"])]
    pub output_only: bool,
    /// Part of each free decay to use, in times after its first sample, as in 0.2s:3s; by default
    /// from its largest sample to its end.
    #[arg(long, value_name = "FROM:TO", requires = "free_decay")]
    span: Option<String>,
    /// Reference channel of the correlations, by name; can be given several times; by default all
    /// channels.
    #[arg(long, value_name = "CHANNEL", requires = "output_only")]
    reference: Vec<String>,
    /// Longest lag of the correlations, as in 2s; by default a sixty-fourth of the record, at least
    /// 512 samples.
    #[arg(long, value_name = "TIME", requires = "output_only")]
    lags: Option<String>,
}

impl DecayArguments {
    /// True where the recordings contain no force.
    pub fn are_given(&self) -> bool {
        self.free_decay || self.output_only
    }

    /// Returns the decays of the recordings.
    pub fn decays(&self, files: &[PathBuf], responses: &[String]) -> Result<Decays, Failure> {
        if self.free_decay {
            let records = files
                .iter()
                .map(|file| record(file))
                .collect::<Result<Vec<_>, _>>()?;
            return Ok(print_decay_issues(Decays::free(
                &records,
                responses,
                self.span_s()?,
            )?));
        }
        let [file] = files else {
            return Err(Failure::usage(format!(
                "--output-only takes one recording, but {} are given",
                files.len()
            )));
        };
        if let Some(spectrum) = read::file(file)?
            .recordings
            .first()
            .filter(|recording| recording.over == Over::Frequency)
        {
            return Ok(print_decay_issues(Decays::of_spectrum(
                spectrum, responses,
            )?));
        }
        let record = record(file)?;
        let lags_s = self
            .lags
            .as_ref()
            .map(|text| parse_positive("--lags", text, Unit::Time))
            .transpose()?;
        let settings = AmbientSettings {
            responses: responses.to_vec(),
            references: self.reference.clone(),
            lags_s,
        };
        Ok(print_decay_issues(Decays::ambient(&record, &settings)?))
    }

    /// Returns the manifest of a result.
    pub fn manifest(&self, files: &[PathBuf]) -> Result<Manifest, Failure> {
        let manifest = manifest("modes", files)?.with(
            "test",
            if self.free_decay {
                "free decay"
            } else {
                "output only"
            },
        );
        let text_or_empty = |option: &Option<String>| option.clone().unwrap_or_default();
        Ok(manifest
            .with("span", text_or_empty(&self.span))
            .with("reference", self.reference.join(" "))
            .with("lags", text_or_empty(&self.lags)))
    }

    fn span_s(&self) -> Result<Option<(f64, f64)>, Failure> {
        let Some(text) = &self.span else {
            return Ok(None);
        };
        let (from_s, to_s) = parse_interval("--span", text, Unit::Time)?;
        if from_s >= 0.0 {
            Ok(Some((from_s, to_s)))
        } else {
            Err(Failure::usage(format!(
                "--span {text}: the first time must be at least 0"
            )))
        }
    }
}

/// Prints the issues of the channels in use.
fn print_decay_issues(decays: Decays) -> Decays {
    let used_channels: Vec<&str> = decays
        .outputs
        .iter()
        .chain(&decays.references)
        .map(String::as_str)
        .collect();
    print_issues(&decays.findings, Some(&used_channels));
    decays
}
