//! By what an attractor is recognised.

use crate::orbit::Orbit;

/// Relative difference of power below which two orbits of one period and as many contacts are one.
const SAME: f64 = 1e-5;

/// Marks of a periodic attractor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Signature {
    /// Drive cycles of its period.
    pub period_cycles: u32,
    /// Contacts per period.
    pub contacts: u64,
    /// Mean power, W.
    pub mean_power_w: f64,
}

impl Signature {
    /// Of an orbit.
    pub fn of(orbit: &Orbit) -> Self {
        Self { period_cycles: orbit.period_cycles, contacts: orbit.contacts, mean_power_w: orbit.mean_power_w }
    }

    /// True when both are of one attractor.
    pub fn is(&self, other: &Signature) -> bool {
        let powers = (self.mean_power_w - other.mean_power_w).abs() <= SAME * self.mean_power_w.abs().max(other.mean_power_w.abs());
        self.period_cycles == other.period_cycles && self.contacts == other.contacts && powers
    }
}

/// `a`, `b`, .., `z`, `aa`, ..
pub fn letters(place: usize) -> String {
    let last = char::from(b'a' + (place % 26) as u8);
    if place < 26 { last.to_string() } else { format!("{}{last}", letters(place / 26 - 1)) }
}
