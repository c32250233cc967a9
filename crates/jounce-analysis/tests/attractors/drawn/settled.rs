//! Steady-state test on strobed states of brute force, from the definition in the book.

use super::independent::{Run, Start, distance, run};
use super::system::Drawn;

/// Relative distance to the orbit below which a motion has settled.
const SETTLED: f64 = 1e-4;

/// Part of that distance within which the flag is not compared.
const LIMIT: f64 = 0.1;

/// Longest tested period, drive cycles.
const LONGEST: usize = 4;

/// Result of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Flag {
    Settled(usize),
    Not,
    /// The distance is within [`LIMIT`] of the limit.
    Limit,
}

/// Tests states at successive starts of cycles.
pub fn flag(strobe: &[Vec<f64>], tolerance: f64) -> Flag {
    let flags = [1.0 - LIMIT, 1.0 + LIMIT].map(|factor| {
        (1..=LONGEST)
            .find(|period| distance_to_orbit(strobe, *period, tolerance) < factor * SETTLED)
    });
    match flags {
        [a, b] if a != b => Flag::Limit,
        [Some(period), _] => Flag::Settled(period),
        _ => Flag::Not,
    }
}

/// Relative distance `d r / max(1, 1 - r)` with the last change `d` and the ratio `r` of the last
/// two; changes that are errors of the integration count as they are.
fn distance_to_orbit(strobe: &[Vec<f64>], period: usize, tolerance: f64) -> f64 {
    let Some(first) = strobe.len().checked_sub(2 * period + 1) else {
        return f64::INFINITY;
    };
    let last = &strobe[first + 2 * period];
    let size = distance(last, &vec![0.0; last.len()]);
    let before = distance(&strobe[first], &strobe[first + period]) / size;
    let now = distance(&strobe[first + period], last) / size;
    match now / before {
        _ if now < 10.0 * tolerance => now,
        ratio if ratio < 1.0 => now * (ratio / (1.0 - ratio)).max(1.0),
        _ => f64::INFINITY,
    }
}

/// Integrates on for two periods, and returns a message if the state does not repeat after each.
pub fn repeats(drawn: &Drawn, own: &Run, period: usize) -> Option<String> {
    let physical = drawn.physical(own.strobe.last()?);
    let start = Start {
        physical: &physical,
        drive: 1.0,
    };
    let next = run(&drawn.merged, &start, 2 * period);
    let change = |from: usize| distance(&next.strobe[from], &next.strobe[from + period]);
    let worst = change(0).max(change(period)) / next.size;
    (worst > 2.0 * SETTLED).then(|| format!("settled with period {period}, repeats to {worst:.2e}"))
}

impl Drawn {
    /// Physical state of energy coordinates `(w q, q', sqrt(C) V)`.
    fn physical(&self, coordinates: &[f64]) -> Vec<f64> {
        let modes = &self.merged.modes;
        let n = modes.len();
        let angular = std::f64::consts::TAU * self.merged.drives[0].frequency_hz;
        let mut physical = coordinates.to_vec();
        for (x, w) in physical.iter_mut().zip(&modes.frequency_rad_s) {
            *x /= if *w > 0.0 { *w } else { angular };
        }
        for (x, patch) in physical[2 * n..].iter_mut().zip(modes.patch.values()) {
            *x /= patch.capacitance_f.sqrt();
        }
        physical
    }
}
