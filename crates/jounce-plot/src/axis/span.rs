//! An axis with fixed ends: position of a value along it.
//!
//! Linear: `(x - low) / (high - low)`; logarithmic: `ln(x / low) / ln(high / low)`; 0 at the low
//! end, 1 at the high end.

use super::MAX_PLOTTED_VALUE;
use crate::{Axis, PictureError, Scale};

/// Both ends of an axis and its scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    pub low: f64,
    pub high: f64,
    pub scale: Scale,
}

impl Span {
    /// Returns the requested range, or one that holds all drawable data with `margin` (a fraction
    /// of the span) at both ends.
    pub fn settle(
        axis: &Axis,
        data: impl Iterator<Item = f64>,
        margin: f64,
    ) -> Result<Self, PictureError> {
        let (low, high) = match axis.checked_range()? {
            Some(range) => range,
            None => around(axis.scale, data, margin),
        };
        Ok(Self {
            low,
            high,
            scale: axis.scale,
        })
    }

    /// Returns the position of a value, 0 at the low end and 1 at the high end; `None` for values
    /// that cannot be drawn.
    pub fn fraction(&self, value: f64) -> Option<f64> {
        if !drawable(self.scale, value) {
            return None;
        }
        Some(match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => (value / self.low).log10() / (self.high / self.low).log10(),
        })
    }

    /// True where a value lies between the ends, apart from rounding.
    pub fn holds(&self, value: f64) -> bool {
        self.fraction(value)
            .is_some_and(|position| (-1e-9..=1.0 + 1e-9).contains(&position))
    }
}

fn drawable(scale: Scale, value: f64) -> bool {
    value.abs() <= MAX_PLOTTED_VALUE && (scale == Scale::Linear || value > 1.0 / MAX_PLOTTED_VALUE)
}

fn around(scale: Scale, data: impl Iterator<Item = f64>, margin: f64) -> (f64, f64) {
    let (low, high) = data
        .filter(|&x| drawable(scale, x))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
    match scale {
        Scale::Linear if low > high => (0.0, 1.0),
        Scale::Log if low > high => (1.0, 10.0),
        Scale::Linear => widen(low, high, margin),
        Scale::Log if high < low * 1.000_001 => (low / 3.0, high * 3.0),
        Scale::Log => {
            let factor = (high / low).powf(margin);
            (low / factor, high * factor)
        }
    }
}

/// Widens a span too narrow for distinct tick labels to a readable range around its value.
fn widen(low: f64, high: f64, margin: f64) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    if size < 1.0 / MAX_PLOTTED_VALUE {
        (-1.0, 1.0)
    } else if high - low < 1e-6 * size {
        (low - 0.1 * size, high + 0.1 * size)
    } else {
        let gap = (high - low) * margin;
        // Positive data close to zero start there.
        (
            if low > 0.0 && low < gap {
                0.0
            } else {
                low - gap
            },
            high + gap,
        )
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn settled(axis: &Axis, data: &[f64]) -> (f64, f64) {
        let span = Span::settle(axis, data.iter().copied(), 0.1).unwrap();
        (span.low, span.high)
    }

    #[test]
    fn data_with_gaps_outliers_or_nothing_give_a_range() {
        let (linear, log) = (Axis::linear("a", ""), Axis::log("a", ""));
        assert_eq!(
            settled(&linear, &[f64::NAN, 0.0, 10.0, f64::INFINITY, 1e305]),
            (-1.0, 11.0)
        );
        assert_eq!(settled(&linear, &[]), (0.0, 1.0));
        assert_eq!(settled(&linear, &[0.0, 0.0]), (-1.0, 1.0));
        assert_eq!(settled(&linear, &[5.0, 5.0]), (4.5, 5.5));
        assert_eq!(settled(&log, &[-1.0, 0.0]), (1.0, 10.0));
        let (low, high) = settled(&log, &[0.0, 1.0, 1e10]);
        assert!((low - 0.1).abs() < 1e-12 && (high - 1e11).abs() < 1.0);
    }

    #[test]
    fn positions_follow_the_scale() {
        let log = Span {
            low: 1.0,
            high: 1e4,
            scale: Scale::Log,
        };
        assert!((log.fraction(100.0).unwrap() - 0.5).abs() < 1e-15);
        assert!(log.fraction(0.0).is_none() && log.fraction(f64::NAN).is_none() && !log.holds(1e5));
        assert_eq!(
            Span {
                low: -1.0,
                high: 3.0,
                scale: Scale::Linear
            }
            .fraction(0.0),
            Some(0.25)
        );
    }

    #[test]
    fn reversed_infinite_and_non_positive_log_ranges_are_errors() {
        for (low, high) in [
            (1.0, 1.0),
            (2.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ] {
            let axis = Axis::linear("Power", "W").between(low, high);
            assert!(matches!(
                Span::settle(&axis, std::iter::empty(), 0.0),
                Err(PictureError::Range { .. })
            ));
        }
        let fault = Span::settle(
            &Axis::log("Power", "W").between(0.0, 1.0),
            std::iter::empty(),
            0.0,
        )
        .unwrap_err()
        .to_string();
        assert!(
            fault.contains("\"Power\"") && fault.contains("> 0"),
            "{fault}"
        );
    }
}
