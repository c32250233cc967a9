//! Units in column headings.

use super::axis::{is_frequency, is_time};
use super::round_brackets::{AMBIGUOUS_LETTERS, bracketed, is_labelled, may_be_unit};
use crate::read::heading::decibels::Decibels;
use crate::recording::{Issue, IssueKind, Quantity, Unit};

/// Name suffixes that give a unit: `accel_m_s2`, `timestamp_ms`.
const UNIT_SUFFIXES: [(&str, &str); 21] = [
    ("_m_s2", "m/s^2"),
    ("_m_s^2", "m/s^2"),
    ("_m_per_s2", "m/s^2"),
    ("_m_s", "m/s"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_m", "m"),
    ("_ms", "ms"),
    ("_us", "us"),
    ("_ns", "ns"),
    ("_s", "s"),
    ("_sec", "s"),
    ("_khz", "kHz"),
    ("_hz", "Hz"),
    ("_mv", "mV"),
    ("_v", "V"),
    ("_n", "N"),
    ("_lbf", "lbf"),
    ("_g", "g"),
    ("_pa", "Pa"),
    ("_db", "dB"),
];

/// Units of quantities not found in recordings; a quotient of them is not a name and a unit.
const NUMERATOR_UNITS: [&str; 19] = [
    "pC", "nC", "C", "A", "mA", "uA", "count", "counts", "LSB", "rad", "deg", "rpm", "kg", "W",
    "mW", "J", "ohm", "strain", "ue",
];

/// Splits a heading into name and unit: `a [m/s^2]`, `a (g)`, `a, m/s2`, `a/g`, `a_m_s2`. The unit
/// is empty if not given; a unit in brackets may be unknown.
pub(in crate::read) fn split(head: &str) -> (String, String) {
    let head = head.trim().trim_matches('"').trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, unit)) = bracketed(head, open, close) {
            // In `a/(m/s^2)` a slash separates name and unit; brackets with other content belong to
            // the name.
            let name = name.trim_end_matches('/').trim_end();
            if name.eq_ignore_ascii_case("v")
                && !matches!(
                    Unit::read(unit),
                    Some(Unit {
                        quantity: Quantity::Voltage,
                        ..
                    })
                )
            {
                // The voltage at a node, `V(in)`.
                break;
            }
            if is_time(name) && unit.ends_with('S') && Unit::read(unit).is_none() {
                return (name.to_owned(), unit.to_lowercase());
            }
            if !name.is_empty() && (open == '[' || is_known(unit) || may_be_unit(name, unit)) {
                return (name.to_owned(), unit.to_owned());
            }
        }
    }
    if let Some((name, unit)) = head.rsplit_once(", ").filter(|(_, unit)| is_known(unit)) {
        return (name.to_owned(), unit.to_owned());
    }
    if let Some((name, unit)) = format!(" {head}")
        .rsplit_once(" in ")
        .filter(|(_, unit)| is_known(unit))
    {
        return (name.trim().to_owned(), unit.to_owned());
    }
    if let Some((name, unit)) = split_quotient(head) {
        return (name.to_owned(), unit.to_owned());
    }
    // `CH1V` of Rigol.
    let numbered = head.strip_suffix('V').filter(|name| {
        name.starts_with("CH") && name.len() > 2 && name[2..].bytes().all(|b| b.is_ascii_digit())
    });
    if let Some(name) = numbered {
        return (name.to_owned(), "V".to_owned());
    }
    let lowercase = head.to_ascii_lowercase();
    let suffix = UNIT_SUFFIXES
        .iter()
        .find(|(suffix, _)| lowercase.ends_with(suffix) && lowercase.len() > suffix.len());
    (
        head.to_owned(),
        suffix.map_or(String::new(), |(_, unit)| (*unit).to_owned()),
    )
}

/// True for known units, and for all decibels.
pub(in crate::read) fn is_known(unit: &str) -> bool {
    Decibels::is_level(unit) || Unit::read(unit).is_some()
}

/// Reports how a single letter in round brackets was read if it may be a unit or a label: `sensor
/// (V)`, `channel (A)`. `None` for other headings.
pub(in crate::read) fn ambiguity_issue(head: &str) -> Option<Issue> {
    let head = head.trim().trim_matches('"').trim();
    let (_, letter) = bracketed(head, '(', ')')
        .filter(|(name, letter)| letter.chars().count() == 1 && is_labelled(name))?;
    let message = match Unit::read(letter) {
        Some(_) => {
            format!(
                "({letter}) in {head:?} is read as the unit {letter}, not as a label; if it is a \
                label, specify the unit of the column in the notes of the file"
            )
        }
        None if letter.contains(AMBIGUOUS_LETTERS) => {
            format!(
                "({letter}) in {head:?} is read as a label, not as a unit; if it is a unit, \
                specify the name of the column in the notes of the file"
            )
        }
        None => return None,
    };
    Some(Issue::new(IssueKind::Assumed, 1, None, message).of(&split(head).0))
}

/// Splits `U/V` and `t/s`, a name over its unit, as on axes of figures. A quotient of two units is
/// not split.
fn split_quotient(head: &str) -> Option<(&str, &str)> {
    let (name, unit) = head.split_once('/').filter(|_| !is_known(head))?;
    let (name, unit) = (name.trim(), unit.trim());
    let is_name = name.starts_with(char::is_alphabetic)
        && !NUMERATOR_UNITS.contains(&name)
        && !unit.eq_ignore_ascii_case("in");
    let has_matching_quantity = match Unit::read(unit)?.quantity {
        Quantity::Time => is_time(name),
        Quantity::Frequency => is_frequency(name),
        _ => true,
    };
    (is_name && has_matching_quantity).then_some((name, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heading, name and unit.
    const CASES: [(&str, &str, &str); 46] = [
        ("a [m/s^2]", "a", "m/s^2"),
        ("Force (lbf)", "Force", "lbf"),
        ("Force (left)", "Force (left)", ""),
        ("tip, g", "tip", "g"),
        ("H (m/s^2/N)", "H", "m/s^2/N"),
        ("H ((m/s^2)/N)", "H", "(m/s^2)/N"),
        ("S [(m/s^2)^2/Hz]", "S", "(m/s^2)^2/Hz"),
        ("(N)", "(N)", ""),
        ("U (furlong)", "U", "furlong"),
        ("I (mA)", "I", "mA"),
        ("q (pC)", "q", "pC"),
        ("a (in/s^2)", "a", "in/s^2"),
        ("a (ft/s\u{b2})", "a", "ft/s\u{b2}"),
        ("a (m\u{b7}s\u{207b}\u{b2})", "a", "m\u{b7}s\u{207b}\u{b2}"),
        ("a (mg)", "a", "mg"),
        ("x (mil)", "x", "mil"),
        ("T (\u{b0}C)", "T", "\u{b0}C"),
        ("a (dB re 1 m/s^2)", "a", "dB re 1 m/s^2"),
        ("a (dBm)", "a", "dBm"),
        ("a_db", "a_db", "dB"),
        ("U/V", "U", "V"),
        ("t / s", "t", "s"),
        ("a/(m/s^2)", "a", "m/s^2"),
        ("left/right", "left/right", ""),
        ("pC/N", "pC/N", ""),
        ("rad/s", "rad/s", ""),
        ("channel (1)", "channel (1)", ""),
        ("sensor (top)", "sensor (top)", ""),
        ("accel (sensor 3)", "accel (sensor 3)", ""),
        ("accel (left/right)", "accel (left/right)", ""),
        ("accel (ch1)", "accel (ch1)", ""),
        ("x(t)", "x(t)", ""),
        ("abs(FRF)", "abs(FRF)", ""),
        ("m(1,2)", "m(1,2)", ""),
        ("ax_m_s2", "ax_m_s2", "m/s^2"),
        ("timestamp_ms", "timestamp_ms", "ms"),
        ("accel_x", "accel_x", ""),
        ("_s", "_s", ""),
        ("temp_c", "temp_c", ""),
        ("CH1V", "CH1", "V"),
        ("C1 in V", "C1", "V"),
        ("in s", "", "s"),
        ("Time(S)", "Time", "s"),
        ("V(in)", "V(in)", ""),
        ("V(out)", "V(out)", ""),
        ("V (mV)", "V", "mV"),
    ];

    #[test]
    fn headings_give_their_units() {
        for (head, name, unit) in CASES {
            assert_eq!(split(head), (name.to_owned(), unit.to_owned()), "{head}");
        }
    }

    #[test]
    fn letters_after_a_label_are_ambiguous() {
        for (head, name, unit) in [
            ("sensor (A)", "sensor (A)", ""),
            ("Channel 2 (K)", "Channel 2 (K)", ""),
            ("sensor (V)", "sensor", "V"),
        ] {
            assert_eq!(split(head), (name.to_owned(), unit.to_owned()), "{head}");
            assert_eq!(
                ambiguity_issue(head)
                    .and_then(|issue| issue.channel)
                    .as_deref(),
                Some(name),
                "{head}"
            );
        }
        for (head, name, unit) in [
            ("I (A)", "I", "A"),
            ("T (K)", "T", "K"),
            ("U (V)", "U", "V"),
            ("sensor (mV)", "sensor", "mV"),
        ] {
            assert_eq!(
                (split(head), ambiguity_issue(head)),
                ((name.to_owned(), unit.to_owned()), None),
                "{head}"
            );
        }
        assert_eq!(
            (
                split("channel (B)").0.as_str(),
                ambiguity_issue("channel (B)")
            ),
            ("channel (B)", None)
        );
    }
}
