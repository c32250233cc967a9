//! The ground: a line with hatching on its far side.

use crate::drawing::canvas::INK;
use crate::svg::{Svg, number};

/// Side of a line on which the hatching lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HatchSide {
    /// Above a horizontal line.
    Above,
    /// Below a horizontal line.
    Below,
    /// At the left of a vertical line.
    Left,
    /// At the right of a vertical line.
    Right,
}

/// Depth of the hatching, px.
pub const HATCH: f64 = 7.0;

/// Draws ground along a line of the given length from a corner.
pub fn ground(svg: &mut Svg, (x, y): (f64, f64), length: f64, far: HatchSide) {
    let upright = matches!(far, HatchSide::Left | HatchSide::Right);
    let end = if upright {
        (x, y + length)
    } else {
        (x + length, y)
    };
    let mut steps = format!(
        "M{} {}L{} {}",
        number(x),
        number(y),
        number(end.0),
        number(end.1)
    );
    let count = (length / 7.0).round().max(1.0) as usize;
    for k in 0..count {
        let along = (k as f64 + 0.5) * length / count as f64;
        let (from, to) = match far {
            HatchSide::Above => ((x + along, y), (x + along + 6.0, y - HATCH)),
            HatchSide::Below => ((x + along, y), (x + along - 6.0, y + HATCH)),
            HatchSide::Left => ((x, y + along), (x - HATCH, y + along + 6.0)),
            HatchSide::Right => ((x, y + along), (x + HATCH, y + along + 6.0)),
        };
        steps.push_str(&format!(
            "M{} {}L{} {}",
            number(from.0),
            number(from.1),
            number(to.0),
            number(to.1)
        ));
    }
    svg.path(&steps, INK);
}
