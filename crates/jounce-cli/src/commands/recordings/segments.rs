//! `jounce segments FILE --drive F`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, print_issues, print_recording_issues};
use crate::output::{self, counted, line, with_uncertainty};
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce::parts::{Candidate, MAX_PERIOD_CYCLES, MergeReason, SegmentResult};
use jounce::{SegmentsOptions, SegmentsResult};
use std::path::{Path, PathBuf};

/// Arguments of `segments`.
#[derive(Debug, Args)]
pub struct Segments {
    #[command(flatten)]
    pub file: MeasuredFile,
    #[command(flatten)]
    options: SegmentsOptions,
    /// Spec of the model: each segment is matched with one of its solutions. The drive frequency,
    /// and the resistance where given, are taken from the record.
    #[arg(long, value_name = "SPEC")]
    model: Option<PathBuf>,
    /// Sets a key of the model, as in --set drive.shaker.amplitude="42 N"; can be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "model")]
    set: Vec<String>,
}

impl Segments {
    /// Segments and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let model = |path: &PathBuf| SpecArguments {
            spec: path.clone(),
            set: self.set.clone(),
        };
        let model = self.model.as_ref().map(model);
        let harvester = model.as_ref().map(SpecArguments::harvester).transpose()?;
        let recording = self.file.recording(&self.options)?;
        let result = recording.segments(harvester.as_ref(), &self.options);
        let result = result.map_err(|error| {
            print_recording_issues(&[recording]);
            match &model {
                Some(model) => model.failure(error),
                None => error.into(),
            }
        })?;
        print_issues(&result.issues);
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &result)?;
        }
        match self.file.output.json {
            true => line(output::to_json(&result)?),
            false => print_segments(&result),
        }
        Ok(())
    }

    fn write(&self, folder: &Path, result: &SegmentsResult) -> Result<(), Failure> {
        let manifest = self.file.manifest("segments", &self.options)?;
        let manifest = manifest.with("drive_hz", result.drive_hz);
        output::table(folder, "segments", &result.table()?, &manifest)?;
        for (name, figure) in result.figures()? {
            output::figure(folder, name, &figure)?;
        }
        Ok(())
    }
}

/// Prints the segments and the changes that are not changes of solution, one line each.
fn print_segments(result: &SegmentsResult) {
    let count = result.segments.len();
    let noun = if count == 1 { "segment" } else { "segments" };
    line(format!(
        "{count} {noun}; uncertainty of a change {:.3} s",
        result.uncertainty_s
    ));
    for joint in &result.joints {
        let reason = match joint.reason {
            MergeReason::NoiseChanged => "change of the noise",
            MergeReason::Drifts => "drift of the amplitude",
            MergeReason::Glitch => "short disturbance",
        };
        line(format!("{:>10.3} s: {reason}, same solution", joint.at_s));
    }
    for segment in &result.segments {
        let period = match segment.period_cycles {
            0 => format!("period longer than {MAX_PERIOD_CYCLES} drive cycles, or not periodic"),
            cycles => format!("period of {}", counted(cycles, "drive cycle")),
        };
        line(format!(
            "{:>10.3} s to {:>10.3} s  rms {:.5e} {}, {period} (mismatch {:.3}){}",
            segment.start_s,
            segment.end_s,
            segment.rms,
            result.unit,
            segment.mismatch,
            power_text(result, segment)
        ));
        print_match(segment);
    }
}

/// Formats the power of a segment; empty without a resistance.
fn power_text(result: &SegmentsResult, segment: &SegmentResult) -> String {
    match (segment.mean_power_w, segment.half_width_w) {
        _ if result.resistance_ohm.is_none() => String::new(),
        (Some(power_w), Some(half_w)) => format!(", {}", with_uncertainty(power_w, half_w, "W")),
        _ => ", too short for a power with a confidence interval".to_owned(),
    }
}

/// Prints the match of a segment with the model.
fn print_match(segment: &SegmentResult) {
    if segment.candidates.is_empty() {
        return;
    }
    let verdict = match segment.solution.as_deref().unwrap_or_default() {
        "several" => "several solutions match equally well".to_owned(),
        "none" => "no solution of the model matches".to_owned(),
        id => format!("solution {id}"),
    };
    line(format!("{:>29}{verdict}", ""));
    segment.candidates.iter().for_each(print_candidate);
}

fn print_candidate(candidate: &Candidate) {
    let number =
        |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3}"));
    line(format!(
        "{:>31}{:<8} waveform distance {:>6}, spectrum distance {:>6}, power ratio {:>6}, {} W in the model{}",
        "",
        candidate.id,
        number(candidate.waveform_distance),
        number(candidate.spectrum_distance),
        number(candidate.power_ratio),
        output::power(candidate.mean_power_w),
        match candidate.inverted {
            true => ", polarity inverted",
            false => "",
        }
    ));
}
