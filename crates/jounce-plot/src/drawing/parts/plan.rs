//! A plan view of a plate: outline, supports of its edges, layers, patches, points and what stands
//! on them, with its own scale.

use super::bodies::{BODY, LAYER, PATCH};
use crate::drawing::DrawnPlan;
use crate::drawing::canvas::Canvas;
use crate::drawing::layout::rect::Rect;
use crate::drawing::model::{DrawnEdge, DrawnRectangle};
use crate::drawing::symbols::dimension;
use crate::drawing::symbols::hatch::{HatchSide, ground};
use crate::svg::{Anchor, Svg, number};
use crate::text::{SMALL, width};

/// Largest size of the outline, px.
const ROOM: (f64, f64) = (420.0, 300.0);
/// Free space around the outline for supports and labels, px.
const MARGIN: f64 = 16.0;
/// Height of a line of text, px.
const LINE: f64 = 16.0;
/// Radius of a point, px.
const POINT: f64 = 3.0;

const DASHED: &str = "class=\"jounce-rule\" stroke=\"#1a1a1a\" stroke-width=\"1.2\" stroke-dasharray=\"6 4\" fill=\"none\"";
const DOT: &str = "class=\"jounce-ink\" fill=\"#1a1a1a\"";

/// Returns width and height of a plan with its labels, px.
pub fn size(plan: &DrawnPlan) -> (f64, f64) {
    let [length, breadth] = outline_px(plan);
    let widest = lines(plan)
        .iter()
        .map(|line| width(line, SMALL))
        .fold(0.0, f64::max);
    let labels = plan
        .points
        .iter()
        .map(|point| point.x_m * px_per_m(plan) + width(&point.label, SMALL) + 2.0 * MARGIN);
    let wide = labels.fold(length + 2.0 * MARGIN, f64::max);
    let high = breadth + 2.0 * MARGIN + LINE * lines(plan).len() as f64;
    (wide.max(widest), high)
}

/// Draws a plan with its upper left corner at `(x, y)`; y of the plate points up.
pub fn draw(svg: &mut Svg, plan: &DrawnPlan, (x, y): (f64, f64)) {
    let words = lines(plan);
    for (index, line) in words.iter().enumerate() {
        svg.text(
            x,
            y + LINE * (index as f64 + 0.8),
            SMALL,
            Anchor::Start,
            line,
        );
    }
    let corner = (x + MARGIN, y + LINE * words.len() as f64 + MARGIN);
    let [length, breadth] = outline_px(plan);
    svg.rect(corner.0, corner.1, length, breadth, BODY);
    for layer in &plan.layers {
        rectangle(svg, plan, corner, layer, LAYER);
    }
    for patch in &plan.patches {
        rectangle(svg, plan, corner, patch, PATCH);
    }
    edges(svg, plan, corner);
    points(svg, plan, (x, y), corner);
}

/// Draws the points with their labels, which meet neither the heading nor the outline nor a patch's
/// edge or name.
fn points(svg: &mut Svg, plan: &DrawnPlan, (x, y): (f64, f64), corner: (f64, f64)) {
    let (scale, [length, breadth]) = (px_per_m(plan), outline_px(plan));
    let (wide, high) = size(plan);
    let mut canvas = Canvas::new(svg, (x, x + wide));
    canvas.cover(Rect::between((x, y), (x + wide, corner.1 - MARGIN)));
    canvas.cover(Rect::between((x, y + high - 1.0), (x + wide, y + high)));
    cover_edges(
        &mut canvas,
        Rect::between(corner, (corner.0 + length, corner.1 + breadth)),
    );
    for covered in plan.layers.iter().chain(&plan.patches) {
        let area = area(plan, corner, covered);
        cover_edges(&mut canvas, area);
        let middle = (
            0.5 * (area.left + area.right),
            0.5 * (area.top + area.bottom),
        );
        let name = (width(&name(covered), SMALL), LINE);
        canvas.cover(Rect::around(middle, name));
    }
    for point in &plan.points {
        let at = (
            corner.0 + point.x_m * scale,
            corner.1 + breadth - point.y_m * scale,
        );
        let [left, right, level, radius] = [at.0 - POINT, at.0 + POINT, at.1, POINT].map(number);
        canvas.svg.path(
            &format!("M{left} {level}A{radius} {radius} 0 0 1 {right} {level}A{radius} {radius} 0 0 1 {left} {level}Z"),
            DOT,
        );
        canvas.cover(Rect::around(at, (2.0 * POINT, 2.0 * POINT)));
        canvas.label(at, (1.0, 0.0), vec![point.label.clone()]);
    }
    canvas.finish();
}

/// Marks the edges of a rectangle as covered.
fn cover_edges(canvas: &mut Canvas, rect: Rect) {
    let (far, near) = ((rect.right, rect.bottom), (rect.left, rect.top));
    for end in [(rect.right, rect.top), (rect.left, rect.bottom)] {
        canvas.cover(Rect::between(near, end).grown(1.0));
        canvas.cover(Rect::between(end, far).grown(1.0));
    }
}

/// Returns the label: name, sizes, and the meaning of the symbols of the edges.
fn lines(plan: &DrawnPlan) -> Vec<String> {
    let size = dimension::size([plan.length_m, plan.width_m, plan.thickness_m]);
    vec![
        format!("{}, seen from above", plan.label),
        format!("{size}; hatched: clamped, dashed: simply supported"),
    ]
}

fn px_per_m(plan: &DrawnPlan) -> f64 {
    (ROOM.0 / plan.length_m).min(ROOM.1 / plan.width_m)
}

fn outline_px(plan: &DrawnPlan) -> [f64; 2] {
    [plan.length_m, plan.width_m].map(|side_m| side_m * px_per_m(plan))
}

fn rectangle(
    svg: &mut Svg,
    plan: &DrawnPlan,
    corner: (f64, f64),
    covered: &DrawnRectangle,
    style: &str,
) {
    let area = area(plan, corner, covered);
    let opacity = if covered.top { "0.9" } else { "0.45" };
    svg.rect(
        area.left,
        area.top,
        area.width(),
        area.height(),
        &format!("{style} fill-opacity=\"{opacity}\""),
    );
    svg.text(
        0.5 * (area.left + area.right),
        0.5 * (area.top + area.bottom) + 4.0,
        SMALL,
        Anchor::Middle,
        &name(covered),
    );
}

/// Returns the area of a layer or a patch on the sheet.
fn area(plan: &DrawnPlan, corner: (f64, f64), covered: &DrawnRectangle) -> Rect {
    let scale = px_per_m(plan);
    let at = |x_m: f64, y_m: f64| {
        let down_m = plan.width_m - y_m;
        (corner.0 + x_m * scale, corner.1 + down_m * scale)
    };
    let ([left, right], [front, back]) = (covered.x_m, covered.y_m);
    Rect::between(at(left, back), at(right, front))
}

/// Returns the name of a layer or a patch, with its face.
fn name(covered: &DrawnRectangle) -> String {
    let face = if covered.top { "" } else { " (below)" };
    format!("{}{face}", covered.label)
}

/// Draws the supports of the four edges.
fn edges(svg: &mut Svg, plan: &DrawnPlan, (x, y): (f64, f64)) {
    let [length, breadth] = outline_px(plan);
    let [left, right, front, back] = plan.edges;
    let sides = [
        (left, (x, y), breadth, HatchSide::Left),
        (right, (x + length, y), breadth, HatchSide::Right),
        (front, (x, y + breadth), length, HatchSide::Below),
        (back, (x, y), length, HatchSide::Above),
    ];
    for (edge, start, extent, far) in sides {
        match edge {
            DrawnEdge::Clamped => ground(svg, start, extent, far),
            DrawnEdge::SimplySupported => dashed(svg, start, extent, far),
            DrawnEdge::Free => {}
        }
    }
}

/// Draws a dashed line outside an edge.
fn dashed(svg: &mut Svg, (x, y): (f64, f64), extent: f64, far: HatchSide) {
    let away = 4.0;
    let (from, to) = match far {
        HatchSide::Left => ((x - away, y), (x - away, y + extent)),
        HatchSide::Right => ((x + away, y), (x + away, y + extent)),
        HatchSide::Below => ((x, y + away), (x + extent, y + away)),
        HatchSide::Above => ((x, y - away), (x + extent, y - away)),
    };
    let [x0, y0, x1, y1] = [from.0, from.1, to.0, to.1].map(number);
    svg.path(&format!("M{x0} {y0}L{x1} {y1}"), DASHED);
}
