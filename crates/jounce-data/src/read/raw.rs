//! What a format's reader finds, before names, units and time are settled.

use super::decibels::Decibels;
use super::numbers::ColumnNumbers;
use crate::recording::{Issue, IssueKind, IssuePlace, Over, Series};

/// Columns of equal length as they stand in a file.
#[derive(Debug)]
pub(super) struct Raw {
    /// Title of the data set; empty where it has none.
    pub title: String,
    pub over: Over,
    pub stamps: TimeStamps,
    pub columns: Vec<RawColumn>,
    pub findings: Vec<Issue>,
}

/// How a file tells when its samples were taken.
#[derive(Debug)]
pub(super) enum TimeStamps {
    /// By a start and a step, in SI.
    Even { start: f64, step: f64 },
    /// By stamps in SI.
    Given(ColumnNumbers),
    /// By one of the columns, or not at all; columns have no names of their own, so that a first one that rises evenly may be meant.
    Column,
    /// By a column whose name or unit says so, or not at all.
    Named,
    /// By one of the columns, or else by a number that tells the rate.
    Rate(Rate),
    /// By that column, counted from 0, beside which a number may tell the rate.
    Of { column: usize, rate: Option<Rate> },
    /// By a header with a rate and a start, and by stamps or one of the columns where there are any.
    Header(Header),
}

/// What a header says of the time.
#[derive(Debug)]
pub(super) struct Header {
    pub rate: Rate,
    /// Of the first sample, s.
    pub start: f64,
    /// Stamps in SI beside it.
    pub stamps: Option<ColumnNumbers>,
}

/// Relative difference up to which two rates are the same.
pub(super) const SAME_RATE: f64 = 1e-3;

/// A number of a file that tells the rate of its samples.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rate {
    /// Its name and value as they stand there, `fs = 2048`.
    pub told: String,
    /// Samples per second, Hz.
    pub rate_hz: f64,
}

impl Rate {
    pub fn differs_from(&self, rate_hz: f64) -> bool {
        (self.rate_hz / rate_hz - 1.0).abs() > SAME_RATE
    }
}

/// A column as it stands in a file, its numbers wherever they were put.
#[derive(Debug)]
pub(super) struct RawColumn {
    pub name: String,
    pub unit: String,
    pub place: String,
    pub direction: String,
    pub reference: String,
    /// Why it is no channel, one sentence, or an empty text where nobody would take it for one; none for a channel.
    pub left_out: Option<String>,
    /// The samples, real parts of complex ones.
    pub values: ColumnNumbers,
    /// Imaginary parts of a complex column, as many.
    pub imaginary: Option<ColumnNumbers>,
}

/// A column as it stands in a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RawChannel {
    /// Its name.
    pub name: String,
    /// Its unit as an instrument writes it; empty where nothing is told.
    pub unit: String,
    /// Where the sensor sits; empty where nothing is told.
    pub place: String,
    /// Which way it points; empty where nothing is told.
    pub direction: String,
    /// Where and which way the force of a response function acts, as `node 3 +z`; empty where nothing is told.
    pub reference: String,
    /// The samples, real parts of complex ones.
    pub values: Vec<f64>,
    /// Imaginary parts of a complex column, as many.
    pub imaginary: Option<Vec<f64>>,
}

impl RawChannel {
    /// A real column without place and direction.
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
    /// A real column without place and direction.
    pub(super) fn new(name: &str, unit: &str, values: ColumnNumbers) -> Self {
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

    /// Levels `L` in decibels to amplitudes `10^(L/20)`, or densities `10^(L/10)`, times their reference, in its unit.
    pub(super) fn made_linear(&mut self, levels: Decibels) -> Issue {
        let Decibels {
            reference,
            unit,
            decade,
        } = levels;
        self.values.made_linear(decade);
        self.values.scale(reference);
        let sizes = if decade == 20.0 {
            "amplitudes"
        } else {
            "densities"
        };
        let times = if reference == 1.0 {
            String::new()
        } else {
            format!("{reference:e} times ")
        };
        let of = if unit.is_empty() {
            "an unknown unit"
        } else {
            &unit
        };
        let about = format!("levels in decibels became {sizes} {times}10^(L/{decade}) in {of}");
        self.unit = unit;
        Issue::new(
            IssueKind::Decibels,
            self.values.count(),
            Some(IssuePlace::Sample(0)),
            about,
        )
        .of(&self.name)
    }
}

impl Raw {
    /// Columns over a time that one of them may hold.
    pub(super) fn columns(columns: Vec<RawColumn>, findings: Vec<Issue>) -> Self {
        Self {
            title: String::new(),
            over: Over::Time,
            stamps: TimeStamps::Column,
            columns,
            findings,
        }
    }
}
