//! Drawing of the bodies of a group.

use crate::drawing::canvas::{Canvas, INK, THIN};
use crate::drawing::layout::DrawingLayout;
use crate::drawing::layout::assembly::{DrawnSpot, SPRING, carrier, room, sides, thick, under};
use crate::drawing::layout::labels::size_of;
use crate::drawing::layout::rect::Rect;
use crate::drawing::symbols::dimension;
use crate::drawing::symbols::hatch::{HATCH, HatchSide, ground};
use crate::drawing::symbols::spring;
use crate::drawing::{Drawing, DrawnBeam, DrawnShape, Seat};
use crate::svg::number;

/// Style of a mass, of a patch and of a layer.
pub const BODY: &str =
    "class=\"jounce-body\" fill=\"#dfe3e8\" stroke=\"#1a1a1a\" stroke-width=\"1.2\"";
pub const PATCH: &str = "class=\"jounce-patch\" fill=\"#e69f00\"";
pub const LAYER: &str = "class=\"jounce-layer\" fill=\"#56b4e9\"";
/// Possible starts of the leader of a patch's name, as fractions of its length.
const STARTS: [f64; 4] = [0.0, 0.25, 0.75, 1.0];
/// Half the height of the wall of a clamped beam, px.
pub const WALL: f64 = 20.0;

/// Draws a body, with `shift` from the layout to the sheet.
pub fn body(
    canvas: &mut Canvas,
    drawing: &Drawing,
    layout: &DrawingLayout,
    body: usize,
    shift: (f64, f64),
) {
    let body_drawing = &drawing.bodies[body];
    let mut spot = layout.spots[body];
    (spot.x, spot.y) = (spot.x + shift.0, spot.y + shift.1);
    let covered = room(drawing, body, spot, layout.px_per_m);
    let middle = (
        0.5 * (covered.left + covered.right),
        0.5 * (covered.top + covered.bottom),
    );
    match &body_drawing.shape {
        DrawnShape::Beam(shape) => {
            beam_body(canvas, drawing, layout, (body, shape), (spot, shift));
            return;
        }
        DrawnShape::Ball => {
            let (left, right, y, r) = (
                number(covered.left),
                number(covered.right),
                number(middle.1),
                number(0.5 * covered.width()),
            );
            canvas.svg.path(
                &format!("M{left} {y}A{r} {r} 0 0 1 {right} {y}A{r} {r} 0 0 1 {left} {y}Z"),
                BODY,
            );
            canvas.cover(covered);
        }
        DrawnShape::Block | DrawnShape::Given => canvas.solid(covered, BODY),
    }
    seat(canvas, drawing, body, covered);
    // Off the middle of its sides, where a beam may stand on it or a spring may carry it.
    let quarters = [-0.25, 0.25].map(|part| {
        let along = middle.0 + part * covered.width();
        [
            (covered.right, middle.1 + part * covered.height()),
            (along, covered.top),
            (along, covered.bottom),
        ]
    });
    let others = match body_drawing.shape == DrawnShape::Ball {
        true => Vec::new(),
        false => quarters.concat(),
    };
    canvas.label_along(
        (covered.right, middle.1),
        others,
        (1.0, 0.0),
        body_drawing.words.clone(),
    );
}

/// Draws a beam on its support, with its name and its size.
fn beam_body(
    canvas: &mut Canvas,
    drawing: &Drawing,
    layout: &DrawingLayout,
    (body, shape): (usize, &DrawnBeam),
    (spot, shift): (DrawnSpot, (f64, f64)),
) {
    let body_drawing = &drawing.bodies[body];
    let foot = carrier(drawing, body)
        .map(|support| layout.point(drawing, support).1 + shift.1)
        .filter(|y| (y - spot.y).abs() > 1.0);
    if let Some(y) = foot.filter(|_| {
        matches!(
            drawing.bodies[carrier(drawing, body).map_or(0, |p| p.body)].shape,
            DrawnShape::Beam(_)
        )
    }) {
        canvas.solid(
            Rect::between((spot.x - 4.0, spot.y), (spot.x + 4.0, y)),
            BODY,
        );
    }
    beam(canvas, shape, spot.way, (spot.x, spot.y), layout.px_per_m);
    if body_drawing.seat == Seat::Ground {
        wall(canvas, (spot.x, spot.y), spot.way);
    }
    let mut words = body_drawing.words.clone();
    words.push(dimension::size([
        shape.length_m,
        shape.width_m,
        shape.thickness_m,
    ]));
    let name_px = size_of(&words).0;
    let at = (spot.x, spot.y);
    let (anchor, toward) = named_at(shape, at, spot.way, layout.px_per_m, name_px);
    // If another beam lies close to this face, the name goes to the other face.
    let other = (toward.1 != 0.0).then_some((anchor.0, 2.0 * spot.y - anchor.1));
    canvas.label_along(anchor, other.into_iter().collect(), toward, words);
}

/// Returns the longest stretch of a face of a beam without patch and layer, as distances from the root,
/// m; its ends are equal where there is none.
fn bare_stretch(beam: &DrawnBeam, top: bool) -> (f64, f64) {
    let covers = beam.patches.iter().chain(&beam.layers);
    let mut covered: Vec<(f64, f64)> = covers
        .filter(|cover| cover.top == top)
        .map(|cover| (cover.start_m, cover.start_m + cover.length_m))
        .collect();
    covered.sort_by(|a, b| a.0.total_cmp(&b.0));
    covered.push((beam.length_m, beam.length_m));
    let (mut longest, mut end_m) = ((0.0, 0.0), 0.0_f64);
    for (from_m, to_m) in covered {
        if from_m - end_m > longest.1 - longest.0 {
            longest = (end_m, from_m);
        }
        end_m = end_m.max(to_m);
    }
    longest
}

/// Returns the position of a beam's name: over the middle of the longest bare stretch of its upper face,
/// because the names of points hang below it; else of its lower face; else at its right end. A stretch is
/// the complete face, or as long as the name.
fn named_at(
    beam: &DrawnBeam,
    (x, y): (f64, f64),
    sign: f64,
    px_per_m: f64,
    name_px: f64,
) -> ((f64, f64), (f64, f64)) {
    let half = 0.5 * thick(beam.thickness_m, px_per_m);
    let [above, below] = [true, false].map(|top| bare_stretch(beam, top));
    let fits = |stretch: &(f64, f64)| {
        let size_m = stretch.1 - stretch.0;
        size_m >= beam.length_m || size_m * px_per_m >= name_px
    };
    let sides = [(above, -1.0), (below, 1.0)];
    if let Some((stretch, side)) = sides.into_iter().find(|(stretch, _)| fits(stretch)) {
        let middle = x + sign * 0.5 * (stretch.0 + stretch.1) * px_per_m;
        return ((middle, y + side * half), (0.0, side));
    }
    let end = match sign > 0.0 {
        true => x + beam.length_m * px_per_m,
        false => x + HATCH,
    };
    ((end, y), (1.0, 0.0))
}

/// Draws the spring or the wall of a mass.
fn seat(canvas: &mut Canvas, drawing: &Drawing, body: usize, covered: Rect) {
    let Seat::Spring(on) = drawing.bodies[body].seat else {
        return;
    };
    let (above, below) = sides(drawing, body);
    // Opposite to the contact; at the side if there are contacts on both sides.
    let x = if above && below {
        covered.right - 16.0
    } else {
        0.5 * (covered.left + covered.right)
    };
    let up = on.is_none() && below && !above;
    let (from, to) = if up {
        (covered.top, covered.top - SPRING)
    } else {
        (covered.bottom, covered.bottom + SPRING)
    };
    spring(canvas.svg, x, from, to);
    let end = if up { to - HATCH } else { to + HATCH };
    canvas.cover(Rect::between((x - 10.0, from), (x + 10.0, to)));
    if on.is_none() {
        ground(
            canvas.svg,
            (x - 25.0, to),
            50.0,
            if up {
                HatchSide::Above
            } else {
                HatchSide::Below
            },
        );
        canvas.cover(Rect::between((x - 31.0, to), (x + 31.0, end)));
    }
}

fn wall(canvas: &mut Canvas, (x, y): (f64, f64), sign: f64) {
    ground(
        canvas.svg,
        (x, y - WALL),
        2.0 * WALL,
        if sign > 0.0 {
            HatchSide::Left
        } else {
            HatchSide::Right
        },
    );
    canvas.cover(Rect::between(
        (x, y - WALL),
        (x - sign * HATCH, y + WALL + HATCH),
    ));
}

/// Draws a beam with its layers, its patches and its places, its root at `(x, y)`.
fn beam(canvas: &mut Canvas, beam: &DrawnBeam, sign: f64, (x, y): (f64, f64), px_per_m: f64) {
    let half = 0.5 * thick(beam.thickness_m, px_per_m);
    let at = |along_m: f64| x + sign * along_m * px_per_m;
    canvas.solid(
        Rect::between((x, y - half), (at(beam.length_m), y + half)),
        "class=\"jounce-beam\" fill=\"#4a5560\"",
    );
    let layers = beam.layers.iter().map(|layer| (layer, 0.0, LAYER));
    let patches = beam
        .patches
        .iter()
        .map(|patch| (patch, under(beam, patch, px_per_m), PATCH));
    for (cover, lifted, style) in layers.chain(patches) {
        let side = if cover.top { -1.0 } else { 1.0 };
        let (near, far) = (
            y + side * (half + lifted),
            y + side * (half + lifted + thick(cover.thickness_m, px_per_m)),
        );
        let (from, to) = (at(cover.start_m), at(cover.start_m + cover.length_m));
        canvas.solid(Rect::between((from, near), (to, far)), style);
        let size = dimension::size([cover.length_m, cover.width_m, cover.thickness_m]);
        let words = format!("{}: {size}", cover.label);
        // Only the end is visible of a layer under another one.
        let (anchor, toward) = if style == LAYER {
            ((to, 0.5 * (near + far)), (0.5 * sign, side))
        } else {
            ((0.5 * (from + to), far), (0.0, side))
        };
        let others = if style == LAYER {
            Vec::new()
        } else {
            STARTS.map(|part| (from + part * (to - from), far)).to_vec()
        };
        canvas.label_along(anchor, others, toward, vec![words]);
    }
    for (name, along_m) in &beam.points {
        let (point, low) = (at(*along_m), y + half);
        canvas.svg.path(
            &format!(
                "M{x0} {}L{x0} {}",
                number(low),
                number(low + 8.0),
                x0 = number(point)
            ),
            THIN,
        );
        canvas.cover(Rect::between((point - 1.0, low), (point + 1.0, low + 8.0)));
        canvas.label(
            (point, low + 8.0),
            (0.0, 1.0),
            vec![format!("{name} {}", dimension::length(*along_m))],
        );
    }
}

/// Draws the arm of a stop fixed to a body: from the stop at `tip` over its own height to the side
/// of its carrier, where it stands between the middle, which may carry a spring, and the nearer end.
pub fn arm(canvas: &mut Canvas, tip: (f64, f64), carrier: Rect) {
    let middle = 0.5 * (carrier.left + carrier.right);
    let x = 0.5 * (middle + tip.0.clamp(carrier.left, carrier.right));
    let edge = if tip.1 < carrier.top {
        carrier.top
    } else {
        carrier.bottom
    };
    let steps = format!(
        "M{} {y}L{c} {y}L{c} {}",
        number(tip.0),
        number(edge),
        y = number(tip.1),
        c = number(x)
    );
    canvas.svg.path(&steps, INK);
    canvas.cover(Rect::between((tip.0, tip.1 - 2.0), (x, tip.1 + 2.0)));
}
