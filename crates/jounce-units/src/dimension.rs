//! Dimension of a unit: exponents of kg, m, s, A and rad.

use std::fmt;

/// Names of the base units, in the order of the exponents.
const BASE: [&str; 5] = ["kg", "m", "s", "A", "rad"];

/// Difference below which two exponents are equal; contact laws have fractional exponents.
const SAME: f64 = 1e-9;

/// Exponents of kg, m, s, A, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimension([f64; 5]);

impl Dimension {
    /// Dimension of a plain number.
    pub const NONE: Self = Self([0.0; 5]);

    /// Returns the dimension with these exponents of kg, m, s, A, rad.
    pub const fn new(exponents: [i8; 5]) -> Self {
        let [kg, m, s, a, rad] = exponents;
        Self([kg as f64, m as f64, s as f64, a as f64, rad as f64])
    }

    /// Returns the dimension of `self * other^power`.
    pub fn times(self, other: Self, power: f64) -> Self {
        let mut out = self;
        for (mine, theirs) in out.0.iter_mut().zip(other.0) {
            *mine += theirs * power;
        }
        out
    }

    /// True if both dimensions are equal.
    pub fn is(self, other: Self) -> bool {
        self.0
            .iter()
            .zip(other.0)
            .all(|(a, b)| (a - b).abs() < SAME)
    }

    /// Returns the kind with its article, `"a length"`; base units if the kind has no name here.
    pub fn kind(self) -> String {
        let named = KINDS
            .iter()
            .find(|(_, exponents)| self.is(Self::new(*exponents)));
        let [kg, m, s, rest @ ..] = self.0;
        match named {
            Some((name, _)) => (*name).to_owned(),
            None if Self([kg, 0.0, s, rest[0], rest[1]]).is(Self::new([1, 0, -2, 0, 0])) => {
                format!("a contact stiffness in N/m^{}", rounded(1.0 - m))
            }
            None => format!("a quantity in {self}"),
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut gap = "";
        for (name, power) in BASE.iter().zip(self.0) {
            if power.abs() < SAME {
                continue;
            }
            write!(out, "{gap}{name}")?;
            if (power - 1.0).abs() > SAME {
                write!(out, "^{}", rounded(power))?;
            }
            gap = " ";
        }
        Ok(())
    }
}

fn rounded(power: f64) -> f64 {
    (power * 1e9).round() / 1e9
}

/// Kinds that a user may have written instead: name, exponents of kg, m, s, A, rad.
const KINDS: &[(&str, [i8; 5])] = &[
    ("a plain number", [0, 0, 0, 0, 0]),
    ("a length", [0, 1, 0, 0, 0]),
    ("an area", [0, 2, 0, 0, 0]),
    ("a volume", [0, 3, 0, 0, 0]),
    ("a mass", [1, 0, 0, 0, 0]),
    ("a time", [0, 0, 1, 0, 0]),
    ("a current", [0, 0, 0, 1, 0]),
    ("an angle", [0, 0, 0, 0, 1]),
    ("a frequency", [0, 0, -1, 0, 0]),
    ("an angular frequency", [0, 0, -1, 0, 1]),
    ("a speed", [0, 1, -1, 0, 0]),
    ("an inverse speed", [0, -1, 1, 0, 0]),
    ("an acceleration", [0, 1, -2, 0, 0]),
    ("a force", [1, 1, -2, 0, 0]),
    ("a stiffness", [1, 0, -2, 0, 0]),
    ("a damping coefficient", [1, 0, -1, 0, 0]),
    ("a pressure", [1, -1, -2, 0, 0]),
    ("a density", [1, -3, 0, 0, 0]),
    ("a power spectral density of acceleration", [0, 2, -3, 0, 0]),
    ("a power spectral density of force", [2, 2, -3, 0, 0]),
    ("an energy", [1, 2, -2, 0, 0]),
    ("a power", [1, 2, -3, 0, 0]),
    ("a charge", [0, 0, 1, 1, 0]),
    ("a voltage", [1, 2, -3, -1, 0]),
    ("a resistance", [1, 2, -3, -2, 0]),
    ("a conductance", [-1, -2, 3, 2, 0]),
    ("a capacitance", [-1, -2, 4, 2, 0]),
    ("an inductance", [1, 2, -2, -2, 0]),
    ("a rotary inertia", [1, 2, 0, 0, 0]),
    ("a rotary stiffness", [1, 2, -2, 0, -1]),
    ("a permittivity", [-1, -3, 4, 2, 0]),
    ("a piezoelectric charge coefficient", [-1, -1, 3, 1, 0]),
];
