//! Unit symbols and SI prefixes.

use super::dimension::Dimension;

/// A symbol in SI: `10^power_of_ten * up / down` of its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UnitSymbol {
    pub(super) power_of_ten: i32,
    pub(super) up: f64,
    pub(super) down: f64,
    pub(super) dimension: Dimension,
}

/// Names, exponents of kg, m, s, A, rad, and the power of ten relative to SI; all take prefixes.
const PREFIXED: &[(&[&str], [i8; 5], i32)] = &[
    (&["m"], [0, 1, 0, 0, 0], 0),
    (&["g"], [1, 0, 0, 0, 0], -3),
    (&["s"], [0, 0, 1, 0, 0], 0),
    (&["A"], [0, 0, 0, 1, 0], 0),
    (&["rad"], [0, 0, 0, 0, 1], 0),
    (&["N"], [1, 1, -2, 0, 0], 0),
    (&["Pa"], [1, -1, -2, 0, 0], 0),
    (&["Hz"], [0, 0, -1, 0, 0], 0),
    (&["V"], [1, 2, -3, -1, 0], 0),
    (&["W"], [1, 2, -3, 0, 0], 0),
    (&["J"], [1, 2, -2, 0, 0], 0),
    (&["C"], [0, 0, 1, 1, 0], 0),
    (&["F"], [-1, -2, 4, 2, 0], 0),
    (&["ohm", "Ohm", "\u{3a9}", "\u{2126}"], [1, 2, -3, -2, 0], 0),
    (&["S"], [-1, -2, 3, 2, 0], 0),
    (&["H"], [1, 2, -2, -2, 0], 0),
    (&["strain"], [0, 0, 0, 0, 0], 0),
];

/// Parts of one, without prefix: names and the power of ten.
const PARTS: &[(&str, i32)] = &[("%", -2), ("ppm", -6)];

/// Standard acceleration of free fall, the unit g (NIST SP 811).
pub const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Symbols that take no prefix: names, exponents, `up / down`.
const PLAIN: &[(&[&str], [i8; 5], f64, f64)] = &[
    (&["min"], [0, 0, 1, 0, 0], 60.0, 1.0),
    (&["h"], [0, 0, 1, 0, 0], 3600.0, 1.0),
    (&["rpm"], [0, 0, -1, 0, 0], 1.0, 60.0),
    (&["gn"], [0, 1, -2, 0, 0], STANDARD_GRAVITY_M_S2, 1.0),
    (
        &["deg", "\u{b0}"],
        [0, 0, 0, 0, 1],
        std::f64::consts::PI,
        180.0,
    ),
];

/// SI prefixes; micro is `u`, the micro sign or the Greek letter.
pub(super) const PREFIXES: &[(&str, i32)] = &[
    ("da", 1),
    ("y", -24),
    ("z", -21),
    ("a", -18),
    ("f", -15),
    ("p", -12),
    ("n", -9),
    ("u", -6),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("h", 2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("P", 15),
    ("E", 18),
    ("Z", 21),
    ("Y", 24),
];

impl UnitSymbol {
    /// Finds a symbol: first as written, then as prefix and symbol.
    pub(super) fn find(name: &str) -> Option<Self> {
        Self::bare(name).or_else(|| {
            PREFIXES.iter().find_map(|(prefix, power)| {
                let symbol = Self::prefixable(name.strip_prefix(prefix)?)?;
                Some(Self {
                    power_of_ten: symbol.power_of_ten + power,
                    ..symbol
                })
            })
        })
    }

    /// Returns the symbols of a dimension: those that take prefixes, and those that take none.
    pub(super) fn of_dimension(dimension: Dimension) -> (Vec<&'static str>, Vec<&'static str>) {
        let fits = |exponents: &[i8; 5]| dimension.is(Dimension::new(*exponents));
        let prefixed = PREFIXED.iter().filter(|(_, exponents, _)| fits(exponents));
        let plain = PLAIN.iter().filter(|(_, exponents, ..)| fits(exponents));
        let parts = PARTS.iter().filter(|_| dimension.is(Dimension::NONE));
        (
            prefixed
                .flat_map(|(names, ..)| names.iter().copied())
                .collect(),
            plain
                .flat_map(|(names, ..)| names.iter().copied())
                .chain(parts.map(|(name, _)| *name))
                .collect(),
        )
    }

    fn bare(name: &str) -> Option<Self> {
        if let Some((_, power_of_ten)) = PARTS.iter().find(|(part, _)| *part == name) {
            return Some(Self {
                power_of_ten: *power_of_ten,
                up: 1.0,
                down: 1.0,
                dimension: Dimension::NONE,
            });
        }
        let plain = PLAIN.iter().find(|(names, ..)| names.contains(&name));
        plain
            .map(|&(_, exponents, up, down)| Self {
                power_of_ten: 0,
                up,
                down,
                dimension: Dimension::new(exponents),
            })
            .or_else(|| Self::prefixable(name))
    }

    fn prefixable(name: &str) -> Option<Self> {
        let (_, exponents, power_of_ten) =
            PREFIXED.iter().find(|(names, ..)| names.contains(&name))?;
        Some(Self {
            power_of_ten: *power_of_ten,
            up: 1.0,
            down: 1.0,
            dimension: Dimension::new(*exponents),
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn a_symbol_wins_over_prefix_and_symbol() {
        assert_eq!(UnitSymbol::find("min").unwrap().up, 60.0);
        assert_eq!(UnitSymbol::find("Pa").unwrap().power_of_ten, 0);
        assert_eq!(UnitSymbol::find("h").unwrap().up, 3600.0);
        assert_eq!(UnitSymbol::find("hPa").unwrap().power_of_ten, 2);
        assert_eq!(UnitSymbol::find("kg").unwrap().power_of_ten, 0);
        assert_eq!(UnitSymbol::find("dam").unwrap().power_of_ten, 1);
        assert_eq!(UnitSymbol::find("\u{b5}\u{3a9}").unwrap().power_of_ten, -6);
        assert_eq!(UnitSymbol::find("ppm").unwrap().power_of_ten, -6);
        assert_eq!(UnitSymbol::find("ustrain").unwrap().power_of_ten, -6);
        assert!(UnitSymbol::find("kmin").is_none());
        assert!(UnitSymbol::find("kppm").is_none());
        assert!(UnitSymbol::find("").is_none());
        assert!(UnitSymbol::find("k").is_none());
    }
}
