//! Drives of a group.

use super::bodies::WALL;
use super::contacts;
use crate::drawing::canvas::Canvas;
use crate::drawing::layout::DrawingLayout;
use crate::drawing::layout::assembly::{face, room};
use crate::drawing::layout::rect::Rect;
use crate::drawing::symbols::dimension;
use crate::drawing::{Drawing, DrawnDrive, DrawnPlace, DrawnShape, Seat};
use std::collections::BTreeSet;

/// Height of the arrow of a drive, px.
const ARROW: f64 = 36.0;

/// Distance of the arrow of a base from the body on it, px.
const ASIDE: f64 = 20.0;

/// Draws the forces on the bodies of a group.
pub fn forces(
    canvas: &mut Canvas,
    drawing: &Drawing,
    layout: &DrawingLayout,
    group: usize,
    shift: (f64, f64),
) {
    for drive in &drawing.drives {
        let Some(position) = drive
            .at
            .filter(|position| layout.group[position.body] == group)
        else {
            continue;
        };
        let (x, y) = arrow_at(drawing, layout, position, shift);
        arrow(canvas, x, y);
        let side = if y > layout.spots[position.body].y + shift.1 {
            1.0
        } else {
            -1.0
        };
        canvas.label(
            (x, y + side * 0.5 * ARROW),
            (-0.5, side),
            vec![drive.words.clone()],
        );
    }
}

/// Returns the position of the arrow of a force: at the side of a mass, over a point of a beam.
fn arrow_at(
    drawing: &Drawing,
    layout: &DrawingLayout,
    position: DrawnPlace,
    shift: (f64, f64),
) -> (f64, f64) {
    let (x, y) = layout.point(drawing, position);
    if let DrawnShape::Beam(_) = drawing.bodies[position.body].shape {
        // On the face without contact.
        let above = !drawing
            .contacts
            .iter()
            .any(|contact| contact.above && contact.at == position);
        let side = if above { -1.0 } else { 1.0 };
        return (
            x + shift.0,
            y + shift.1
                + side * (face(drawing, position, above, layout.px_per_m) + 6.0 + 0.5 * ARROW),
        );
    }
    let room = room(
        drawing,
        position.body,
        layout.spots[position.body],
        layout.px_per_m,
    );
    // A beam on the mass extends to the right first.
    (room.left + shift.0 - 14.0, y + shift.1)
}

fn arrow(canvas: &mut Canvas, x: f64, y: f64) {
    dimension::arrow(canvas.svg, x, (y + 0.5 * ARROW, y - 0.5 * ARROW), true);
    canvas.cover(Rect::around((x, y), (10.0, ARROW)));
}

/// Draws the motions of bases, each base separately.
pub fn bases(
    canvas: &mut Canvas,
    drawing: &Drawing,
    layout: &DrawingLayout,
    group: usize,
    shift: (f64, f64),
) {
    let names: BTreeSet<&String> = drawing
        .drives
        .iter()
        .filter_map(|drive| drive.base.as_ref())
        .collect();
    for name in names {
        let moving: Vec<&DrawnDrive> = drawing
            .drives
            .iter()
            .filter(|drive| drive.base.as_ref() == Some(name))
            .collect();
        let Some((x, y)) = drive_position(drawing, layout, group, moving[0]) else {
            continue;
        };
        let (x, y) = (x + shift.0, y + shift.1);
        dimension::arrow(canvas.svg, x, (y + WALL, y - WALL), true);
        canvas.cover(Rect::around((x, y), (10.0, 2.0 * WALL)));
        canvas.label(
            (x, y - WALL),
            (-0.5, -1.0),
            moving.iter().map(|drive| drive.words.clone()).collect(),
        );
    }
}

/// Returns the position of the arrow of a base in a group: at the side of its first clamped or
/// sprung body, else of a stop on it, else of another body on it. `None` if the group has none of
/// these.
fn drive_position(
    drawing: &Drawing,
    layout: &DrawingLayout,
    group: usize,
    drive: &DrawnDrive,
) -> Option<(f64, f64)> {
    let centre = |body: &usize| (layout.spots[*body].x, layout.spots[*body].y);
    let bodies = || {
        layout
            .members(group)
            .filter(|body| drive.carried_bodies.contains(body))
    };
    let of = |seat: Seat| bodies().filter(move |body| drawing.bodies[*body].seat == seat);
    let leftmost = |seat: Seat| {
        of(seat).min_by(|a, b| {
            centre(a)
                .0
                .total_cmp(&centre(b).0)
                .then(centre(a).1.total_cmp(&centre(b).1))
        })
    };
    let at_side = |body: usize| {
        let spot = layout.spots[body];
        let room = room(drawing, body, spot, layout.px_per_m);
        (
            if spot.way < 0.0 {
                room.right + ASIDE
            } else {
                room.left - ASIDE
            },
            0.5 * (room.top + room.bottom),
        )
    };
    let stop = || {
        let mut contacts = drive.stops.iter().map(|index| &drawing.contacts[*index]);
        contacts
            .find(|contact| layout.group[contact.at.body] == group)
            .map(|contact| contacts::ground_end(drawing, layout, contact))
    };
    let support = leftmost(Seat::Ground).or_else(|| leftmost(Seat::Spring(None)));
    support
        .map(at_side)
        .or_else(|| stop().map(|(x, y)| (x - ASIDE, y)))
        .or_else(|| bodies().next().map(at_side))
}

/// Draws the arrow of gravity at a position on the sheet.
pub fn gravity(canvas: &mut Canvas, drawing: &Drawing, (x, y): (f64, f64)) {
    let Some((words, up)) = &drawing.gravity else {
        return;
    };
    let ends = if *up { (y + ARROW, y) } else { (y, y + ARROW) };
    dimension::arrow(canvas.svg, x, ends, false);
    canvas.cover(Rect::between((x - 5.0, y), (x + 5.0, y + ARROW)));
    canvas.label((x, y + 0.5 * ARROW), (-1.0, 0.0), vec![words.clone()]);
}
