//! `jounce read FILE`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, any_channel, parse_interval, parse_positive};
use crate::output::{self, line, print};
use clap::Args;
use jounce_core::picture::{Axis, Figure, Line, Panel, Series, Trace, time_histories};
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::{Column, Table};
use jounce_measure::read::{
    ChannelSummary, FileSummary, ModeShape, Notes, RecordingSummary, summary_with_notes,
};
use jounce_measure::recording::{Issue, Over, Series as _, Sizes};
use jounce_measure::write::write_surveyed;
use std::path::{Path, PathBuf};

/// Maximum number of channels in the picture of a recording.
const MAX_SHOWN_CHANNELS: usize = 8;
/// Maximum number of points of a channel in the picture: far above the number of pixel columns.
const MAX_DRAWN_POINTS: usize = 200_000;

/// Arguments of `read`.
#[derive(Debug, Args)]
pub struct Read {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Writes the first recording in SI to this file: .uff (UFF 58 in ASCII), .parquet or .csv.
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Part of the recording to write, in its own times or frequencies, as in 10s:60s or 5Hz:200Hz;
    /// by default all of it.
    #[arg(long, value_name = "FROM:TO", requires = "to")]
    span: Option<String>,
    /// Channel to write, by name or by number from 1; can be given several times; by default all
    /// channels.
    #[arg(long, value_name = "CHANNEL", requires = "to")]
    channel: Vec<String>,
    /// Resamples to even times without missing samples; by default the recording is written
    /// unchanged.
    #[arg(long, requires = "to")]
    even: bool,
    /// Sampling rate, as in 25600Hz; the times of the file are not used. By default the times of
    /// the file.
    #[arg(long, value_name = "RATE")]
    rate: Option<String>,
}

impl Read {
    /// Reads and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let mut notes = Notes::for_file(&self.file.file)?;
        if let Some(rate) = &self.rate {
            notes.rate_hz = Some(parse_positive("--rate", rate, Unit::Frequency)?);
        }
        let contents = summary_with_notes(&self.file.file, &notes)?;
        if let Some(path) = &self.to {
            self.write_first(path, &contents)?;
        }
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &contents)?;
        }
        if self.file.output.json {
            let recordings: Vec<_> = contents.recordings.iter().map(to_json).collect();
            let shapes: Vec<_> = contents.shapes.iter().map(mode_shape).collect();
            let frequencies: Vec<_> = contents
                .shapes
                .iter()
                .map(|shape| shape.frequency_hz)
                .collect();
            print(&serde_json::json!({
                "recordings": recordings,
                "shape_frequencies_hz": frequencies,
                "shapes": shapes,
                "findings": contents.findings,
            }));
            return Ok(());
        }
        for recording in &contents.recordings {
            print_recording(recording);
        }
        for shape in &contents.shapes {
            let components = shape.real.first().map_or(0, Vec::len);
            let damping = if shape.damping_ratio.is_nan() {
                "not given".to_owned()
            } else {
                format!("{:.3e}", shape.damping_ratio)
            };
            line(format!(
                "shape at {} Hz, damping ratio {damping}, {} nodes of {components} components",
                shape.frequency_hz,
                shape.nodes.len()
            ));
        }
        contents.findings.iter().for_each(line);
        Ok(())
    }

    /// Writes the first recording to another file; lists the others.
    fn write_first(&self, path: &Path, contents: &FileSummary) -> Result<(), Failure> {
        let Some((recording, other_recordings)) = contents.recordings.split_first() else {
            return Err(Failure::Input(format!(
                "--to {}: {} contains no recording to write, only {} mode shapes; --to writes recordings",
                path.display(),
                self.file.file.display(),
                contents.shapes.len()
            )));
        };
        let part = self.selection(recording)?;
        write_surveyed(part.as_ref().unwrap_or(recording), path)?;
        let new_issues = part
            .iter()
            .flat_map(|part| &part.findings)
            .filter(|finding| !recording.findings.contains(finding));
        new_issues.for_each(|issue| eprintln!("{}: {issue}", path.display()));
        let mut unwritten: Vec<String> = other_recordings
            .iter()
            .map(|recording| recording.name.clone())
            .collect();
        if !contents.shapes.is_empty() {
            unwritten.push(format!("{} mode shapes", contents.shapes.len()));
        }
        if !unwritten.is_empty() {
            eprintln!(
                "{}: {} is written; left out: {}",
                path.display(),
                recording.name,
                unwritten.join(", ")
            );
        }
        Ok(())
    }

    /// Returns the selected part of a recording; `None` where all of it is selected.
    fn selection(&self, recording: &RecordingSummary) -> Result<Option<RecordingSummary>, Failure> {
        if self.span.is_none() && self.channel.is_empty() && !self.even {
            return Ok(None);
        }
        let full_range = (f64::NEG_INFINITY, f64::INFINITY);
        let span = self
            .span
            .as_ref()
            .map_or(Ok(full_range), |span| span_of(recording, span))?;
        let numbers = self
            .channel
            .iter()
            .map(|channel| any_channel(recording, channel))
            .collect::<Result<Vec<_>, _>>()?;
        let channels = if numbers.is_empty() {
            (0..recording.channels.len()).collect()
        } else {
            numbers
        };
        let scratch_error =
            |fault| Failure::Input(format!("the scratch file cannot be used: {fault}"));
        let nothing = || {
            Failure::usage(format!(
                "--span: {} has no sample in this range",
                recording.name
            ))
        };
        let selection = recording
            .slice(span, &channels)
            .map_err(scratch_error)?
            .ok_or_else(nothing)?;
        if !self.even {
            return Ok(Some(selection));
        }
        Ok(Some(
            selection
                .into_recording()
                .map_err(scratch_error)?
                .into_even()?
                .into(),
        ))
    }

    /// Writes the list of channels, the list of findings, and a picture of each recording.
    fn write(&self, folder: &Path, contents: &FileSummary) -> Result<(), Failure> {
        let manifest = self.file.manifest("read")?;
        let channels: Vec<(&RecordingSummary, &ChannelSummary)> = contents
            .recordings
            .iter()
            .flat_map(|recording| {
                recording
                    .channels
                    .iter()
                    .map(move |channel| (recording, channel))
            })
            .collect();
        let text = |value: &dyn Fn(&RecordingSummary, &ChannelSummary) -> String| {
            channels
                .iter()
                .map(|(r, c)| value(r, c))
                .collect::<Vec<String>>()
        };
        let number = |value: &dyn Fn(&RecordingSummary, &ChannelSummary) -> f64| {
            channels
                .iter()
                .map(|(r, c)| value(r, c))
                .collect::<Vec<f64>>()
        };
        let table = Table::new(vec![
            Column::new(
                "recording",
                "",
                "name of the recording",
                text(&|r, _| r.name.clone()),
            ),
            Column::new(
                "channel",
                "",
                "name of the channel",
                text(&|_, c| c.name.clone()),
            ),
            Column::new(
                "unit",
                "",
                "unit of the next columns",
                text(&|_, c| c.unit.clone()),
            ),
            Column::new(
                "rms",
                "",
                "rms of the valid samples",
                number(&|_, c| c.sizes.rms),
            ),
            Column::new("peak", "", "largest size", number(&|_, c| c.sizes.peak)),
            Column::new(
                "mean",
                "",
                "mean of the valid samples",
                number(&|_, c| c.sizes.mean),
            ),
            Column::new(
                "rate",
                "",
                "samples per second, or per hertz",
                number(&|r, _| r.rate()),
            ),
        ])?;
        output::table(folder, "read", &table, &manifest)?;
        let findings: Vec<&Issue> = contents
            .recordings
            .iter()
            .flat_map(|r| &r.findings)
            .chain(&contents.findings)
            .collect();
        let issue_texts = |value: &dyn Fn(&Issue) -> String| {
            findings
                .iter()
                .map(|finding| value(finding))
                .collect::<Vec<String>>()
        };
        let counts: Vec<u64> = findings
            .iter()
            .map(|finding| finding.count as u64)
            .collect();
        let table = Table::new(vec![
            Column::new(
                "channel",
                "",
                "the channel; empty for all channels",
                issue_texts(&|f| f.channel.clone().unwrap_or_default()),
            ),
            Column::new(
                "count",
                "",
                "number of samples, time stamps or lines",
                counts,
            ),
            Column::new(
                "about",
                "",
                "description",
                issue_texts(&ToString::to_string),
            ),
        ])?;
        output::table(folder, "read-findings", &table, &manifest)?;
        for (k, recording) in contents.recordings.iter().enumerate() {
            output::figure(folder, &format!("read-{}", k + 1), &figure(recording)?)?;
        }
        Ok(())
    }
}

/// Returns the ends of a part of a recording.
fn span_of(recording: &RecordingSummary, span: &str) -> Result<(f64, f64), Failure> {
    let (quantity, unit) = if recording.over == Over::Time {
        (Unit::Time, "s")
    } else {
        (Unit::Frequency, "Hz")
    };
    let (from, to) = parse_interval("--span", span, quantity)?;
    let scratch_error = |fault| Failure::Input(format!("the scratch file cannot be used: {fault}"));
    let extreme_position = |select: &dyn Fn(f64, f64) -> f64| {
        let mut extreme = f64::NAN;
        recording
            .places
            .each(|position| extreme = select(extreme, position))
            .map(|()| extreme)
            .map_err(scratch_error)
    };
    let [lowest, highest] = [extreme_position(&f64::min)?, extreme_position(&f64::max)?];
    let empty_range = || {
        Failure::usage(format!(
            "--span {span}: no sample in this range; {} extends from {lowest} {unit} to {highest} {unit}",
            recording.name
        ))
    };
    if from <= highest && to >= lowest {
        Ok((from, to))
    } else {
        Err(empty_range())
    }
}

/// Draws the first channels over time, or their magnitudes over frequency.
fn figure(recording: &RecordingSummary) -> Result<Figure, Failure> {
    let decimated = recording
        .decimate(MAX_SHOWN_CHANNELS, MAX_DRAWN_POINTS)
        .map_err(|fault| Failure::Input(format!("the scratch file cannot be read: {fault}")))?;
    let channels = recording.channels.iter().zip(decimated.channels);
    if recording.over == Over::Time {
        let trace = |(channel, values): (&ChannelSummary, _)| Trace {
            quantity: channel.name.clone(),
            unit: channel.unit.clone(),
            values,
        };
        return Ok(time_histories(
            &recording.name,
            &decimated.places,
            &channels.map(trace).collect::<Vec<_>>(),
        ));
    }
    let panel = |(channel, size): (&ChannelSummary, _)| {
        let axes = Panel::new(
            Axis::linear("Frequency", "Hz"),
            Axis::log(&channel.name, &channel.unit),
        )
        .high(200.0);
        axes.with(Series::line(decimated.places.clone(), size).style(Line::Thin))
    };
    Ok(Figure {
        panels: channels.map(panel).collect(),
        ..Figure::new(&recording.name)
    })
}

fn print_recording(recording: &RecordingSummary) {
    let (rate, unit) = if recording.over == Over::Time {
        ("Hz", "over time")
    } else {
        ("lines per Hz", "over frequency")
    };
    line(format!(
        "{}: {} samples {unit}, {:.6} {rate}",
        recording.name,
        recording.places.count(),
        recording.rate()
    ));
    for (k, channel) in recording.channels.iter().enumerate() {
        let Sizes { rms, peak, mean } = channel.sizes;
        let unit = if channel.unit.is_empty() {
            "(no unit)"
        } else {
            &channel.unit
        };
        let kind = if channel.imaginary.is_some() {
            ", complex"
        } else {
            ""
        };
        let position = format!("{} {}", channel.place, channel.direction);
        let reference = if channel.reference.is_empty() {
            String::new()
        } else {
            format!("  from {}", channel.reference)
        };
        line(format!(
            "  {:>3}  {}  rms {rms:.5e}, peak {peak:.5e}, mean {mean:.5e} {unit}{kind}  {}{reference}",
            k + 1,
            channel.name,
            position.trim()
        ));
    }
    recording
        .findings
        .iter()
        .for_each(|finding| line(format!("  ! {finding}")));
    line(format!("  {}", recording.verdict()));
}

fn mode_shape(shape: &ModeShape) -> serde_json::Value {
    serde_json::json!({
        "frequency_hz": shape.frequency_hz,
        "damping_ratio": shape.damping_ratio,
        "nodes": shape.nodes,
        "real": shape.real,
        "imaginary": shape.imaginary,
    })
}

fn to_json(recording: &RecordingSummary) -> serde_json::Value {
    let channel = |channel: &ChannelSummary| {
        serde_json::json!({
            "name": channel.name,
            "quantity": channel.quantity,
            "unit": channel.unit,
            "place": channel.place,
            "direction": channel.direction,
            "reference": channel.reference,
            "complex": channel.imaginary.is_some(),
            "rms": channel.sizes.rms,
            "peak": channel.sizes.peak,
            "mean": channel.sizes.mean,
        })
    };
    serde_json::json!({
        "name": recording.name,
        "over": if recording.over == Over::Time { "time" } else { "frequency" },
        "samples": recording.places.count(),
        "rate": recording.rate(),
        "channels": recording.channels.iter().map(channel).collect::<Vec<_>>(),
        "findings": recording.findings,
        "verdict": recording.verdict(),
    })
}
