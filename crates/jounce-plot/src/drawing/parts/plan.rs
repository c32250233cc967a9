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
use crate::text::{SMALL, width, wrap};

/// Largest size of the outline, px.
const ROOM: (f64, f64) = (420.0, 300.0);
/// Smallest length of the short side of the outline where the room is small, px.
const MIN_SIDE: f64 = 40.0;
/// Free space around the outline for supports and labels, px.
const MARGIN: f64 = 16.0;
/// Height of a line of text, px.
const LINE: f64 = 16.0;
/// Radius of a point, px.
const POINT: f64 = 3.0;

const DASHED: &str = "class=\"jounce-rule\" stroke=\"#1a1a1a\" stroke-width=\"1.2\" stroke-dasharray=\"6 4\" fill=\"none\"";
const DOT: &str = "class=\"jounce-ink\" fill=\"#1a1a1a\"";

/// A plan in a room.
pub struct PlanView<'d> {
    plan: &'d DrawnPlan,
    px_per_m: f64,
    /// Lines of the heading.
    heading: Vec<String>,
}

impl<'d> PlanView<'d> {
    /// Fits a plan into a room of a width and height with its labels, px; long labels and the
    /// smallest outline may need more.
    pub fn new(plan: &'d DrawnPlan, (wide, high): (f64, f64)) -> Self {
        let heading: Vec<String> = lines(plan)
            .iter()
            .flat_map(|line| wrap(line, SMALL, wide))
            .collect();
        let wide = wide - 2.0 * MARGIN;
        let high = high - 2.0 * MARGIN - LINE * heading.len() as f64;
        let labels = plan.points.iter().map(|point| {
            let label = width(&point.label, SMALL);
            (wide - label) / point.x_m
        });
        let px_per_m = labels
            .fold(wide.min(ROOM.0) / plan.length_m, f64::min)
            .min(high.min(ROOM.1) / plan.width_m);
        Self {
            plan,
            px_per_m: px_per_m.max(MIN_SIDE / plan.length_m.min(plan.width_m)),
            heading,
        }
    }

    /// Returns width and height with the labels, px.
    pub fn size(&self) -> (f64, f64) {
        let [length, breadth] = self.outline_px();
        let widest = self.heading.iter().map(|line| width(line, SMALL));
        let labels = self
            .plan
            .points
            .iter()
            .map(|point| point.x_m * self.px_per_m + width(&point.label, SMALL) + 2.0 * MARGIN);
        let wide = widest.chain(labels).fold(length + 2.0 * MARGIN, f64::max);
        let high = breadth + 2.0 * MARGIN + LINE * self.heading.len() as f64;
        (wide, high)
    }

    /// Draws the plan with its upper left corner at `(x, y)`; y of the plate points up.
    pub fn draw(&self, svg: &mut Svg, (x, y): (f64, f64)) {
        for (index, line) in self.heading.iter().enumerate() {
            let level = y + LINE * (index as f64 + 0.8);
            svg.text(x, level, SMALL, Anchor::Start, line);
        }
        let corner = (x + MARGIN, y + LINE * self.heading.len() as f64 + MARGIN);
        let [length, breadth] = self.outline_px();
        svg.rect(corner.0, corner.1, length, breadth, BODY);
        for layer in &self.plan.layers {
            self.rectangle(svg, corner, layer, LAYER);
        }
        for patch in &self.plan.patches {
            self.rectangle(svg, corner, patch, PATCH);
        }
        self.edges(svg, corner);
        self.points(svg, (x, y), corner);
    }

    /// Draws the points with their labels, which meet neither the heading nor the outline nor a
    /// patch's edge or name.
    fn points(&self, svg: &mut Svg, (x, y): (f64, f64), corner: (f64, f64)) {
        let [length, breadth] = self.outline_px();
        let (wide, high) = self.size();
        let mut canvas = Canvas::new(svg, (x, x + wide));
        canvas.cover(Rect::between((x, y), (x + wide, corner.1 - MARGIN)));
        canvas.cover(Rect::between((x, y + high - 1.0), (x + wide, y + high)));
        cover_edges(
            &mut canvas,
            Rect::between(corner, (corner.0 + length, corner.1 + breadth)),
        );
        for covered in self.plan.layers.iter().chain(&self.plan.patches) {
            let area = self.area(corner, covered);
            cover_edges(&mut canvas, area);
            let middle = (
                0.5 * (area.left + area.right),
                0.5 * (area.top + area.bottom),
            );
            let name = (width(&name(covered), SMALL), LINE);
            canvas.cover(Rect::around(middle, name));
        }
        for point in &self.plan.points {
            let at = (
                corner.0 + point.x_m * self.px_per_m,
                corner.1 + breadth - point.y_m * self.px_per_m,
            );
            let [left, right, level, radius] =
                [at.0 - POINT, at.0 + POINT, at.1, POINT].map(number);
            canvas.svg.path(
                &format!("M{left} {level}A{radius} {radius} 0 0 1 {right} {level}A{radius} {radius} 0 0 1 {left} {level}Z"),
                DOT,
            );
            canvas.cover(Rect::around(at, (2.0 * POINT, 2.0 * POINT)));
            canvas.label(at, (1.0, 0.0), vec![point.label.clone()]);
        }
        canvas.finish();
    }

    fn outline_px(&self) -> [f64; 2] {
        [self.plan.length_m, self.plan.width_m].map(|side_m| side_m * self.px_per_m)
    }

    fn rectangle(&self, svg: &mut Svg, corner: (f64, f64), covered: &DrawnRectangle, style: &str) {
        let area = self.area(corner, covered);
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
    fn area(&self, corner: (f64, f64), covered: &DrawnRectangle) -> Rect {
        let at = |x_m: f64, y_m: f64| {
            let down_m = self.plan.width_m - y_m;
            (
                corner.0 + x_m * self.px_per_m,
                corner.1 + down_m * self.px_per_m,
            )
        };
        let ([left, right], [front, back]) = (covered.x_m, covered.y_m);
        Rect::between(at(left, back), at(right, front))
    }

    /// Draws the supports of the four edges.
    fn edges(&self, svg: &mut Svg, (x, y): (f64, f64)) {
        let [length, breadth] = self.outline_px();
        let [left, right, front, back] = self.plan.edges;
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

/// Returns the name of a layer or a patch, with its face.
fn name(covered: &DrawnRectangle) -> String {
    let face = if covered.top { "" } else { " (below)" };
    format!("{}{face}", covered.label)
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
