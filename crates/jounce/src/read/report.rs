//! Tables and figures of the contents of a file.

use super::{ChannelResult, ReadResult, RecordedFile, RecordingResult};
use crate::error::Error;
use jounce_data::read::{ChannelSummary, RecordingSummary};
use jounce_data::recording::{Issue, Over};
use jounce_io::table::{Column, Table, Values};
use jounce_plot::{Axis, Figure, Line, Panel, Series, Trace, time_histories};

/// Maximum number of channels in the figure of a recording.
const MAX_SHOWN_CHANNELS: usize = 8;
/// Maximum number of points of a channel in the figure: far above the number of pixel columns.
const MAX_DRAWN_POINTS: usize = 200_000;

impl ReadResult {
    /// Returns the table of the channels of all recordings.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let of_recording = |recording| move |channel| (recording, channel);
        let channels: Vec<(&RecordingResult, &ChannelResult)> = self
            .recordings
            .iter()
            .flat_map(|recording| recording.channels.iter().map(of_recording(recording)))
            .collect();
        let column = |name: &str, about: &str, values: Values| Column::new(name, "", about, values);
        let text = |value: fn(&RecordingResult, &ChannelResult) -> String| {
            Values::from(
                channels
                    .iter()
                    .map(|(r, c)| value(r, c))
                    .collect::<Vec<_>>(),
            )
        };
        let number = |value: fn(&RecordingResult, &ChannelResult) -> f64| {
            Values::from(
                channels
                    .iter()
                    .map(|(r, c)| value(r, c))
                    .collect::<Vec<_>>(),
            )
        };
        Ok(Table::new(vec![
            column(
                "recording",
                "name of the recording",
                text(|recording, _| recording.name.clone()),
            ),
            column(
                "channel",
                "name of the channel",
                text(|_, channel| channel.name.clone()),
            ),
            column(
                "unit",
                "unit of the next columns",
                text(|_, channel| channel.unit.clone()),
            ),
            column(
                "rms",
                "rms of the valid samples",
                number(|_, channel| channel.rms),
            ),
            column("peak", "largest size", number(|_, channel| channel.peak)),
            column(
                "mean",
                "mean of the valid samples",
                number(|_, channel| channel.mean),
            ),
            column(
                "rate",
                "samples per second, or per hertz",
                number(|recording, _| recording.rate),
            ),
        ])?)
    }

    /// Returns the table of all issues.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn issues_table(&self) -> Result<Table, Error> {
        let of_recordings = self.recordings.iter().flat_map(|one| &one.issues);
        let issues: Vec<&Issue> = of_recordings.chain(&self.issues).collect();
        let text = |value: fn(&Issue) -> String| {
            let texts = issues.iter().map(|issue| value(issue));
            texts.collect::<Vec<String>>()
        };
        let counts: Vec<u64> = issues.iter().map(|issue| issue.count as u64).collect();
        Ok(Table::new(vec![
            Column::new(
                "channel",
                "",
                "the channel; empty for all channels",
                text(|issue| issue.channel.clone().unwrap_or_default()),
            ),
            Column::new(
                "count",
                "",
                "number of samples, time stamps or lines",
                counts,
            ),
            Column::new("about", "", "description", text(ToString::to_string)),
        ])?)
    }
}

impl RecordedFile {
    /// Returns a figure of each recording: its first channels over time, or their magnitudes over
    /// frequency.
    ///
    /// # Errors
    /// [`Error::Scratch`].
    pub fn figures(&self) -> Result<Vec<Figure>, Error> {
        self.contents.recordings.iter().map(figure).collect()
    }
}

fn figure(recording: &RecordingSummary) -> Result<Figure, Error> {
    let decimated = recording
        .decimate(MAX_SHOWN_CHANNELS, MAX_DRAWN_POINTS)
        .map_err(Error::Scratch)?;
    let channels = recording.channels.iter().zip(decimated.channels);
    if recording.over == Over::Time {
        let trace = |(channel, values): (&ChannelSummary, _)| Trace {
            quantity: channel.name.clone(),
            unit: channel.unit.clone(),
            values,
        };
        let traces: Vec<Trace> = channels.map(trace).collect();
        return Ok(time_histories(&recording.name, &decimated.places, &traces));
    }
    let panel = |(channel, size): (&ChannelSummary, _)| {
        let axes = Panel::new(
            Axis::linear("Frequency", "Hz"),
            Axis::log(&channel.name, &channel.unit),
        );
        let line = Series::line(decimated.places.clone(), size).style(Line::Thin);
        axes.high(200.0).with(line)
    };
    Ok(Figure {
        panels: channels.map(panel).collect(),
        ..Figure::new(&recording.name)
    })
}
