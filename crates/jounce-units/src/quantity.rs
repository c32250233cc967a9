//! Kinds of quantity in a spec, their reading and printing.

use super::clip::clip;
use super::decimal::Decimal;
use super::error::QuantityError;
use super::expression::{Unit, UnitFault};
use std::borrow::Cow;

/// Largest number of characters of a quantity.
pub(super) const MAX_CHARS: usize = 200;

/// A kind of quantity; its value is always in the SI unit named here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// m
    Length,
    /// m^3
    Volume,
    /// kg
    Mass,
    /// s
    Time,
    /// Hz
    Frequency,
    /// N
    Force,
    /// Pa
    Pressure,
    /// kg/m^3
    Density,
    /// m/V, equal to C/N
    ChargePerForce,
    /// F
    Capacitance,
    /// ohm
    Resistance,
    /// N/m
    Stiffness,
    /// N/m^exponent
    ContactStiffness {
        /// dimensionless
        exponent: f64,
    },
    /// N s/m
    Damping,
    /// s/m
    InverseSpeed,
    /// m/s
    Speed,
    /// m/s^2; `g` is 9.80665 m/s^2
    Acceleration,
    /// (m/s^2)^2/Hz, one-sided; `g^2/Hz` is 9.80665^2 (m/s^2)^2/Hz
    AccelerationPsd,
    /// N^2/Hz, one-sided
    ForcePsd,
    /// rad
    Angle,
    /// kg m^2
    RotaryInertia,
    /// N m/rad
    RotaryStiffness,
    /// H
    Inductance,
    /// F/m
    Permittivity,
    /// V
    Voltage,
    /// A
    Current,
    /// W
    Power,
    /// dimensionless
    Strain,
}

impl Quantity {
    /// Reads `"NUMBER UNIT"` and returns the value in SI.
    ///
    /// # Errors
    /// A text without a number, without a unit, with an unknown unit or with a unit of another
    /// kind.
    ///
    /// # Validation
    /// `crates/jounce-units/src/quantity/tests.rs`: bit for bit the literal wherever the factor is
    /// a power of ten.
    ///
    /// ```
    /// use jounce_units::Quantity;
    /// assert_eq!(Quantity::Length.read("0.98 mm"), Ok(0.98e-3));
    /// assert!(Quantity::Frequency.read("13 mm").is_err());
    /// ```
    pub fn read(self, text: &str) -> Result<f64, QuantityError> {
        let (number, unit) = self.split(text)?;
        let integer_exponent = unit.power_of_ten.floor();
        let decimal = number.scaled(integer_exponent as i64);
        let value =
            decimal * unit.up / unit.down * 10f64.powf(unit.power_of_ten - integer_exponent);
        let underflows = value == 0.0 && !number.is_zero();
        if !value.is_finite() || underflows {
            return Err(QuantityError::NotRepresentable {
                text: clip(text),
                unit: self.si_unit(),
            });
        }
        Ok(value)
    }

    /// Returns a text as integer digits times a power of ten, if it has exactly that value in SI.
    pub fn exact(self, text: &str) -> Option<(i128, i64)> {
        let (number, unit) = self.split(text).ok()?;
        let decimal = unit.up == 1.0 && unit.down == 1.0 && unit.power_of_ten.fract() == 0.0;
        if decimal {
            number.integer_ratio(unit.power_of_ten as i64)
        } else {
            None
        }
    }

    fn split(self, text: &str) -> Result<(Decimal<'_>, Unit), QuantityError> {
        let (quoted, expected) = (clip(text), || self.expectation());
        if text.chars().count() > MAX_CHARS {
            return Err(QuantityError::Malformed {
                text: quoted,
                reason: format!("longer than {MAX_CHARS} characters"),
                expected: expected(),
            });
        }
        let text = text.trim();
        let Some((number, rest)) = Decimal::split(text) else {
            return Err(QuantityError::NotANumber {
                text: quoted,
                expected: expected(),
            });
        };
        if rest.trim().is_empty() {
            return Err(QuantityError::NoUnit {
                text: quoted,
                expected: expected(),
            });
        }
        if rest.starts_with(',') {
            return Err(QuantityError::Malformed {
                text: quoted,
                reason: "write decimals with a point, not a comma".to_owned(),
                expected: expected(),
            });
        }
        let unit = Unit::parse(&self.spelled(rest)).map_err(|refusal| match refusal {
            UnitFault::Unknown(unit) => QuantityError::UnknownUnit {
                text: quoted.clone(),
                near: self.near(&unit),
                unit,
                expected: expected(),
            },
            UnitFault::Malformed(reason) => QuantityError::Malformed {
                text: quoted.clone(),
                reason,
                expected: expected(),
            },
        })?;
        if !unit.dimension.is(self.dimension()) {
            return Err(QuantityError::WrongKind {
                text: quoted,
                kind: unit.dimension.kind(),
                expected: expected(),
            });
        }
        Ok((number, unit))
    }

    /// Returns the unit, with `g` as the acceleration of gravity if an acceleration is expected.
    fn spelled(self, unit: &str) -> Cow<'_, str> {
        if !matches!(self, Self::Acceleration | Self::AccelerationPsd) {
            return Cow::Borrowed(unit);
        }
        let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
        let is_separate = |at: usize| {
            !is_letter(unit[..at].chars().next_back()) && !is_letter(unit[at + 1..].chars().next())
        };
        let mut spelled = String::with_capacity(unit.len() + 1);
        for (at, c) in unit.char_indices() {
            spelled.push(c);
            if c == 'g' && is_separate(at) {
                spelled.push('n');
            }
        }
        Cow::Owned(spelled)
    }
}

/// True for the text of a unit of any kind.
///
/// ```
/// assert!(jounce_units::is_unit("kohm") && !jounce_units::is_unit("furlong"));
/// ```
pub fn is_unit(text: &str) -> bool {
    Unit::parse(text).is_ok()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
