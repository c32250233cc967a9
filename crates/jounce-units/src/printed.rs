//! Printing of a quantity as short text.

use super::Quantity;

impl Quantity {
    /// Prints a value in SI with the unit that gives the shortest number; [`Quantity::read`]
    /// returns the same bits.
    ///
    /// ```
    /// use jounce_units::Quantity;
    /// assert_eq!(Quantity::Pressure.write(65e9), "65 GPa");
    /// ```
    pub fn write(self, value: f64) -> String {
        let shortest = format!("{value:e}");
        let (mantissa, exponent) = shortest.split_once('e').unwrap_or((&shortest, "0"));
        let exponent = exponent.parse::<i32>().unwrap_or(0);
        let scales = self.scales();
        let fitting = scales
            .iter()
            .rev()
            .find(|(_, power)| *power <= exponent)
            .or(scales.first());
        let (unit, power) = match fitting {
            Some(scale) if value != 0.0 && value.is_finite() => scale.clone(),
            _ => (self.si_unit(), 0),
        };
        format!("{} {unit}", shifted(mantissa, exponent - power))
    }

    /// Prints a value in SI as [`Quantity::write`], rounded to a number of significant digits.
    ///
    /// ```
    /// use jounce_units::Quantity;
    /// assert_eq!(Quantity::Frequency.write_rounded(7079.46, 4), "7.079 kHz");
    /// ```
    pub fn write_rounded(self, value: f64, digits: usize) -> String {
        let rounded = format!("{value:.*e}", digits.saturating_sub(1));
        self.write(rounded.parse().unwrap_or(value))
    }
}

/// Returns a mantissa `d.ddd` with its decimal point moved right by `exponent` places; large shifts
/// retain an exponent.
fn shifted(mantissa: &str, exponent: i32) -> String {
    if exponent == 0 || !mantissa.contains(|c: char| c.is_ascii_digit()) {
        return mantissa.to_owned();
    }
    if !(-3..=9).contains(&exponent) {
        return format!("{mantissa}e{exponent}");
    }
    let (sign, unsigned) = mantissa
        .strip_prefix('-')
        .map_or(("", mantissa), |rest| ("-", rest));
    let digits = unsigned.replace('.', "");
    let point = 1 + exponent;
    if point <= 0 {
        return format!(
            "{sign}0.{}{digits}",
            "0".repeat(point.unsigned_abs() as usize)
        );
    }
    let point = point.unsigned_abs() as usize;
    if digits.len() <= point {
        return format!("{sign}{digits}{}", "0".repeat(point - digits.len()));
    }
    format!("{sign}{}.{}", &digits[..point], &digits[point..])
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn printed_values_are_short() {
        for (quantity, value, text) in [
            (Quantity::Length, 0.98e-3, "980 um"),
            (Quantity::Length, 0.315, "315 mm"),
            (Quantity::Length, 1.5, "1.5 m"),
            (Quantity::Length, -1e-3, "-1 mm"),
            (Quantity::Length, 0.0, "0 m"),
            (Quantity::Resistance, 1e6, "1 Mohm"),
            (Quantity::ChargePerForce, -170e-12, "-170 pC/N"),
            (Quantity::Density, 5440.0, "5440 kg/m^3"),
            (
                Quantity::ContactStiffness { exponent: 1.5 },
                1e10,
                "1e10 N/m^1.5",
            ),
            (Quantity::Force, 1e-30, "1e-27 mN"),
        ] {
            assert_eq!(quantity.write(value), text);
        }
    }

    #[test]
    fn rounded_values_have_the_digits_of_the_largest_power() {
        for (quantity, value, digits, text) in [
            (Quantity::Frequency, 7079.46, 4, "7.079 kHz"),
            (Quantity::Frequency, 0.197_68, 4, "197.7 mHz"),
            (Quantity::Time, 3.1236e-4, 3, "312 us"),
            (Quantity::Length, 9.9996e-3, 4, "10 mm"),
            (Quantity::Length, -0.0, 4, "-0 m"),
            (Quantity::Power, f64::NAN, 4, "NaN W"),
        ] {
            assert_eq!(quantity.write_rounded(value, digits), text);
        }
    }

    proptest::proptest! {
        #[test]
        fn printing_and_reading_gives_the_same_bits(value in proptest::num::f64::NORMAL | proptest::num::f64::ZERO) {
            let contact = Quantity::ContactStiffness { exponent: 1.37 };
            for quantity in [Quantity::Length, Quantity::Pressure, Quantity::ChargePerForce, Quantity::Frequency, Quantity::Angle, contact] {
                let text = quantity.write(value);
                proptest::prop_assert_eq!(quantity.read(&text).unwrap().to_bits(), value.to_bits(), "{}", text);
            }
        }
    }
}
