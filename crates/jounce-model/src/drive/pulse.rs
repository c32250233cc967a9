//! Shock pulses.

use super::{Wave, hold};
use std::f64::consts::PI;

/// Linear pieces of a half-sine; the error of the response is below 1e-12 of its largest value
/// (`crates/jounce-analysis/tests/integrate/drives/signals.rs`).
const LINES: usize = 2048;

/// `amplitude sin(pi (t - start) / duration)` between its start and its end, 0 elsewhere.
pub fn half_sine(amplitude: f64, start_s: f64, duration_s: f64) -> Wave {
    let step_s = duration_s / LINES as f64;
    let size = amplitude / hold(0.5 / duration_s, step_s);
    // Both ends are exactly 0, so the pulse has no jump.
    let sizes = (0..=LINES).map(|k| {
        if k == LINES {
            0.0
        } else {
            size * (PI * k as f64 / LINES as f64).sin()
        }
    });
    Wave::Sampled {
        start_s,
        step_s,
        sizes: sizes.collect(),
    }
}
