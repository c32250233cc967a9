//! A stop in a side view: a blunt tip towards the beam, on what carries it.

use super::DrawnStop;
use super::hatch::{Far, ground};
use super::sheet::View;
use crate::picture::svg::{Anchor, Svg, number};
use crate::picture::text::SMALL;

/// Height of tip and pin, px.
const PIN: f64 = 46.0;

/// The outline of a tip at `(x, y)` that opens away from the beam: `way` is -1 above it and 1 below.
pub fn tip(x: f64, y: f64, way: f64, size: f64) -> String {
    let (a, b) = (number(x - size), number(x + size));
    let (middle, far) = (number(y + way * size), number(y + way * 2.0 * size));
    format!("M{a} {far}L{a} {middle}Q{a} {y0} {x0} {y0}Q{b} {y0} {b} {middle}L{b} {far}Z", x0 = number(x), y0 = number(y))
}

/// The stop of a body whose striking face lies at `face_m` from the mid-plane; where it rides, its arm starts at `carrier`.
pub fn drawn(svg: &mut Svg, stop: &DrawnStop, x: f64, face_m: f64, view: View, carrier: (f64, f64)) {
    let way = if stop.above { -1.0 } else { 1.0 };
    let y = view.y + way * (face_m + stop.gap_m) * view.px_per_m;
    let far = y + way * PIN;
    svg.path(&tip(x, y, way, 5.0), "class=\"jounce-stop\" fill=\"#8a8a8a\" stroke=\"none\"");
    let look = "class=\"jounce-rule\" stroke=\"#1a1a1a\" stroke-width=\"1.2\" fill=\"none\"";
    svg.path(&format!("M{x0} {a}L{x0} {b}", x0 = number(x), a = number(y + way * 10.0), b = number(far)), look);
    if stop.rides {
        let arm = format!("M{} {f}L{c} {f}L{c} {}", number(x), number(carrier.1), c = number(carrier.0), f = number(far));
        svg.path(&arm, look);
    } else if stop.frame == "ground" {
        ground(svg, (x - 22.0, far), 44.0, if stop.above { Far::Above } else { Far::Below });
    }
    let words = if stop.rides || stop.frame == "ground" { stop.label.clone() } else { format!("{} on {}", stop.label, stop.frame) };
    svg.text(x + 28.0, far + way * 2.0 + 4.0, SMALL, Anchor::Start, &words);
}
