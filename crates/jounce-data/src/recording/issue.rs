//! Data-quality issues of a recording.

use serde::{Deserialize, Serialize};

/// Data-quality issue, or an operation on the data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Issue {
    /// Kind of the issue.
    pub kind: IssueKind,
    /// Channel; `None` for the complete recording.
    pub channel: Option<String>,
    /// Number of affected samples, stamps, lines or data sets.
    pub count: usize,
    /// Position of the first one.
    pub first: Option<IssuePlace>,
    /// One sentence with the numbers.
    pub about: String,
}

/// Position in a file or a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IssuePlace {
    /// Index of a sample, from 0.
    Sample(usize),
    /// Number of a line, from 1.
    Line(usize),
    /// Offset of a byte, from 0.
    Byte(usize),
}

/// Kinds of issues.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IssueKind {
    /// Time stamps are not uniform.
    Jitter,
    /// Samples are missing between two stamps.
    Gap,
    /// A stamp is not later than the previous one.
    RepeatedStamp,
    /// Time stamps are rounded; only all of them together show the uniform grid.
    RoundedStamps,
    /// A channel contains the time, or counts the samples.
    EqualsTime,
    /// The steps of header and stamps differ.
    RescaledStamps,
    /// The header contradicts the data.
    HeaderDisagrees,
    /// Samples are not numbers.
    NotANumber,
    /// One sample dominates all others.
    Outlier,
    /// Exact zeros precede or follow the signal.
    ZeroPadding,
    /// Flat tops at the largest or smallest value.
    Clipping,
    /// Integers without unit: counts of a converter.
    RawCounts,
    /// All samples are equal.
    Constant,
    /// Levels in decibels made linear.
    Decibels,
    /// Values converted to SI.
    Converted,
    /// A unit is not known; values are unchanged.
    UnknownUnit,
    /// A unit with characters outside ASCII.
    NonAsciiUnit,
    /// Text that is not UTF-8, read as Latin-1.
    Encoding,
    /// Lines with too few or too many fields.
    Ragged,
    /// A part of the file was left out.
    Skipped,
    /// Missing samples interpolated linearly.
    Bridged,
    /// Samples interpolated at uniform times.
    Resampled,
    /// The mean was subtracted.
    MeanRemoved,
    /// The structure still rings from one hit when the next one occurs.
    Ringing,
    /// Part of a longer recording.
    Cut,
    /// Simulated, with the method.
    Simulated,
    /// Assumed for lack of information.
    Assumed,
}

impl IssueKind {
    /// True for an issue without effect on the values of results.
    pub fn is_note(self) -> bool {
        matches!(self, Self::NonAsciiUnit | Self::Encoding | Self::Converted)
    }
}

impl Issue {
    /// Returns an issue of a complete recording.
    pub fn new(kind: IssueKind, count: usize, first: Option<IssuePlace>, about: String) -> Self {
        Self {
            kind,
            channel: None,
            count,
            first,
            about,
        }
    }

    /// Assigns the issue to a channel.
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
