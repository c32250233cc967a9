//! The stops of a group: gaps between opposite bodies, and tips on the ground or on an arm.

use super::assembly::{carrier, face, room};
use super::bodies::arm;
use super::canvas::{Canvas, INK};
use super::hatch::{HATCH, HatchSide, ground};
use super::layout::{DrawingLayout, way};
use super::rect::Rect;
use super::symbols::tip;
use super::{Drawing, DrawnContact, dimension};
use crate::picture::svg::number;

/// Half the width of a tip, px.
const TIP: f64 = 5.0;
/// Height of tip and pin, px.
pub const PIN: f64 = 26.0;
/// Width of the ground behind a stop, px.
const GROUND: f64 = 36.0;
/// Smallest gap visible in the side view, px.
pub const SEEN: f64 = 14.0;

/// Draws a stop, with `shift` from the layout to the sheet.
pub fn contact(
    canvas: &mut Canvas,
    drawing: &Drawing,
    layout: &DrawingLayout,
    index: usize,
    shift: (f64, f64),
) {
    let drawn = &drawing.contacts[index];
    let (x, middle) = layout.point(drawing, drawn.at);
    let (x, middle, way) = (x + shift.0, middle + shift.1, way(drawn));
    let near = middle + way * face(drawing, drawn.at, drawn.above, layout.px_per_m);
    let struck = middle + way * layout.reach(drawing, drawn);
    if (struck - near).abs() >= SEEN {
        dimension::arrow(canvas.svg, x, (near, struck), true);
        canvas.cover(Rect::between((x - 4.0, near), (x + 4.0, struck)));
    }
    if !layout.opposite[index] {
        stop(canvas, drawing, layout, drawn, (x, struck), shift);
    }
    let anchor = if layout.opposite[index] {
        0.5 * (near + struck)
    } else {
        struck + way * PIN
    };
    canvas.label((x, anchor), (1.0, 0.3 * way), words(drawing, layout, index));
}

/// Returns the left end of the ground behind a stop, relative to the layout.
pub fn foot(drawing: &Drawing, layout: &DrawingLayout, drawn: &DrawnContact) -> (f64, f64) {
    let (x, middle) = layout.point(drawing, drawn.at);
    let far = middle + way(drawn) * (layout.reach(drawing, drawn) + PIN);
    (x - 0.5 * GROUND, far)
}

/// Returns the name with the gap, and the law.
fn words(drawing: &Drawing, layout: &DrawingLayout, index: usize) -> Vec<String> {
    let drawn = &drawing.contacts[index];
    let name = match drawn.on {
        // The body is named only if the drawing does not show it.
        Some(on)
            if !layout.opposite[index]
                && carrier(drawing, drawn.at.body).is_none_or(|place| place.body != on.body) =>
        {
            format!(
                "stop {} on {}",
                drawn.label,
                drawing.bodies[on.body]
                    .words
                    .first()
                    .map_or("", String::as_str)
            )
        }
        _ => format!("stop {}", drawn.label),
    };
    vec![format!("{name}, {}", gap(drawn.gap_m)), drawn.law.clone()]
}

/// Returns a gap as text.
pub fn gap(gap_m: f64) -> String {
    match gap_m {
        gap if gap > 0.0 => format!("gap {}", dimension::length(gap)),
        gap if gap < 0.0 => format!("pressed in {}", dimension::length(-gap)),
        _ => "gap 0".to_owned(),
    }
}

/// Draws a tip with its support.
fn stop(
    canvas: &mut Canvas,
    drawing: &Drawing,
    layout: &DrawingLayout,
    drawn: &DrawnContact,
    (x, y): (f64, f64),
    shift: (f64, f64),
) {
    let way = way(drawn);
    let far = y + way * PIN;
    canvas.svg.path(
        &tip(x, y, way, TIP),
        "class=\"jounce-stop\" fill=\"#8a8a8a\" stroke=\"none\"",
    );
    canvas.svg.path(
        &format!(
            "M{x0} {}L{x0} {}",
            number(y + way * 2.0 * TIP),
            number(far),
            x0 = number(x)
        ),
        INK,
    );
    canvas.cover(Rect::between((x - TIP, y), (x + TIP, far)));
    match drawn.on {
        None => {
            ground(
                canvas.svg,
                (x - 0.5 * GROUND, far),
                GROUND,
                if drawn.above {
                    HatchSide::Above
                } else {
                    HatchSide::Below
                },
            );
            canvas.cover(Rect::between(
                (x - 24.0, far),
                (x + 24.0, far + way * HATCH),
            ));
        }
        Some(on) => {
            let mut spot = layout.spots[on.body];
            (spot.x, spot.y) = (spot.x + shift.0, spot.y + shift.1);
            if layout.group[on.body] == layout.group[drawn.at.body] {
                arm(
                    canvas,
                    (x, far),
                    room(drawing, on.body, spot, layout.px_per_m),
                );
            }
        }
    }
}
