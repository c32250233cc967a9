//! Axis of a panel.

pub(super) mod span;
mod tick_positions;
pub(super) mod ticks;
pub(super) mod unit;

use super::PictureError;

/// A quantity along one side of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name of the quantity: `Mean power`.
    pub quantity: String,
    /// SI unit as text: `W/N^2`, `ohm`, empty for a pure number. Tick labels get a prefix (`µW/N²`)
    /// where that makes them short.
    pub unit: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Both ends; if absent, the data determine them.
    pub range: Option<(f64, f64)>,
    /// Distance of the labelled ticks of a linear axis; if absent, the range determines it.
    pub step: Option<f64>,
}

/// Division of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios; values at or below zero are not drawn.
    Log,
}

impl Axis {
    /// Creates a linear axis that spans its data.
    pub fn linear(quantity: &str, unit: &str) -> Self {
        Self {
            quantity: quantity.to_owned(),
            unit: unit.to_owned(),
            scale: Scale::Linear,
            range: None,
            step: None,
        }
    }

    /// Creates a logarithmic axis that spans its data.
    pub fn log(quantity: &str, unit: &str) -> Self {
        Self {
            scale: Scale::Log,
            ..Self::linear(quantity, unit)
        }
    }

    /// Creates an axis of the given scale that spans its data.
    pub fn of(scale: Scale, quantity: &str, unit: &str) -> Self {
        Self {
            scale,
            ..Self::linear(quantity, unit)
        }
    }

    /// Sets the range from `low` to `high`.
    #[must_use]
    pub fn between(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// Sets a labelled tick at every multiple of `step`.
    #[must_use]
    pub fn every(mut self, step: f64) -> Self {
        self.step = Some(step);
        self
    }

    /// Returns the requested range, if it is valid.
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

/// Larger values cannot be placed without overflow; they are treated as gaps.
pub(super) const MAX_PLOTTED_VALUE: f64 = 1e300;
