//! An axis as the caller asks for it.

use super::PictureError;

/// A quantity along one side of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What is shown, in words: `Mean power`.
    pub quantity: String,
    /// Its SI unit as text: `W/N^2`, `ohm`, empty for a pure number. Tick labels get a prefix (`µW/N²`) where that makes them short.
    pub unit: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Both ends; where absent, the data decide.
    pub range: Option<(f64, f64)>,
    /// Distance of the labelled ticks of a linear axis; where absent, the range decides.
    pub step: Option<f64>,
}

/// How an axis divides its length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios; values at or below zero are not drawn.
    Log,
}

impl Axis {
    /// A linear axis that spans its data.
    pub fn linear(quantity: &str, unit: &str) -> Self {
        Self {
            quantity: quantity.to_owned(),
            unit: unit.to_owned(),
            scale: Scale::Linear,
            range: None,
            step: None,
        }
    }

    /// A logarithmic axis that spans its data.
    pub fn log(quantity: &str, unit: &str) -> Self {
        Self {
            scale: Scale::Log,
            ..Self::linear(quantity, unit)
        }
    }

    /// An axis of the given scale that spans its data.
    pub fn of(scale: Scale, quantity: &str, unit: &str) -> Self {
        Self {
            scale,
            ..Self::linear(quantity, unit)
        }
    }

    /// The same from `low` to `high`.
    #[must_use]
    pub fn between(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// The same with a labelled tick at every multiple of `step`.
    #[must_use]
    pub fn every(mut self, step: f64) -> Self {
        self.step = Some(step);
        self
    }

    /// The range asked for, if it is one.
    pub(super) fn checked_range(&self) -> Result<Option<(f64, f64)>, PictureError> {
        let log = self.scale == Scale::Log;
        let fits = |(low, high): (f64, f64)| {
            low < high
                && low.abs() <= MAX_PLOTTED_VALUE
                && high.abs() <= MAX_PLOTTED_VALUE
                && (!log || low > 0.0)
        };
        match self.range {
            Some((low, high)) if !fits((low, high)) => Err(PictureError::Range {
                axis: self.quantity.clone(),
                low,
                high,
                log,
            }),
            range => Ok(range),
        }
    }
}

/// Values beyond this cannot be placed without overflow; they are treated as gaps.
pub(super) const MAX_PLOTTED_VALUE: f64 = 1e300;
