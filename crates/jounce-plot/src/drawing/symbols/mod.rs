//! Symbols of mechanics: a spring, the tip of a stop.

pub(super) mod dimension;
pub(super) mod electric;
pub(super) mod hatch;

use super::canvas::INK;
use crate::svg::{Svg, number};

/// Draws a vertical spring between two heights.
pub fn spring(svg: &mut Svg, x: f64, from: f64, to: f64) {
    const TURNS: usize = 4;
    let pitch = (to - from) / (TURNS as f64 + 1.0);
    let mut steps = format!(
        "M{x0} {}L{x0} {}",
        number(from),
        number(from + 0.5 * pitch),
        x0 = number(x)
    );
    for turn in 0..TURNS {
        let y = from + (turn as f64 + 0.5) * pitch;
        let zigzag = [
            (x + 8.0, y + 0.25 * pitch),
            (x - 8.0, y + 0.75 * pitch),
            (x, y + pitch),
        ];
        zigzag
            .iter()
            .for_each(|(x, y)| steps.push_str(&format!("L{} {}", number(*x), number(*y))));
    }
    steps.push_str(&format!("L{} {}", number(x), number(to)));
    svg.path(&steps, INK);
}

/// Returns the outline of a tip at `(x, y)` that opens away from the beam: `sign` is -1 above it
/// and 1 below.
pub fn tip(x: f64, y: f64, sign: f64, size: f64) -> String {
    let (a, b) = (number(x - size), number(x + size));
    let (middle, far) = (number(y + sign * size), number(y + sign * 2.0 * size));
    format!(
        "M{a} {far}L{a} {middle}Q{a} {y0} {x0} {y0}Q{b} {y0} {b} {middle}L{b} {far}Z",
        x0 = number(x),
        y0 = number(y)
    )
}
