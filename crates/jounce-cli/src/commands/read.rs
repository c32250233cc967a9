//! `jounce read FILE`

use crate::failure::Failure;
use crate::measured_file::MeasuredFile;
use crate::output::{line, print};
use clap::Args;
use jounce_measure::recording::{Channel, Over, Recording};
use jounce_measure::write::write;
use std::path::PathBuf;

/// Arguments of `read`.
#[derive(Debug, Args)]
pub struct Read {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Writes the first recording in SI to this file: .uff (UFF 58 in ASCII), .parquet or .csv.
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
}

impl Read {
    /// Reads and tells.
    pub fn run(&self) -> Result<(), Failure> {
        let contents = self.file.contents()?;
        if let (Some(path), Some(recording)) = (&self.to, contents.recordings.first()) {
            write(recording, path)?;
        }
        if self.file.json {
            let recordings: Vec<_> = contents.recordings.iter().map(listed).collect();
            let shapes: Vec<_> = contents.shapes.iter().map(|shape| shape.frequency_hz).collect();
            print(&serde_json::json!({ "recordings": recordings, "shape_frequencies_hz": shapes, "findings": contents.findings }));
            return Ok(());
        }
        for recording in &contents.recordings {
            tell(recording);
        }
        for shape in &contents.shapes {
            line(format!("shape at {} Hz, {} nodes", shape.frequency_hz, shape.nodes.len()));
        }
        contents.findings.iter().for_each(line);
        Ok(())
    }
}

/// Rms and largest size of the samples that are numbers.
fn sizes(channel: &Channel) -> (f64, f64) {
    let finite = || channel.values.iter().filter(|x| x.is_finite());
    let (sum, count) = finite().fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    (f64::sqrt(sum / f64::max(count, 1.0)), finite().fold(0.0, |peak: f64, x| peak.max(x.abs())))
}

fn tell(recording: &Recording) {
    let (rate, over) = if recording.over == Over::Time { ("Hz", "over time") } else { ("lines per Hz", "over frequency") };
    line(format!("{}: {} samples {over}, {:.6} {rate}", recording.name, recording.grid.len(), recording.rate()));
    for (k, channel) in recording.channels.iter().enumerate() {
        let (rms, peak) = sizes(channel);
        let unit = if channel.unit.is_empty() { "(no unit)" } else { &channel.unit };
        let kind = if channel.imaginary.is_some() { ", complex" } else { "" };
        let place = format!("{} {}", channel.place, channel.direction);
        line(format!("  {:>3}  {}  rms {rms:.5e}, peak {peak:.5e} {unit}{kind}  {}", k + 1, channel.name, place.trim()));
    }
    recording.findings.iter().for_each(|finding| line(format!("  ! {finding}")));
}

fn listed(recording: &Recording) -> serde_json::Value {
    let channel = |channel: &Channel| {
        let (rms, peak) = sizes(channel);
        serde_json::json!({
            "name": channel.name,
            "quantity": channel.quantity,
            "unit": channel.unit,
            "place": channel.place,
            "direction": channel.direction,
            "complex": channel.imaginary.is_some(),
            "rms": rms,
            "peak": peak,
        })
    };
    serde_json::json!({
        "name": recording.name,
        "over": if recording.over == Over::Time { "time" } else { "frequency" },
        "samples": recording.grid.len(),
        "rate": recording.rate(),
        "channels": recording.channels.iter().map(channel).collect::<Vec<_>>(),
        "findings": recording.findings,
    })
}
