//! Axis of a panel.

mod log_labels;
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

    /// Creates an axis that spans its data, logarithmic where the values of a parameter are at equal
    /// ratios and not at equal distances.
    pub fn for_steps(quantity: &str, unit: &str, values: &[f64]) -> Self {
        Self::of(scale_of_steps(values), quantity, unit)
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

/// Relative difference up to which two distances or two ratios are equal: values are rounded.
const EQUAL_STEPS: f64 = 1e-6;

/// Returns the scale on which values, in any order, are at equal distances; linear where they are
/// at neither equal distances nor equal ratios.
fn scale_of_steps(values: &[f64]) -> Scale {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let is_even = |place: fn(f64) -> f64| {
        let distances: Vec<f64> = sorted
            .windows(2)
            .map(|pair| place(pair[1]) - place(pair[0]))
            .collect();
        let first = distances[0];
        distances
            .iter()
            .all(|distance| (distance - first).abs() <= EQUAL_STEPS * first)
    };
    match sorted.as_slice() {
        [first, _, _, ..] if *first > 0.0 && !is_even(|x| x) && is_even(f64::ln) => Scale::Log,
        _ => Scale::Linear,
    }
}

/// Larger values cannot be placed without overflow; they are treated as gaps.
pub(super) const MAX_PLOTTED_VALUE: f64 = 1e300;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_values_at_equal_ratios_have_a_logarithmic_axis() {
        let decade: Vec<f64> = (0..7)
            .map(|k| 1e4 * 10_f64.powf(f64::from(k) / 3.0))
            .collect();
        let both_ways = [decade.clone(), decade.iter().rev().copied().collect()].concat();
        for values in [decade, both_ways, vec![1.0, 2.0, 4.0]] {
            assert_eq!(scale_of_steps(&values), Scale::Log, "{values:?}");
        }
        let even: Vec<f64> = (0..9).map(|k| 10.0 + 0.1 * f64::from(k)).collect();
        for values in [
            even,
            vec![],
            vec![1.0],
            vec![1.0, 10.0],
            vec![1.0, 2.0, 5.0],
            vec![0.0, 1.0, 10.0],
        ] {
            assert_eq!(scale_of_steps(&values), Scale::Linear, "{values:?}");
        }
    }
}
