//! Allowed values of a number.

use super::Kind;

/// Limits of a number in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Range {
    /// Smallest allowed value.
    pub(crate) low: f64,
    /// True when `low` itself is not allowed.
    pub(crate) open: bool,
    /// Largest allowed value.
    pub(crate) high: f64,
}

impl Range {
    /// Any finite number.
    pub(crate) const ANY: Self = Self {
        low: f64::NEG_INFINITY,
        open: false,
        high: f64::INFINITY,
    };
    /// Greater than zero.
    pub(crate) const POSITIVE: Self = Self::above(0.0, f64::INFINITY);
    /// Zero or more.
    pub(crate) const NOT_NEGATIVE: Self = Self::from(0.0, f64::INFINITY);

    /// `low <= x <= high`.
    pub(crate) const fn from(low: f64, high: f64) -> Self {
        Self {
            low,
            open: false,
            high,
        }
    }

    /// `low < x <= high`.
    pub(crate) const fn above(low: f64, high: f64) -> Self {
        Self {
            low,
            open: true,
            high,
        }
    }

    /// True if the value is within the limits and its magnitude is computable.
    pub(crate) fn holds(&self, value: f64) -> bool {
        self.limits_hold(value) && is_in_physical_range(value)
    }

    fn limits_hold(&self, value: f64) -> bool {
        let above = if self.open {
            value > self.low
        } else {
            value >= self.low
        };
        value.is_finite() && above && value <= self.high
    }

    /// Returns the rule that a value violates.
    pub(crate) fn broken(&self, value: f64, kind: Kind) -> String {
        if self.limits_hold(value) {
            return format!(
                "must be 0 or have a magnitude from {MIN_SIZE:e} to {MAX_SIZE:e} in SI units"
            );
        }
        self.rule(kind)
    }

    /// Returns the limits as text, `"must be from 1 uHz to 1 MHz"`, in units of the kind.
    pub(crate) fn rule(&self, kind: Kind) -> String {
        let low = match (self.low.is_finite(), self.open) {
            (false, _) => None,
            (true, true) => Some(format!("greater than {}", kind.show(self.low))),
            (true, false) => Some(format!("at least {}", kind.show(self.low))),
        };
        let high = self
            .high
            .is_finite()
            .then(|| format!("at most {}", kind.show(self.high)));
        match (low, high) {
            (Some(_), Some(_)) if !self.open => format!(
                "must be from {} to {}",
                kind.show(self.low),
                kind.show(self.high)
            ),
            (Some(low), Some(high)) => format!("must be {low} and {high}"),
            (Some(limit), None) | (None, Some(limit)) => format!("must be {limit}"),
            (None, None) => "must be a finite number".to_owned(),
        }
    }
}

/// Largest magnitude of a nonzero number of a spec, SI; products and squares stay far from
/// overflow.
const MAX_SIZE: f64 = 1e30;
/// Smallest magnitude of a nonzero number of a spec, SI.
const MIN_SIZE: f64 = 1e-30;

fn is_in_physical_range(value: f64) -> bool {
    let size = value.abs();
    size == 0.0 || (MIN_SIZE..=MAX_SIZE).contains(&size)
}
