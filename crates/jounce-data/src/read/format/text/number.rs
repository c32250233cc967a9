//! Notations of numbers in text files.

use super::moment::Moment;

/// Contents of a text field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::read) enum TextField {
    /// A number.
    Real(f64),
    /// A complex number.
    Complex(f64, f64),
    /// A date, a time of day, or both.
    Moment(Moment),
    /// Empty, a word for a missing sample, or a sample beyond the range of an instrument.
    Missing,
    /// Any other text.
    Text,
}

/// Words for a missing sample, in lower case.
const MISSING_VALUE_TEXTS: [&str; 11] = [
    "",
    "nan",
    "na",
    "n/a",
    "null",
    "none",
    "-",
    "--",
    "\u{221e}",
    "-\u{221e}",
    "+\u{221e}",
];

impl TextField {
    /// Parses a field. `D` is also read as an exponent (Fortran); a comma is the decimal mark if
    /// requested.
    pub(in crate::read) fn read(text: &str, decimal_comma: bool) -> Self {
        let text = text.trim().trim_matches('"').trim();
        if let Ok(value) = text.parse::<f64>() {
            // `inf` and `nan` parse as numbers.
            return if value.is_finite() {
                Self::Real(value)
            } else {
                Self::Missing
            };
        }
        if MISSING_VALUE_TEXTS.contains(&text.to_ascii_lowercase().as_str()) {
            return Self::Missing;
        }
        let begins = text
            .starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | ',' | '('));
        if !begins {
            return Self::Text;
        }
        if decimal_comma && text.matches(',').count() == 1 && !text.contains('.') {
            return Self::read(&text.replace(',', "."), false);
        }
        if let Some(value) = fortran(text).or_else(|| hexadecimal(text)) {
            return Self::Real(value);
        }
        if let Some(moment) = Moment::read(text) {
            return Self::Moment(moment);
        }
        complex(text).map_or(Self::Text, |(re, im)| Self::Complex(re, im))
    }

    /// True for a field that may stand in a column of numbers.
    pub(in crate::read) fn is_sample(self) -> bool {
        self != Self::Text
    }

    /// True for a number, a date or a time.
    pub(in crate::read) fn is_value(self) -> bool {
        !matches!(self, Self::Text | Self::Missing)
    }
}

/// Parses `0x1f`, written by instruments for eight digital lines.
fn hexadecimal(text: &str) -> Option<f64> {
    let digits = text
        .strip_prefix("0x")
        .or_else(|| text.strip_prefix("0X"))
        .filter(|digits| !digits.starts_with('+'))?;
    u32::from_str_radix(digits, 16).ok().map(f64::from)
}

fn fortran(text: &str) -> Option<f64> {
    let has_fortran_exponent = text.bytes().filter(|b| matches!(b, b'D' | b'd')).count() == 1;
    if has_fortran_exponent {
        text.replace(['D', 'd'], "E").parse().ok()
    } else {
        None
    }
}

/// Parses `(re+imj)` as Python writes it, with or without brackets, `i` or `j`.
fn complex(text: &str) -> Option<(f64, f64)> {
    let without_brackets = text.trim_start_matches('(').trim_end_matches(')');
    let without_brackets = without_brackets.strip_suffix(['j', 'i'])?;
    let bytes = without_brackets.as_bytes();
    let sign =
        |k: &usize| matches!(bytes[*k], b'+' | b'-') && !matches!(bytes[*k - 1], b'e' | b'E');
    let split = (1..bytes.len()).rev().find(sign)?;
    Some((
        without_brackets.get(..split)?.parse().ok()?,
        without_brackets.get(split..)?.parse().ok()?,
    ))
}

#[cfg(test)]
mod tests {
    use super::TextField;

    #[test]
    fn numbers_of_every_spelling_are_read() {
        for (text, value) in [
            ("1.5", 1.5),
            (" -2e-3 ", -2e-3),
            ("1.25D+01", 12.5),
            ("\"7\"", 7.0),
            (".5", 0.5),
            ("+3", 3.0),
        ] {
            assert_eq!(
                TextField::read(text, false),
                TextField::Real(value),
                "{text}"
            );
        }
        assert_eq!(TextField::read("0,25", true), TextField::Real(0.25));
        assert_eq!(TextField::read("0,25", false), TextField::Text);
        assert_eq!(
            TextField::read("(-0.5+2.5e-08j)", false),
            TextField::Complex(-0.5, 2.5e-8)
        );
        assert_eq!(
            TextField::read("1-2i", false),
            TextField::Complex(1.0, -2.0)
        );
        for text in ["", "NaN", "N/A", "inf", "null", "-\u{221e}"] {
            assert_eq!(TextField::read(text, false), TextField::Missing, "{text}");
        }
        assert_eq!(TextField::read("0x1F", false), TextField::Real(31.0));
        assert!(matches!(
            TextField::read("12:00:01,5", true),
            TextField::Moment(_)
        ));
        for text in [
            "x", "1.2.3", "12:00", "0x", "0x+1", "(", "()", "1 2", "\u{b5}",
        ] {
            assert_eq!(TextField::read(text, true), TextField::Text, "{text}");
        }
    }
}
