//! What a file holds, told without holding its numbers in memory.

use std::borrow::Cow;
use std::io;
use std::path::Path;

use super::numbers::ColumnNumbers;
use super::{Contents, ModeShape, ReadError};
use crate::recording::{
    Channel, ChannelHead, Grid, Issue, Over, PIECE, Quantity, Recording, Series, Sizes, sizes_with,
};

/// What a file holds; its numbers lie in a scratch file beyond the first 16 MiB of them, so that memory does not grow with the file.
#[derive(Debug)]
pub struct FileSummary {
    /// Its recordings, one for each set of channels with a grid of their own.
    pub recordings: Vec<RecordingSummary>,
    /// Its mode shapes (UFF 55).
    pub shapes: Vec<ModeShape>,
    /// What concerns the file as a whole.
    pub findings: Vec<Issue>,
}

/// A recording whose numbers need not lie in memory.
#[derive(Debug)]
pub struct RecordingSummary {
    /// Its name: that of the file, with the number of the data set where a file holds several.
    pub name: String,
    /// What the samples are taken over.
    pub over: Over,
    /// Where the samples lie, s or Hz.
    pub places: SamplePlaces,
    /// The channels, each with one sample for each place.
    pub channels: Vec<ChannelSummary>,
    /// Everything that was noticed or done.
    pub findings: Vec<Issue>,
}

/// Where samples lie, s or Hz.
#[derive(Debug)]
pub enum SamplePlaces {
    /// Even: `start + k step`.
    Even {
        /// The first place.
        start: f64,
        /// Their distance, > 0.
        step: f64,
        /// Their number.
        count: usize,
    },
    /// One place for each sample, ascending.
    Stamped {
        /// The places.
        stamps: ColumnNumbers,
        /// Samples per unit of the grid.
        rate: f64,
    },
}

/// A channel in SI whose numbers need not lie in memory.
#[derive(Debug)]
pub struct ChannelSummary {
    /// Its name.
    pub name: String,
    /// What it measures.
    pub quantity: Quantity,
    /// SI unit of the values; as in the file where the quantity is unknown, and empty where nothing is told.
    pub unit: String,
    /// Where the sensor sits; empty where nothing is told.
    pub place: String,
    /// Which way it points; empty where nothing is told.
    pub direction: String,
    /// Where and which way the force of a response function acts, as `node 3 +z`; empty where nothing is told.
    pub reference: String,
    /// Rms and largest size; of complex samples those of their absolute value.
    pub sizes: Sizes,
    /// The samples, real parts of complex ones. NaN where one is missing.
    pub values: ColumnNumbers,
    /// Imaginary parts of a complex channel, as many.
    pub imaginary: Option<ColumnNumbers>,
}

impl FileSummary {
    /// Everything in memory.
    pub(super) fn into_contents(self, path: &Path) -> Result<Contents, ReadError> {
        let lost = |reason| ReadError::Scratch {
            path: path.to_owned(),
            reason,
        };
        let recordings = self
            .recordings
            .into_iter()
            .map(RecordingSummary::into_recording)
            .collect::<Result<_, _>>()
            .map_err(lost)?;
        Ok(Contents {
            recordings,
            shapes: self.shapes,
            findings: self.findings,
        })
    }
}

impl RecordingSummary {
    /// Samples per second (over time) or per hertz (over frequency).
    pub fn rate(&self) -> f64 {
        self.places.rate()
    }

    /// What each channel is chosen by: see [`crate::recording::chosen`].
    pub fn heads(&self) -> Vec<ChannelHead<'_>> {
        self.channels.iter().map(ChannelSummary::head).collect()
    }

    /// The recording with the numbers of some channels in memory and without the others. Channels are numbered from 0 and come in the order asked
    /// for; what was noticed of the others is left out, that of the times stays.
    ///
    /// # Errors
    /// The scratch file cannot be read, or there is no such channel.
    pub fn into_recording_of(mut self, channels: &[usize]) -> io::Result<Recording> {
        let mut left: Vec<Option<ChannelSummary>> = self.channels.into_iter().map(Some).collect();
        let mut found: Vec<Channel> = Vec::new();
        for (k, number) in channels.iter().enumerate() {
            let again = channels[..k]
                .iter()
                .position(|before| before == number)
                .map(|at| found[at].clone());
            let missing = || io::Error::other(format!("there is no channel {}", number + 1));
            found.push(match again {
                Some(again) => again,
                None => left
                    .get_mut(*number)
                    .and_then(Option::take)
                    .ok_or_else(missing)?
                    .into_channel()?,
            });
        }
        let names: Vec<String> = left
            .into_iter()
            .flatten()
            .map(|channel| channel.name)
            .collect();
        self.findings.retain(|finding| {
            !finding
                .channel
                .as_ref()
                .is_some_and(|of| names.contains(of))
        });
        self.channels = Vec::new();
        Ok(Recording {
            channels: found,
            ..self.into_recording()?
        })
    }

    /// The recording with all its numbers in memory.
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
            findings: self.findings,
        })
    }
}

impl ChannelSummary {
    /// What it is chosen by.
    pub fn head(&self) -> ChannelHead<'_> {
        ChannelHead {
            name: &self.name,
            quantity: self.quantity,
            unit: &self.unit,
        }
    }

    pub(super) fn into_channel(self) -> io::Result<Channel> {
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

/// How large the samples of a channel in memory are.
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
            findings: recording.findings,
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
