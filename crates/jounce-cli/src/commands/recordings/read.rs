//! `jounce read FILE`

use crate::failure::Failure;
use crate::measured_file::MeasuredFile;
use crate::output::{self, line};
use crate::record;
use clap::{Arg, Args};
use jounce::parts::{Over, RecordingResult};
use jounce::{ConvertOptions, ReadResult, RecordedFile, definitions};
use std::path::{Path, PathBuf};

/// Arguments of `read`.
#[derive(Debug, Args)]
#[command(mut_args(of_conversion))]
pub struct Read {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Writes the first recording in SI to this file: .uff (UFF 58 in ASCII), .parquet or .csv.
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    #[command(flatten)]
    options: ConvertOptions,
}

/// Lets an argument of the conversion require a file to write to.
fn of_conversion(argument: Arg) -> Arg {
    let options = definitions::<ConvertOptions>();
    let id = argument.get_id().as_str();
    match options.iter().any(|option| option.name == id) {
        true => argument.requires("to"),
        false => argument,
    }
}

impl Read {
    /// Reads and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let file = RecordedFile::read(&self.file.file, &self.file.read)?;
        if let Some(path) = &self.to {
            self.convert(path, &file)?;
        }
        let result = file.result();
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &file, &result)?;
        }
        match self.file.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }

    /// Writes the first recording to another file; lists the others.
    fn convert(&self, path: &Path, file: &RecordedFile) -> Result<(), Failure> {
        let record = record::of_converted(path);
        let written = file.convert_with(path, &self.options, record)?;
        let path = path.display();
        for issue in &written.issues {
            output::note(format!("{path}: {issue}"));
        }
        if !written.left_out.is_empty() {
            let (name, left_out) = (&written.recording, written.left_out.join(", "));
            output::note(format!("{path}: {name} is written; left out: {left_out}"));
        }
        Ok(())
    }

    /// Writes the list of channels, the list of issues, and a figure of each recording.
    fn write(
        &self,
        folder: &Path,
        file: &RecordedFile,
        result: &ReadResult,
    ) -> Result<(), Failure> {
        let manifest = self.file.manifest("read", &())?;
        output::table(folder, "read", &result.table()?, &manifest)?;
        output::table(folder, "read-issues", &result.issues_table()?, &manifest)?;
        for (number, figure) in (1..).zip(file.figures()?) {
            output::figure(folder, &format!("read-{number}"), &figure)?;
        }
        Ok(())
    }
}

/// Prints the result as lines of text.
fn print_lines(result: &ReadResult) {
    result.recordings.iter().for_each(print_recording);
    for shape in &result.shapes {
        let components = shape.real.first().map_or(0, Vec::len);
        let damping = if shape.damping_ratio.is_nan() {
            "not given".to_owned()
        } else {
            format!("{:.3e}", shape.damping_ratio)
        };
        let (frequency_hz, nodes) = (shape.frequency_hz, shape.nodes.len());
        line(format!(
            "shape at {frequency_hz} Hz, damping ratio {damping}, {nodes} nodes of {components} components"
        ));
    }
    result.issues.iter().for_each(line);
}

fn print_recording(recording: &RecordingResult) {
    let (rate, unit) = match recording.over {
        Over::Time => ("Hz", "over time"),
        Over::Frequency => ("lines per Hz", "over frequency"),
    };
    line(format!(
        "{}: {} samples {unit}, {:.6} {rate}",
        recording.name, recording.samples, recording.rate
    ));
    for (number, channel) in (1..).zip(&recording.channels) {
        let unit = match channel.unit.as_str() {
            "" => "(no unit)",
            unit => unit,
        };
        let kind = if channel.complex { ", complex" } else { "" };
        let position = format!("{} {}", channel.place, channel.direction);
        let reference = match channel.reference.as_str() {
            "" => String::new(),
            reference => format!("  from {reference}"),
        };
        line(format!(
            "  {number:>3}  {}  rms {:.5e}, peak {:.5e}, mean {:.5e} {unit}{kind}  {}{reference}",
            channel.name,
            channel.rms,
            channel.peak,
            channel.mean,
            position.trim()
        ));
    }
    for issue in &recording.issues {
        line(format!("  ! {issue}"));
    }
    line(format!("  {}", recording.verdict));
}
