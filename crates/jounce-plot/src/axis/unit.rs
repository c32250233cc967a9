//! Units as printed: `W/N^2` with values near a millionth becomes `µW/N²`.

const PREFIXES: [(i32, &str); 11] = [
    (-18, "a"),
    (-15, "f"),
    (-12, "p"),
    (-9, "n"),
    (-6, "µ"),
    (-3, "m"),
    (0, ""),
    (3, "k"),
    (6, "M"),
    (9, "G"),
    (12, "T"),
];

/// Units that take a prefix when they are first. The live page has the same in `web/src/units.ts`.
const TAKES_PREFIX: [&str; 14] = [
    "W", "V", "A", "N", "m", "s", "Hz", "Ω", "F", "J", "Pa", "C", "H", "S",
];

/// Returns the unit with its symbols: `ohm` is `Ω`, integer powers are superscripts.
pub(super) fn printed(unit: &str) -> String {
    let unit = unit.replace("ohm", "Ω").replace("deg", "°");
    let mut parts = unit.split('^');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part
            .find(|c: char| c != '-' && !c.is_ascii_digit())
            .unwrap_or(part.len());
        if digits == 0 || part[digits..].starts_with('.') {
            text.push('^');
            text.push_str(part);
        } else {
            text.push_str(&raised(&part[..digits]));
            text.push_str(&part[digits..]);
        }
    }
    text
}

/// Returns digits and minus signs as superscripts.
pub(super) fn raised(digits: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    digits
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |d| RAISED[d as usize]))
        .collect()
}

/// True where the (printed) unit takes a prefix. A squared first unit does not: its prefix would be
/// squared too.
pub(super) fn takes_prefix(unit: &str) -> bool {
    let first = unit.split(['/', '·', ' ']).next().unwrap_or_default();
    TAKES_PREFIX.contains(&first)
}

/// Returns the prefix of a power of ten, if it has one.
pub(crate) fn prefix(exponent: i32) -> Option<&'static str> {
    PREFIXES
        .iter()
        .find(|(known, _)| *known == exponent)
        .map(|(_, sign)| *sign)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_printed_with_real_signs() {
        for (unit, expected) in [
            ("W/N^2", "W/N²"),
            ("ohm", "Ω"),
            ("m/s^2", "m/s²"),
            ("N/m^1.5", "N/m^1.5"),
            ("kg^-1/2", "kg⁻¹/2"),
            ("", ""),
            ("m^", "m^"),
        ] {
            assert_eq!(printed(unit), expected);
        }
        assert!(
            takes_prefix("W/N²")
                && takes_prefix("m/s²")
                && !takes_prefix("m²")
                && !takes_prefix("kg")
                && !takes_prefix("")
        );
        assert_eq!(
            (prefix(-6), prefix(3), prefix(30)),
            (Some("µ"), Some("k"), None)
        );
    }
}
