//! Output of a format reader, before names, units and time are determined.

use crate::read::column::numbers::ColumnNumbers;
use crate::read::heading::decibels::Decibels;
use crate::recording::{Issue, IssueKind, IssuePlace, Over, Series};

/// Columns of equal length as stored in a file.
#[derive(Debug)]
pub(in crate::read) struct Raw {
    /// Title of the data set; empty if missing.
    pub title: String,
    pub over: Over,
    pub stamps: TimeStamps,
    pub columns: Vec<RawColumn>,
    pub issues: Vec<Issue>,
}

/// Source of the sampling times.
#[derive(Debug)]
pub(in crate::read) enum TimeStamps {
    /// Start and step, in SI units.
    Even { start: f64, step: f64 },
    /// Stamps in SI units.
    Explicit(ColumnNumbers),
    /// One of the columns, if any. Columns have no names, so the first one may be the time if it
    /// rises uniformly.
    Column,
    /// A column identified by name or unit, if any.
    Named,
    /// One of the columns, else a number that gives the rate.
    Rate(Rate),
    /// A given column, counted from 0, with a number that may give the rate.
    FromColumn { column: usize, rate: Option<Rate> },
    /// A header with rate and start, and stamps or one of the columns if present.
    Header(Header),
}

impl TimeStamps {
    /// True where a column may be the time.
    pub(in crate::read) fn may_be_in_a_column(&self) -> bool {
        match self {
            Self::Column | Self::Named | Self::Rate(_) | Self::FromColumn { .. } => true,
            Self::Header(header) => header.stamps.is_none(),
            Self::Even { .. } | Self::Explicit(_) => false,
        }
    }
}

/// Time information of a header.
#[derive(Debug)]
pub(in crate::read) struct Header {
    pub rate: Rate,
    /// Time of the first sample, s.
    pub start: f64,
    /// Stamps in SI units.
    pub stamps: Option<ColumnNumbers>,
}

/// Relative difference up to which two rates are the same.
pub(in crate::read) const SAME_RATE: f64 = 1e-3;

/// Sampling rate stored in a file.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::read) struct Rate {
    /// Name and value as stored, `fs = 2048`.
    pub source: String,
    /// Sampling rate, Hz.
    pub rate_hz: f64,
}

impl Rate {
    pub fn differs_from(&self, rate_hz: f64) -> bool {
        (self.rate_hz / rate_hz - 1.0).abs() > SAME_RATE
    }
}

/// Column as stored in a file, with its numbers in any store.
#[derive(Debug)]
pub(in crate::read) struct RawColumn {
    pub name: String,
    pub unit: String,
    pub place: String,
    pub direction: String,
    pub reference: String,
    /// Reason why the column is not a channel, one sentence; empty for an obvious case. `None` for
    /// a channel.
    pub left_out: Option<String>,
    /// Samples; real parts of complex ones.
    pub values: ColumnNumbers,
    /// Imaginary parts of a complex column, equally many.
    pub imaginary: Option<ColumnNumbers>,
}

/// Column as stored in a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RawChannel {
    /// Channel name.
    pub name: String,
    /// Unit in instrument notation; empty if not given.
    pub unit: String,
    /// Location of the sensor; empty if not given.
    pub place: String,
    /// Direction of the sensor; empty if not given.
    pub direction: String,
    /// Node and direction of the force of a response function, such as `node 3 +z`; empty if not
    /// given.
    pub reference: String,
    /// Samples; real parts of complex ones.
    pub values: Vec<f64>,
    /// Imaginary parts of a complex column, equally many.
    pub imaginary: Option<Vec<f64>>,
}

impl RawChannel {
    /// Returns a real column without location and direction.
    pub fn new(name: &str, unit: &str, values: Vec<f64>) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            values,
            ..Self::default()
        }
    }
}

impl From<RawChannel> for RawColumn {
    fn from(channel: RawChannel) -> Self {
        let RawChannel {
            name,
            unit,
            place,
            direction,
            reference,
            values,
            imaginary,
        } = channel;
        Self {
            name,
            unit,
            place,
            direction,
            reference,
            left_out: None,
            values: values.into(),
            imaginary: imaginary.map(ColumnNumbers::from),
        }
    }
}

impl RawColumn {
    /// Returns a real column without location and direction.
    pub(in crate::read) fn new(name: &str, unit: &str, values: ColumnNumbers) -> Self {
        let (name, unit) = (name.to_owned(), unit.to_owned());
        let [place, direction, reference] = [(); 3].map(|()| String::new());
        Self {
            name,
            unit,
            place,
            direction,
            reference,
            left_out: None,
            values,
            imaginary: None,
        }
    }

    /// Converts levels `L` in decibels to amplitudes `10^(L/20)`, or densities `10^(L/10)`, times
    /// their reference, in the unit of the reference.
    pub(in crate::read) fn convert_levels(&mut self, levels: Decibels) -> Issue {
        let Decibels {
            reference,
            unit,
            decade,
        } = levels;
        self.values.convert_levels(decade);
        self.values.scale(reference);
        let quantity_text = if decade == 20.0 {
            "amplitudes"
        } else {
            "densities"
        };
        let reference_text = if reference == 1.0 {
            String::new()
        } else {
            format!("{reference:e} times ")
        };
        let unit_text = if unit.is_empty() {
            "an unknown unit"
        } else {
            &unit
        };
        let message = format!(
            "levels in decibels were converted to {quantity_text} {reference_text}10^(L/{decade}) \
            in {unit_text}"
        );
        self.unit = unit;
        Issue::new(
            IssueKind::Decibels,
            self.values.count(),
            Some(IssuePlace::Sample(0)),
            message,
        )
        .of(&self.name)
    }
}

impl Raw {
    /// Returns columns that may include the time.
    pub(in crate::read) fn columns(columns: Vec<RawColumn>, issues: Vec<Issue>) -> Self {
        Self {
            title: String::new(),
            over: Over::Time,
            stamps: TimeStamps::Column,
            columns,
            issues,
        }
    }
}
