//! Levels in decibels: `dB`, `dB re 1 m/s^2`, `dB rel. 20 uPa`, `dB (g)`, `dB g`.

use crate::recording::{Quantity, Unit, unbracketed};

/// Words that may precede the reference, the longer ones first.
const WORDS: [&str; 6] = ["rel.", "rel", "ref.", "ref", "re:", "re"];

/// Reference of levels in decibels.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::read) struct Decibels {
    /// Size at 0 dB, in the unit.
    pub reference: f64,
    /// Unit; empty if not given.
    pub unit: String,
    /// Decibels per factor of ten: 20 for amplitudes, 10 for power densities.
    pub decade: f64,
}

impl Decibels {
    /// True for a unit that begins with `dB`, even if the remainder is invalid.
    pub(in crate::read) fn is_level(unit: &str) -> bool {
        unbracketed(unit)
            .get(..2)
            .is_some_and(|start| start.eq_ignore_ascii_case("dB"))
    }

    /// Parses `dB [re | rel | ref] [number] [unit]`. Returns `None` for anything else, such as
    /// `dBm` (not a level in metres), and for an unknown unit.
    pub(in crate::read) fn read(unit: &str) -> Option<Self> {
        let suffix = unbracketed(unit)
            .get(2..)
            .filter(|_| Self::is_level(unit))?;
        let is_separate = suffix.is_empty()
            || suffix.starts_with(|c: char| c.is_whitespace() || matches!(c, '(' | '['));
        let remainder = unbracketed(suffix);
        let after_word = |word: &&str| {
            remainder
                .get(..word.len())
                .filter(|start| start.eq_ignore_ascii_case(word))
                .map(|_| &remainder[word.len()..])
        };
        let reference = WORDS
            .iter()
            .find_map(after_word)
            .filter(|suffix| !suffix.starts_with(char::is_alphabetic));
        let (reference, unit) =
            leading_number(reference.or(is_separate.then_some(remainder))?.trim());
        Self::of(reference, unit)
            .filter(|levels| levels.reference > 0.0 && levels.reference.is_finite())
    }

    /// Levels of a column known to be in decibels; the unit may give either the level or its
    /// reference.
    pub(in crate::read) fn read_or_linear(unit: &str) -> Option<Self> {
        if Self::is_level(unit) {
            Self::read(unit)
        } else {
            Some(Self {
                reference: 1.0,
                unit: unbracketed(unit).to_owned(),
                decade: 20.0,
            })
        }
    }

    fn of(reference: f64, unit: &str) -> Option<Self> {
        let unit = unbracketed(unit).to_owned();
        if unit.is_empty() {
            return Some(Self {
                reference,
                unit,
                decade: 20.0,
            });
        }
        let power = matches!(
            Unit::read(&unit)?.quantity,
            Quantity::AccelerationPsd | Quantity::ForcePsd
        );
        Some(Self {
            reference,
            unit,
            decade: if power { 10.0 } else { 20.0 },
        })
    }
}

/// Splits off the number at the beginning of a text, 1 if absent: `20`, `1e-6`, `10^-6`.
fn leading_number(text: &str) -> (f64, &str) {
    let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | 'E' | '-' | '+');
    let max_length = text.find(|c| !number(c)).unwrap_or(text.len());
    let number_text = (1..=max_length)
        .rev()
        .find_map(|end| Some((text[..end].parse::<f64>().ok()?, &text[end..])));
    let (base, rest) = number_text.unwrap_or((1.0, text));
    let (base, rest) = match rest.strip_prefix('^') {
        Some(power) => {
            let (power, rest) = leading_number(power);
            (base.powf(power), rest)
        }
        None => (base, rest),
    };
    (base, rest.trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_of_every_spelling_are_read_and_nothing_else() {
        let cases = [
            ("dB", 1.0, "", 20.0),
            ("[dB]", 1.0, "", 20.0),
            ("dB re 1 m/s^2", 1.0, "m/s^2", 20.0),
            ("dB rel. 1 m/s\u{b2}", 1.0, "m/s\u{b2}", 20.0),
            ("db rel 1e-6 m/s^2", 1e-6, "m/s^2", 20.0),
            ("dB ref 20uPa", 20.0, "uPa", 20.0),
            ("dBre 1 g", 1.0, "g", 20.0),
            ("dB (re 10^-6 m/s2)", 1e-6, "m/s2", 20.0),
            ("dB re 1e-6", 1e-6, "", 20.0),
            ("dB g", 1.0, "g", 20.0),
            ("dB(g)", 1.0, "g", 20.0),
            ("dB re 1 (m/s^2)^2/Hz", 1.0, "(m/s^2)^2/Hz", 10.0),
            ("dB re 1 g/N", 1.0, "g/N", 20.0),
        ];
        for (text, reference, unit, decade) in cases {
            let result = Decibels::read(text).unwrap_or_else(|| panic!("{text} is not understood"));
            assert_eq!(
                (result.unit.as_str(), result.decade),
                (unit, decade),
                "{text}"
            );
            assert!(
                (result.reference / reference - 1.0).abs() < 1e-14,
                "{text}: {}",
                result.reference
            );
        }
        for text in [
            "dBm",
            "dBV",
            "dB(A)",
            "dB re 1 furlong",
            "dB relative",
            "dB re 0 g",
            "dB re -1 g",
            "m",
            "d",
            "dB/m",
        ] {
            assert_eq!(Decibels::read(text), None, "{text}");
            assert!(
                !Decibels::is_level(text) || Unit::read(text).is_none(),
                "{text}"
            );
        }
    }
}
