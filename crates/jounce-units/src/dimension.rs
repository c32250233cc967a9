//! Dimension of a unit: exponents of kg, m, s, A and rad.

use super::quantity::Quantity;
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
        let others = OTHER_KINDS.map(|(kind, exponents)| (kind, Self::new(exponents)));
        let of_keys = QUANTITIES.map(|quantity| (quantity.kind(), quantity.dimension()));
        let mut named = others.iter().chain(&of_keys);
        let named = named.find(|(_, dimension)| self.is(*dimension));
        let [kg, m, s, rest @ ..] = self.0;
        match named {
            Some((kind, _)) => (*kind).to_owned(),
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

/// Kinds that a user may have written instead and that no key has: name, exponents of kg, m, s, A,
/// rad.
const OTHER_KINDS: [(&str, [i8; 5]); 6] = [
    ("a plain number", [0, 0, 0, 0, 0]),
    ("an area", [0, 2, 0, 0, 0]),
    ("an angular frequency", [0, 0, -1, 0, 1]),
    ("an energy", [1, 2, -2, 0, 0]),
    ("a charge", [0, 0, 1, 1, 0]),
    ("a conductance", [-1, -2, 3, 2, 0]),
];

/// Kinds of keys that a user may have written instead.
const QUANTITIES: [Quantity; 26] = [
    Quantity::Length,
    Quantity::Volume,
    Quantity::Mass,
    Quantity::Time,
    Quantity::Current,
    Quantity::Angle,
    Quantity::Frequency,
    Quantity::Speed,
    Quantity::InverseSpeed,
    Quantity::Acceleration,
    Quantity::Force,
    Quantity::Stiffness,
    Quantity::Damping,
    Quantity::Pressure,
    Quantity::Density,
    Quantity::AccelerationPsd,
    Quantity::ForcePsd,
    Quantity::Power,
    Quantity::Voltage,
    Quantity::Resistance,
    Quantity::Capacitance,
    Quantity::Inductance,
    Quantity::RotaryInertia,
    Quantity::RotaryStiffness,
    Quantity::Permittivity,
    Quantity::ChargePerForce,
];
