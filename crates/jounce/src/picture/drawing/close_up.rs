//! A closer look at a stop: the gap and the thickness of the beam at a scale that shows both.

use super::hatch::{Far, ground};
use super::{DrawnBeam, DrawnStop, dimension, stop};
use crate::picture::svg::{Anchor, Svg, number};
use crate::picture::text::{SMALL, wrap};

/// Height that gap and beam fill together, px.
const FILLED: f64 = 60.0;

/// Draws into a field `(x, y, width, height)`; `px_per_m` is the scale of the side view.
pub fn close_up(svg: &mut Svg, (x, y, width, height): (f64, f64, f64, f64), beam: Option<&DrawnBeam>, drawn: &DrawnStop, px_per_m: f64) {
    let frame = "class=\"jounce-grid\" fill=\"none\" stroke=\"#8a8a8a\" stroke-width=\"0.8\"";
    svg.rect(x, y, width, height, frame);
    let thickness_m = beam.filter(|_| drawn.place_m.is_some()).map_or(0.0, |beam| beam.thickness_m);
    let filled_m = drawn.gap_m.abs() + thickness_m;
    let scale = if filled_m > 0.0 { FILLED / filled_m } else { 1.0 };
    let words = match drawn.gap_m {
        gap if gap > 0.0 => format!("{}, gap {}", drawn.label, dimension::length(gap)),
        gap if gap < 0.0 => format!("{}, pressed in {}", drawn.label, dimension::length(-gap)),
        _ => format!("{}, gap 0", drawn.label),
    };
    svg.text(x + 8.0, y + 18.0, SMALL, Anchor::Start, &words);
    svg.open_window(x, y + 24.0, width, height - 68.0);
    let (middle, way) = (0.5 * width, if drawn.above { -1.0 } else { 1.0 });
    // The face that strikes, and the tip of the stop.
    let face = 0.5 * (height - 68.0) - way * (0.5 * FILLED - thickness_m * scale);
    let thick = (thickness_m * scale).max(6.0);
    let top = if drawn.above { face } else { face - thick };
    svg.rect(0.0, top, width, thick, "class=\"jounce-beam\" fill=\"#4a5560\"");
    let tip = face + way * drawn.gap_m * scale;
    svg.path(&stop::tip(middle, tip, way, 14.0), "class=\"jounce-stop\" fill=\"#8a8a8a\" fill-opacity=\"0.8\" stroke=\"none\"");
    if drawn.frame == "ground" {
        let wall = tip + way * 28.0;
        ground(svg, (middle - 50.0, wall), 100.0, if drawn.above { Far::Above } else { Far::Below });
    }
    if drawn.gap_m != 0.0 {
        let at = middle + 42.0;
        dimension::arrow(svg, at, (face, tip), true);
        let level = |y: f64| format!("M{} {y}L{} {y}", number(middle + 10.0), number(at + 8.0), y = number(y));
        svg.path(&level(tip), "class=\"jounce-grid\" stroke=\"#8a8a8a\" stroke-width=\"0.8\" fill=\"none\"");
    }
    svg.close_window();
    let closer = (px_per_m > 0.0 && filled_m > 0.0).then(|| format!("drawn {:.0} times larger than above", scale / px_per_m));
    let lines = wrap(&drawn.law, SMALL, width - 16.0);
    for (line, text) in lines.iter().take(1).chain(&closer).enumerate() {
        svg.text(x + 8.0, y + height - 24.0 + 15.0 * line as f64, SMALL, Anchor::Start, text);
    }
}
