//! Summary of a file without its numbers in memory.

pub(super) mod decimation;
mod slice;
mod verdict;

use std::borrow::Cow;
use std::io;
use std::path::Path;

use crate::read::column::numbers::ColumnNumbers;
use crate::read::{Contents, ModeShape, ReadError};
use crate::recording::{
    Channel, ChannelHead, Grid, Issue, Over, PIECE, Quantity, Recording, Series, Sizes, sizes_with,
};

/// Contents of a file. Numbers beyond the first 16 MiB are in a scratch file, so memory does not
/// grow with the file.
#[derive(Debug)]
pub struct FileSummary {
    /// Recordings: one for each set of channels that share a grid.
    pub recordings: Vec<RecordingSummary>,
    /// Mode shapes (UFF 55).
    pub shapes: Vec<ModeShape>,
    /// Issues that concern the complete file.
    pub issues: Vec<Issue>,
}

/// Recording whose numbers need not be in memory.
#[derive(Debug)]
pub struct RecordingSummary {
    /// Name: the file name, with the number of the data set if the file contains several.
    pub name: String,
    /// Independent variable of the samples.
    pub over: Over,
    /// Sample positions, s or Hz.
    pub places: SamplePlaces,
    /// Channels, each with one sample per position.
    pub channels: Vec<ChannelSummary>,
    /// Data-quality issues and conversions.
    pub issues: Vec<Issue>,
}

/// Sample positions, s or Hz.
#[derive(Debug)]
pub enum SamplePlaces {
    /// Uniform: `start + k step`.
    Even {
        /// First position.
        start: f64,
        /// Spacing, > 0.
        step: f64,
        /// Number of positions.
        count: usize,
    },
    /// One position for each sample, ascending.
    Stamped {
        /// Positions.
        stamps: ColumnNumbers,
        /// Samples per unit of the grid.
        rate: f64,
    },
}

/// Channel in SI units whose numbers need not be in memory.
#[derive(Debug)]
pub struct ChannelSummary {
    /// Channel name.
    pub name: String,
    /// Measured quantity.
    pub quantity: Quantity,
    /// SI unit of the values; for an unknown quantity the unit of the file, empty if not given.
    pub unit: String,
    /// Location of the sensor; empty if not given.
    pub place: String,
    /// Direction of the sensor; empty if not given.
    pub direction: String,
    /// Node and direction of the force of a response function, such as `node 3 +z`; empty if not
    /// given.
    pub reference: String,
    /// RMS and peak; for complex samples of the magnitude.
    pub sizes: Sizes,
    /// Samples; real parts of complex ones. NaN where missing.
    pub values: ColumnNumbers,
    /// Imaginary parts of a complex channel, equally many.
    pub imaginary: Option<ColumnNumbers>,
}

impl FileSummary {
    /// Loads everything into memory.
    pub(in crate::read) fn into_contents(self, path: &Path) -> Result<Contents, ReadError> {
        let scratch_error = |reason| ReadError::Scratch {
            path: path.to_owned(),
            reason,
        };
        let recordings = self
            .recordings
            .into_iter()
            .map(RecordingSummary::into_recording)
            .collect::<Result<_, _>>()
            .map_err(scratch_error)?;
        Ok(Contents {
            recordings,
            shapes: self.shapes,
            issues: self.issues,
        })
    }
}

impl RecordingSummary {
    /// Samples per second (over time) or per hertz (over frequency).
    pub fn rate(&self) -> f64 {
        self.places.rate()
    }

    /// Properties by which channels are selected: see [`crate::recording::choose_channel`].
    pub fn heads(&self) -> Vec<ChannelHead<'_>> {
        self.channels.iter().map(ChannelSummary::head).collect()
    }

    /// Loads the selected channels into memory and discards the others. Channels are counted from 0
    /// and returned in the requested order. Issues of the discarded channels are removed; those of
    /// the times remain.
    ///
    /// # Errors
    /// The scratch file cannot be read, or the channel does not exist.
    pub fn into_recording_of(mut self, channels: &[usize]) -> io::Result<Recording> {
        let mut remaining: Vec<Option<ChannelSummary>> =
            self.channels.into_iter().map(Some).collect();
        let mut result: Vec<Channel> = Vec::new();
        for (k, number) in channels.iter().enumerate() {
            let duplicate = channels[..k]
                .iter()
                .position(|previous| previous == number)
                .map(|at| result[at].clone());
            let missing_channel =
                || io::Error::other(format!("there is no channel {}", number + 1));
            result.push(match duplicate {
                Some(duplicate) => duplicate,
                None => remaining
                    .get_mut(*number)
                    .and_then(Option::take)
                    .ok_or_else(missing_channel)?
                    .into_channel()?,
            });
        }
        let names: Vec<String> = remaining
            .into_iter()
            .flatten()
            .map(|channel| channel.name)
            .collect();
        self.issues.retain(|issue| {
            !issue
                .channel
                .as_ref()
                .is_some_and(|issue_channel| names.contains(issue_channel))
        });
        self.channels = Vec::new();
        Ok(Recording {
            channels: result,
            ..self.into_recording()?
        })
    }

    /// Loads the recording with all its numbers into memory.
    ///
    /// # Errors
    /// The scratch file cannot be read.
    pub fn into_recording(self) -> io::Result<Recording> {
        let grid = match self.places {
            SamplePlaces::Even { start, step, count } => Grid::Even { start, step, count },
            SamplePlaces::Stamped { stamps, .. } => Grid::Stamped(stamps.into_vec()?),
        };
        let channels = self
            .channels
            .into_iter()
            .map(ChannelSummary::into_channel)
            .collect::<io::Result<_>>()?;
        Ok(Recording {
            name: self.name,
            over: self.over,
            grid,
            channels,
            issues: self.issues,
        })
    }
}

impl ChannelSummary {
    /// Properties by which the channel is selected.
    pub fn head(&self) -> ChannelHead<'_> {
        ChannelHead {
            name: &self.name,
            quantity: self.quantity,
            unit: &self.unit,
        }
    }

    pub(in crate::read) fn into_channel(self) -> io::Result<Channel> {
        let mut channel = Channel::new(
            &self.name,
            self.quantity,
            &self.unit,
            self.values.into_vec()?,
        );
        channel.imaginary = self.imaginary.map(ColumnNumbers::into_vec).transpose()?;
        (channel.place, channel.direction, channel.reference) =
            (self.place, self.direction, self.reference);
        Ok(channel)
    }
}

/// Computes the sizes of a channel in memory.
fn of_channel(channel: &Channel) -> Sizes {
    let imaginary = channel.imaginary.as_deref();
    let Ok(sizes) = sizes_with(
        Sizes::of(&channel.values),
        &channel.values.as_slice(),
        imaginary.as_ref(),
    );
    sizes
}

impl From<Recording> for RecordingSummary {
    fn from(recording: Recording) -> Self {
        let rate = recording.rate();
        let places = match recording.grid {
            Grid::Even { start, step, count } => SamplePlaces::Even { start, step, count },
            Grid::Stamped(stamps) => SamplePlaces::Stamped {
                stamps: stamps.into(),
                rate,
            },
        };
        let channel = |channel: Channel| ChannelSummary {
            sizes: of_channel(&channel),
            name: channel.name,
            quantity: channel.quantity,
            unit: channel.unit,
            place: channel.place,
            direction: channel.direction,
            reference: channel.reference,
            values: channel.values.into(),
            imaginary: channel.imaginary.map(ColumnNumbers::from),
        };
        let channels = recording.channels.into_iter().map(channel).collect();
        Self {
            name: recording.name,
            over: recording.over,
            places,
            channels,
            issues: recording.issues,
        }
    }
}

impl SamplePlaces {
    /// Samples per second (over time) or per hertz (over frequency).
    pub fn rate(&self) -> f64 {
        match self {
            Self::Even { step, .. } => 1.0 / step,
            Self::Stamped { rate, .. } => *rate,
        }
    }
}

impl Series for SamplePlaces {
    type Fault = io::Error;

    fn count(&self) -> usize {
        match self {
            Self::Even { count, .. } => *count,
            Self::Stamped { stamps, .. } => stamps.count(),
        }
    }

    fn piece(&self, index: usize) -> io::Result<Cow<'_, [f64]>> {
        match self {
            Self::Even { start, step, count } => {
                let from = index * PIECE;
                Ok((from..(from + PIECE).min(*count))
                    .map(|k| start + k as f64 * step)
                    .collect())
            }
            Self::Stamped { stamps, .. } => stamps.piece(index),
        }
    }
}
