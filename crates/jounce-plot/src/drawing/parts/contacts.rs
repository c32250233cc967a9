//! The stops of a group: gaps between opposite bodies, and tips on the ground or on an arm.

use super::bodies::arm;
use crate::drawing::canvas::{Canvas, INK};
use crate::drawing::layout::assembly::{carrier, face, room};
use crate::drawing::layout::rect::Rect;
use crate::drawing::layout::{DrawingLayout, sign};
use crate::drawing::symbols::dimension;
use crate::drawing::symbols::hatch::{HATCH, HatchSide, ground};
use crate::drawing::symbols::tip;
use crate::drawing::{Drawing, DrawnContact};
use crate::svg::number;

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
    let contact = &drawing.contacts[index];
    let (x, middle) = layout.point(drawing, contact.at);
    let (x, middle, sign) = (x + shift.0, middle + shift.1, sign(contact));
    let near = middle + sign * face(drawing, contact.at, contact.above, layout.px_per_m);
    let stop_face = middle + sign * layout.reach(drawing, contact);
    if (stop_face - near).abs() >= SEEN {
        dimension::arrow(canvas.svg, x, (near, stop_face), true);
        canvas.cover(Rect::between((x - 4.0, near), (x + 4.0, stop_face)));
    }
    if !layout.opposite[index] {
        stop(canvas, drawing, layout, contact, (x, stop_face), shift);
    }
    let anchor = if layout.opposite[index] {
        0.5 * (near + stop_face)
    } else {
        stop_face + sign * PIN
    };
    canvas.label(
        (x, anchor),
        (1.0, 0.3 * sign),
        words(drawing, layout, index),
    );
}

/// Returns the left end of the ground behind a stop, relative to the layout.
pub fn ground_end(drawing: &Drawing, layout: &DrawingLayout, contact: &DrawnContact) -> (f64, f64) {
    let (x, middle) = layout.point(drawing, contact.at);
    let far = middle + sign(contact) * (layout.reach(drawing, contact) + PIN);
    (x - 0.5 * GROUND, far)
}

/// Returns the name with the gap, and the law.
fn words(drawing: &Drawing, layout: &DrawingLayout, index: usize) -> Vec<String> {
    let contact = &drawing.contacts[index];
    let name = match contact.on {
        // The body is named only if the drawing does not show it.
        Some(on)
            if !layout.opposite[index]
                && carrier(drawing, contact.at.body)
                    .is_none_or(|support| support.body != on.body) =>
        {
            format!(
                "stop {} on {}",
                contact.label,
                drawing.bodies[on.body]
                    .words
                    .first()
                    .map_or("", String::as_str)
            )
        }
        _ => format!("stop {}", contact.label),
    };
    vec![
        format!("{name}, {}", gap(contact.gap_m)),
        contact.law.clone(),
    ]
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
    contact: &DrawnContact,
    (x, y): (f64, f64),
    shift: (f64, f64),
) {
    let sign = sign(contact);
    let far = y + sign * PIN;
    canvas.svg.path(
        &tip(x, y, sign, TIP),
        "class=\"jounce-stop\" fill=\"#8a8a8a\" stroke=\"none\"",
    );
    canvas.svg.path(
        &format!(
            "M{x0} {}L{x0} {}",
            number(y + sign * 2.0 * TIP),
            number(far),
            x0 = number(x)
        ),
        INK,
    );
    canvas.cover(Rect::between((x - TIP, y), (x + TIP, far)));
    match contact.on {
        None => {
            ground(
                canvas.svg,
                (x - 0.5 * GROUND, far),
                GROUND,
                if contact.above {
                    HatchSide::Above
                } else {
                    HatchSide::Below
                },
            );
            canvas.cover(Rect::between(
                (x - 24.0, far),
                (x + 24.0, far + sign * HATCH),
            ));
        }
        Some(on) => {
            let mut spot = layout.spots[on.body];
            (spot.x, spot.y) = (spot.x + shift.0, spot.y + shift.1);
            if layout.group[on.body] == layout.group[contact.at.body] {
                arm(
                    canvas,
                    (x, far),
                    room(drawing, on.body, spot, layout.px_per_m),
                );
            }
        }
    }
}
