//! What is odd about a recording.

use serde::Serialize;

/// Something that a reader noticed or did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Issue {
    /// What it is.
    pub kind: IssueKind,
    /// The channel; none where it concerns the whole recording.
    pub channel: Option<String>,
    /// How many samples, stamps, lines or data sets.
    pub count: usize,
    /// Where the first one is.
    pub first: Option<IssuePlace>,
    /// One sentence with the numbers.
    pub about: String,
}

/// A place in a file or a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum IssuePlace {
    /// Number of a sample, from 0.
    Sample(usize),
    /// Number of a line, from 1.
    Line(usize),
    /// Number of a byte, from 0.
    Byte(usize),
}

/// Kinds of findings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum IssueKind {
    /// Time stamps do not lie at even places.
    Jitter,
    /// Samples are missing between two stamps.
    Gap,
    /// A stamp that is not later than the one before.
    RepeatedStamp,
    /// Time stamps with so few digits that only all of them together show their even places.
    RoundedStamps,
    /// A channel that holds the time, or counts the samples.
    EqualsTime,
    /// The header's step is not that of the stamps.
    RescaledStamps,
    /// The header says something else than the data.
    HeaderDisagrees,
    /// Samples that are no numbers.
    NotANumber,
    /// Exact zeros before the signal begins or after it ends.
    ZeroPadding,
    /// Flat tops at the largest or smallest value.
    Clipping,
    /// Whole numbers without unit: counts of a converter.
    RawCounts,
    /// All samples are equal.
    Constant,
    /// Levels in decibels made linear.
    Decibels,
    /// Values converted to SI.
    Converted,
    /// A unit that is not known; values are as in the file.
    UnknownUnit,
    /// A unit with characters outside ASCII.
    NonAsciiUnit,
    /// Text that is not UTF-8, read as Latin-1.
    Encoding,
    /// Lines with too few or too many fields.
    Ragged,
    /// Something in the file that was left out.
    Skipped,
    /// Missing samples replaced by straight lines.
    Bridged,
    /// Samples interpolated at even times.
    Resampled,
    /// The mean taken away.
    MeanRemoved,
    /// The structure still rings from one hit when the next one comes.
    Ringing,
    /// A part of a longer recording.
    Cut,
    /// Made by a model, and how.
    Simulated,
    /// Assumed, since nothing is told.
    Assumed,
}

impl IssueKind {
    /// True for what changes no number of an answer.
    pub fn is_note(self) -> bool {
        matches!(self, Self::NonAsciiUnit | Self::Encoding | Self::Converted)
    }
}

impl Issue {
    /// A finding about a whole recording.
    pub fn new(kind: IssueKind, count: usize, first: Option<IssuePlace>, about: String) -> Self {
        Self {
            kind,
            channel: None,
            count,
            first,
            about,
        }
    }

    /// The same about one channel.
    #[must_use]
    pub fn of(mut self, channel: &str) -> Self {
        self.channel = Some(channel.to_owned());
        self
    }
}

impl std::fmt::Display for IssuePlace {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Sample(number) => write!(to, "sample {number}"),
            Self::Line(number) => write!(to, "line {number}"),
            Self::Byte(number) => write!(to, "byte {number}"),
        }
    }
}

impl std::fmt::Display for Issue {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(channel) = &self.channel {
            write!(to, "{channel}: ")?;
        }
        write!(to, "{}", self.about)?;
        match self.first {
            Some(first) if self.count > 1 => {
                write!(to, " ({} times, first at {first})", self.count)
            }
            Some(first) => write!(to, " (at {first})"),
            None => Ok(()),
        }
    }
}
