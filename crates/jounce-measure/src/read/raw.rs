//! What a format's reader finds, before names, units and time are settled.

use crate::recording::{Finding, FindingKind, Over, Place};

/// Columns of equal length as they stand in a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Raw {
    /// Title of the data set; empty where it has none.
    pub title: String,
    pub over: Over,
    pub stamps: Stamps,
    pub channels: Vec<RawChannel>,
    pub findings: Vec<Finding>,
}

/// How a file tells when its samples were taken.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Stamps {
    /// By a start and a step, in SI.
    Even { start: f64, step: f64 },
    /// By stamps in SI.
    Given(Vec<f64>),
    /// By one of the columns, or not at all.
    Column,
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
    /// The samples, real parts of complex ones.
    pub values: Vec<f64>,
    /// Imaginary parts of a complex column, as many.
    pub imaginary: Option<Vec<f64>>,
}

impl RawChannel {
    /// A real column without place and direction.
    pub fn new(name: &str, unit: &str, values: Vec<f64>) -> Self {
        Self { name: name.to_owned(), unit: unit.to_owned(), values, ..Self::default() }
    }

    /// Levels `L` in decibels to amplitudes `10^(L/20)` in the unit that stands behind `re`, in brackets, or alone.
    pub(super) fn made_linear(&mut self) -> Option<Finding> {
        self.values.iter_mut().for_each(|level| *level = 10f64.powf(*level / 20.0));
        let unit = self.unit.trim().trim_start_matches(['d', 'D', 'b', 'B']).trim();
        let unit = unit.trim_start_matches("re").trim().trim_start_matches("1 ").trim_matches(['(', ')', '[', ']']).to_owned();
        let about =
            format!("levels in decibels became amplitudes 10^(L/20) in {}", if unit.is_empty() { "an unknown unit" } else { &unit });
        self.unit = unit;
        Some(Finding::new(FindingKind::Decibels, self.values.len(), Some(Place::Sample(0)), about).of(&self.name))
    }
}

impl Raw {
    /// Columns over a time that one of them may hold.
    pub(super) fn columns(channels: Vec<RawChannel>, findings: Vec<Finding>) -> Self {
        Self { title: String::new(), over: Over::Time, stamps: Stamps::Column, channels, findings }
    }
}
