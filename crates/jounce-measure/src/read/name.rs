//! Units in the heads of columns.

use crate::recording::Unit;

/// Endings of names that tell a unit: `accel_m_s2`, `timestamp_ms`.
const ENDINGS: [(&str, &str); 20] = [
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
];

/// Name and unit of a head: `a [m/s^2]`, `a (g)`, `a, m/s2`, `a_m_s2`. The unit is empty where none is told.
pub(super) fn split(head: &str) -> (String, String) {
    let head = head.trim().trim_matches('"').trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, unit)) = bracketed(head, open, close) {
            // Brackets with something else inside belong to the name.
            if !name.is_empty() && (open == '[' || Unit::read(unit).is_some()) {
                return (name.to_owned(), unit.to_owned());
            }
        }
    }
    if let Some((name, unit)) = head.rsplit_once(", ").filter(|(_, unit)| Unit::read(unit).is_some()) {
        return (name.to_owned(), unit.to_owned());
    }
    let small = head.to_ascii_lowercase();
    let ending = ENDINGS.iter().find(|(ending, _)| small.ends_with(ending) && small.len() > ending.len());
    (head.to_owned(), ending.map_or(String::new(), |(_, unit)| (*unit).to_owned()))
}

/// What stands before a bracket that closes at the end, and what stands in it, further brackets included.
fn bracketed(head: &str, open: char, close: char) -> Option<(&str, &str)> {
    let inside = head.strip_suffix(close)?;
    let mut depth = 0;
    let opens = |(_, c): &(usize, char)| {
        depth += i32::from(*c == close) - i32::from(*c == open);
        depth < 0
    };
    let (at, _) = inside.char_indices().rev().find(opens)?;
    Some((inside[..at].trim(), inside[at + open.len_utf8()..].trim()))
}

/// True for names of a time.
pub(super) fn is_time(name: &str) -> bool {
    let small = name.trim().to_lowercase();
    let whole = ["t", "time", "zeit", "x_value", "seconds", "sec", "timestamp", "uhrzeit", "temps"];
    whole.contains(&small.as_str()) || ["time", "timestamp", "t_", "t ["].iter().any(|start| small.starts_with(start))
}

/// True for names of a frequency.
pub(super) fn is_frequency(name: &str) -> bool {
    let small = name.trim().to_lowercase();
    small == "f" || small == "hz" || small.starts_with("freq") || small.starts_with("f_hz") || small.starts_with("f [")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_tell_their_units() {
        let cases = [
            ("a [m/s^2]", "a", "m/s^2"),
            ("Force (lbf)", "Force", "lbf"),
            ("Force (left)", "Force (left)", ""),
            ("tip, g", "tip", "g"),
            ("H (m/s^2/N)", "H", "m/s^2/N"),
            ("H ((m/s^2)/N)", "H", "(m/s^2)/N"),
            ("S [(m/s^2)^2/Hz]", "S", "(m/s^2)^2/Hz"),
            ("(N)", "(N)", ""),
            ("ax_m_s2", "ax_m_s2", "m/s^2"),
            ("timestamp_ms", "timestamp_ms", "ms"),
            ("accel_x", "accel_x", ""),
            ("_s", "_s", ""),
            ("temp_c", "temp_c", ""),
        ];
        for (head, name, unit) in cases {
            assert_eq!(split(head), (name.to_owned(), unit.to_owned()), "{head}");
        }
        assert!(is_time("Time") && is_time("timestamp_ms") && is_time("t") && !is_time("tip"));
        assert!(is_frequency("Frequency [Hz]") && !is_frequency("force"));
    }
}
