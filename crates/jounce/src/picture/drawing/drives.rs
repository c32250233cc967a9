//! What shakes a group.

use super::assembly::{face, room};
use super::bodies::WALL;
use super::canvas::Canvas;
use super::layout::Layout;
use super::rect::Rect;
use super::{Drawing, DrawnDrive, DrawnPlace, DrawnShape, Seat, dimension};

/// Height of the arrow of a drive, px.
const ARROW: f64 = 36.0;

/// The forces on the bodies of a group.
pub fn forces(canvas: &mut Canvas, drawing: &Drawing, layout: &Layout, group: usize, shift: (f64, f64)) {
    for drive in &drawing.drives {
        let Some(place) = drive.at.filter(|place| layout.group[place.body] == group) else { continue };
        let (x, y) = arrow_at(drawing, layout, place, shift);
        arrow(canvas, x, y);
        let side = if y > layout.spots[place.body].y + shift.1 { 1.0 } else { -1.0 };
        canvas.label((x, y + side * 0.5 * ARROW), (-0.5, side), vec![drive.words.clone()]);
    }
}

/// Where the arrow of a force stands: beside a mass, over a point of a beam.
fn arrow_at(drawing: &Drawing, layout: &Layout, place: DrawnPlace, shift: (f64, f64)) -> (f64, f64) {
    let (x, y) = layout.point(drawing, place);
    if let DrawnShape::Beam(_) = drawing.bodies[place.body].shape {
        // On the face that nothing strikes there.
        let above = !drawing.contacts.iter().any(|contact| contact.above && contact.at == place);
        let side = if above { -1.0 } else { 1.0 };
        return (x + shift.0, y + shift.1 + side * (face(drawing, place, above, layout.px_per_m) + 6.0 + 0.5 * ARROW));
    }
    let room = room(drawing, place.body, layout.spots[place.body], layout.px_per_m);
    // A beam that the mass carries leaves it on the right first.
    (room.left + shift.0 - 14.0, y + shift.1)
}

fn arrow(canvas: &mut Canvas, x: f64, y: f64) {
    dimension::arrow(canvas.svg, x, (y + 0.5 * ARROW, y - 0.5 * ARROW), true);
    canvas.cover(Rect::around((x, y), (10.0, ARROW)));
}

/// Motions of bases: an arrow beside the first body of the group that stands on one.
pub fn base(canvas: &mut Canvas, drawing: &Drawing, layout: &Layout, group: usize, shift: (f64, f64)) {
    let carries = |drive: &&DrawnDrive| drive.at.is_none() && drive.carried.iter().any(|body| layout.group[*body] == group);
    let moving: Vec<&DrawnDrive> = drawing.drives.iter().filter(carries).collect();
    let words: Vec<String> = moving.iter().map(|drive| drive.words.clone()).collect();
    let left = |body: &usize| (layout.spots[*body].x, layout.spots[*body].y);
    let is_carried = |body: &usize| moving.iter().any(|drive| drive.carried.contains(body));
    let of = |seat: Seat| layout.members(group).filter(move |body| is_carried(body) && drawing.bodies[*body].seat == seat);
    let leftmost = |seat: Seat| of(seat).min_by(|a, b| left(a).0.total_cmp(&left(b).0).then(left(a).1.total_cmp(&left(b).1)));
    let foot = leftmost(Seat::Ground).or_else(|| leftmost(Seat::Spring(None))).or_else(|| layout.members(group).next());
    let Some(body) = foot.filter(|_| !words.is_empty()) else { return };
    let spot = layout.spots[body];
    let room = room(drawing, body, spot, layout.px_per_m);
    let x = if spot.way < 0.0 { room.right + 20.0 } else { room.left - 20.0 };
    let (x, y) = (x + shift.0, 0.5 * (room.top + room.bottom) + shift.1);
    dimension::arrow(canvas.svg, x, (y + WALL, y - WALL), true);
    canvas.cover(Rect::around((x, y), (10.0, 2.0 * WALL)));
    canvas.label((x, y - WALL), (-0.5, -1.0), words);
}

/// The arrow of gravity at a place of the sheet.
pub fn gravity(canvas: &mut Canvas, drawing: &Drawing, (x, y): (f64, f64)) {
    let Some((words, up)) = &drawing.gravity else { return };
    let ends = if *up { (y + ARROW, y) } else { (y, y + ARROW) };
    dimension::arrow(canvas.svg, x, ends, false);
    canvas.cover(Rect::between((x - 5.0, y), (x + 5.0, y + ARROW)));
    canvas.label((x, y + 0.5 * ARROW), (-1.0, 0.0), vec![words.clone()]);
}
