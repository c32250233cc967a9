//! Kinds of quantity in a spec, their reading and printing.

use super::clip::clip;
use super::decimal::Decimal;
use super::error::QuantityError;
use super::expression::{Unit, UnitFault};
use std::borrow::Cow;

/// Largest number of characters of a quantity.
const MAX_CHARS: usize = 200;

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
    /// `units::quantity::tests::values_are_the_nearest_floats`: bit for bit the literal wherever
    /// the factor is a power of ten.
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
mod tests {
    use super::*;

    #[test]
    fn values_are_the_nearest_floats() {
        let contact = Quantity::ContactStiffness { exponent: 1.5 };
        for (quantity, text, value) in [
            (Quantity::Length, "0.98 mm", 0.98e-3),
            (Quantity::Length, "315 mm", 0.315),
            (Quantity::Length, "85 \u{b5}m", 85e-6),
            (Quantity::Pressure, "30.336 GPa", 30.336e9),
            (Quantity::Pressure, "65 kN/mm^2", 65e9),
            (Quantity::Density, "5440 kg/m^3", 5440.0),
            (Quantity::Density, "2.75 g/cm\u{b3}", 2750.0),
            (Quantity::ChargePerForce, "-170 pC/N", -170e-12),
            (Quantity::ChargePerForce, "-170 pm/V", -170e-12),
            (Quantity::Capacitance, "177 nF", 177e-9),
            (Quantity::Resistance, "1 Mohm", 1e6),
            (Quantity::Resistance, "1 k\u{3a9}", 1e3),
            (Quantity::Resistance, "0.1 \u{2126}", 0.1),
            (Quantity::Stiffness, "2 kN/mm", 2e6),
            (Quantity::Damping, "10 N s/m", 10.0),
            (Quantity::Damping, "10 N*s/m", 10.0),
            (Quantity::Damping, "10 N\u{b7}s\u{b7}m\u{207b}\u{b9}", 10.0),
            (contact, "1000 N/m^1.5", 1000.0),
            (contact, "1000 N/m^(3/2)", 1000.0),
            (contact, "1 kN m^-1.5", 1000.0),
            (Quantity::Frequency, "13Hz", 13.0),
            (Quantity::Frequency, "600 1/min", 10.0),
            (Quantity::Frequency, "600 rpm", 10.0),
            (Quantity::Frequency, "4 /s", 4.0),
            (Quantity::Time, "20 min", 1200.0),
            (Quantity::Angle, "180 deg", std::f64::consts::PI),
            (Quantity::Mass, "12 g", 0.012),
            (Quantity::Volume, "20 cm^3", 2e-5),
            (Quantity::InverseSpeed, "0.3 s/m", 0.3),
            (Quantity::Speed, "250 mm/s", 0.25),
            (Quantity::Acceleration, "9.81 m/s^2", 9.81),
            (Quantity::Acceleration, "2 g", 19.6133),
            (Quantity::AccelerationPsd, "3 (m/s^2)^2/Hz", 3.0),
            (Quantity::AccelerationPsd, "1 g^2/Hz", 9.80665 * 9.80665),
            (Quantity::ForcePsd, "0.5 N^2/Hz", 0.5),
            (Quantity::Strain, "400 ppm", 400e-6),
            (Quantity::Strain, "400 ustrain", 400e-6),
            (Quantity::Strain, "400 \u{b5}strain", 400e-6),
            (Quantity::Strain, "0.04 %", 400e-6),
            (Quantity::Strain, "400 um/m", 400e-6),
            (Quantity::Strain, "4e-4 strain", 400e-6),
        ] {
            assert_eq!(
                quantity.read(text).unwrap().to_bits(),
                f64::to_bits(value),
                "{text}"
            );
        }
        // 10^4.5 is not a power of ten with an integer exponent: one rounding more.
        let value = contact.read("1 N/mm^1.5").unwrap();
        assert!(
            (value / 31_622.776_601_683_793 - 1.0).abs() < 4e-16,
            "{value}"
        );
    }

    /// Texts that are refused: quantity, text, part of the message.
    const REFUSED: [(Quantity, &str, &str); 17] = [
        (
            Quantity::Frequency,
            "13 mm",
            "\"13 mm\" is a length; expected a frequency in Hz, kHz, 1/min",
        ),
        (
            Quantity::Frequency,
            "13 rad/s",
            "\"13 rad/s\" is an angular frequency; expected a frequency in Hz, kHz, 1/min",
        ),
        (
            Quantity::Frequency,
            "13",
            "13 has no unit; expected a frequency in Hz, kHz, 1/min",
        ),
        (
            Quantity::Force,
            "fifty N",
            "\"fifty N\" does not start with a number; expected a force in N, mN, kN",
        ),
        (
            Quantity::Force,
            "nan N",
            "\"nan N\" does not start with a number; expected a force in N, mN, kN",
        ),
        (
            Quantity::Force,
            "5 newtons",
            "\"5 newtons\": \"newtons\" is not a known unit; expected a force in N, mN, kN",
        ),
        (
            Quantity::Acceleration,
            "1 grms",
            "\"grms\" is not a known unit (did you mean g?; the key specifies whether the value is rms or zero to peak, a unit does not); expected an acceleration in m/s^2, g",
        ),
        (
            Quantity::Damping,
            "5 N/m s",
            "a product after a quotient is ambiguous; use parentheses, as in N/(m s)",
        ),
        (
            Quantity::Length,
            "1,5 mm",
            "write decimals with a point, not a comma",
        ),
        (
            Quantity::Length,
            "1e400 mm",
            "\"1e400 mm\" is too large or too small for a number in m",
        ),
        (
            Quantity::Length,
            "1e-400 mm",
            "\"1e-400 mm\" is too large or too small for a number in m",
        ),
        (
            Quantity::Pressure,
            "1 N/m2",
            "write a power with ^, as in m^2",
        ),
        (
            Quantity::Pressure,
            "1 N/m^99",
            "powers must be from -12 to 12",
        ),
        (
            Quantity::Pressure,
            "1 N/(m^2",
            "a parenthesis is not closed",
        ),
        (Quantity::Pressure, "1 N//m^2", "unexpected `/`"),
        (Quantity::Pressure, "1 N/", "the unit is incomplete"),
        (
            Quantity::ContactStiffness { exponent: 2.0 },
            "1 N/m^1.5",
            "is a contact stiffness in N/m^1.5; expected a contact stiffness in N/m^2, kN/m^2",
        ),
    ];

    #[test]
    fn wrong_texts_are_refused_with_the_units_that_fit() {
        for (quantity, text, message) in REFUSED {
            let refusal = quantity.read(text).unwrap_err().to_string();
            assert!(refusal.contains(message), "{text}: {refusal}");
        }
    }
}
