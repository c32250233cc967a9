//! The sheet: the groups one below the other, then circuits, close-ups and plan views of plates.

use super::canvas::Canvas;
use super::grips::grips;
use super::layout::DrawingLayout;
use super::layout::rect::Rect;
use super::layout::scale;
use super::parts::plan::PlanView;
use super::parts::{bodies, circuit, close_up, contacts, drives};
use super::symbols::dimension;
use super::{Drawing, DrawnCircuit, DrawnContact, GripSheet, ViewRoom};
use crate::svg::{Anchor, Svg};
use crate::text::{SMALL, TITLE, wrap};

/// Width of a sheet by default, px, and the smallest width.
pub const WIDTH: f64 = 900.0;
pub const MIN_WIDTH: f64 = 320.0;
/// Largest length of the scale bar, relative to the width.
const BAR: f64 = 200.0 / WIDTH;
/// Free edge, px.
const EDGE: f64 = 14.0;
/// Distance of two elements on the sheet, px.
const SPACE: f64 = 26.0;

/// An element under the side view with a fixed size.
enum Cell<'d> {
    Circuit(&'d DrawnCircuit),
    Look(&'d DrawnContact),
    Plan(PlanView<'d>),
}

impl Cell<'_> {
    fn size(&self) -> (f64, f64) {
        match self {
            Cell::Circuit(circuit) => (circuit::wide(circuit), circuit::HIGH),
            Cell::Look(_) => close_up::SIZE,
            Cell::Plan(view) => view.size(),
        }
    }
}

/// Positions of the elements.
struct Content {
    /// Height of the sheet, px.
    height: f64,
    /// Side view.
    side: Rect,
    /// Shift from the layout to the sheet, for each group.
    shifts: Vec<(f64, f64)>,
    /// Circuits, then close-ups, then plan views.
    cells: Vec<Rect>,
}

/// Returns the drawing with the positions of its parts.
pub fn draw_sheet(drawing: &Drawing, room: ViewRoom) -> GripSheet {
    let layout = scale::fitted(drawing, room);
    let mut svg = Svg::new(room.width_px, &drawing.title);
    let sheet_content = content(&mut svg, drawing, &layout, room);
    let first_plan = sheet_content.cells.len() - drawing.plans.len();
    let (cells, plans) = sheet_content.cells.split_at(first_plan);
    let (circuits, close_ups) = cells.split_at(drawing.circuits.len());
    let grips = grips(drawing, &layout, &sheet_content.shifts, close_ups);
    GripSheet {
        svg: svg.finish(sheet_content.height),
        side: sheet_content.side,
        circuits: circuits.to_vec(),
        looks: close_ups.to_vec(),
        plans: plans.to_vec(),
        grips,
    }
}

/// Draws all elements.
fn content(svg: &mut Svg, drawing: &Drawing, layout: &DrawingLayout, room: ViewRoom) -> Content {
    let sheet_width = room.width_px;
    let mut y = 12.0;
    for line in wrap(&drawing.title, TITLE, sheet_width - 2.0 * EDGE) {
        y += TITLE + 4.0;
        svg.text(EDGE, y, TITLE, Anchor::Start, &line);
    }
    y += SPACE;
    let (mut side, mut shifts) = (Rect::EMPTY, Vec::new());
    for number in 0..layout.groups() {
        let (covered, shift) = group(svg, drawing, layout, number, (sheet_width, y));
        y = covered.bottom + SPACE;
        side = side.joined(&covered);
        shifts.push(shift);
    }
    if layout.px_per_m > 0.0 {
        let bar_m = dimension::round_below(BAR * sheet_width / layout.px_per_m);
        dimension::bar(svg, EDGE, y, bar_m * layout.px_per_m);
        let words = format!("{}, the same in both directions", dimension::length(bar_m));
        svg.text(
            EDGE + bar_m * layout.px_per_m + 10.0,
            y + 4.0,
            SMALL,
            Anchor::Start,
            &words,
        );
        side = side.joined(&Rect::between(
            (EDGE, y),
            (EDGE + bar_m * layout.px_per_m, y + 5.0),
        ));
        y += SPACE;
    }
    let close_ups = drawing
        .contacts
        .iter()
        .filter(|contact| close_up::needed(contact, layout.px_per_m))
        .map(Cell::Look);
    let in_room = (sheet_width - 2.0 * EDGE, room.height_px);
    let plans = drawing.plans.iter();
    let plans = plans.map(|plan| Cell::Plan(PlanView::new(plan, in_room)));
    let (height, cells) = cells(
        svg,
        drawing,
        layout,
        drawing
            .circuits
            .iter()
            .map(Cell::Circuit)
            .chain(close_ups)
            .chain(plans),
        (sheet_width, y),
    );
    Content {
        height,
        side,
        shifts,
        cells,
    }
}

/// Draws a group with its upper edge at `y`; returns its area and its shift from the layout to the
/// sheet.
fn group(
    svg: &mut Svg,
    drawing: &Drawing,
    layout: &DrawingLayout,
    number: usize,
    (sheet_width, y): (f64, f64),
) -> (Rect, (f64, f64)) {
    let room = layout.extent(drawing, number);
    let x = 0.5 * (sheet_width - room.width()) - room.left;
    // Labels may extend above the bodies; a first attempt gives the height.
    let attempt = scene(
        &mut Svg::new(sheet_width, ""),
        drawing,
        layout,
        number,
        (sheet_width, (x, 0.0)),
    );
    let shift = (x, y - attempt.top);
    (
        scene(svg, drawing, layout, number, (sheet_width, shift)),
        shift,
    )
}

fn scene(
    svg: &mut Svg,
    drawing: &Drawing,
    layout: &DrawingLayout,
    number: usize,
    (sheet_width, shift): (f64, (f64, f64)),
) -> Rect {
    let mut canvas = Canvas::new(svg, (EDGE, sheet_width - EDGE));
    layout
        .members(number)
        .for_each(|body| bodies::body(&mut canvas, drawing, layout, body, shift));
    for (index, contact) in drawing.contacts.iter().enumerate() {
        if layout.group[contact.at.body] == number {
            contacts::contact(&mut canvas, drawing, layout, index, shift);
        }
    }
    drives::forces(&mut canvas, drawing, layout, number, shift);
    drives::bases(&mut canvas, drawing, layout, number, shift);
    if number == 0 {
        drives::gravity(
            &mut canvas,
            drawing,
            (
                sheet_width - EDGE - 20.0,
                layout.extent(drawing, number).top + shift.1,
            ),
        );
    }
    canvas.finish()
}

/// Places cells in rows; returns their lower edge and the area of each.
fn cells<'d>(
    svg: &mut Svg,
    drawing: &Drawing,
    layout: &DrawingLayout,
    cells: impl Iterator<Item = Cell<'d>>,
    (sheet_width, mut y): (f64, f64),
) -> (f64, Vec<Rect>) {
    let (mut x, mut high, mut covered) = (EDGE, 0.0_f64, Vec::new());
    for cell in cells {
        let (width, height) = cell.size();
        if x > EDGE && x + width > sheet_width - EDGE {
            (x, y, high) = (EDGE, y + high + SPACE, 0.0);
        }
        match cell {
            Cell::Circuit(circuit) => circuit::draw(svg, circuit, (x, y)),
            Cell::Look(contact) => close_up::draw(svg, drawing, contact, (x, y), layout.px_per_m),
            Cell::Plan(view) => view.draw(svg, (x, y)),
        }
        covered.push(Rect::between((x, y), (x + width, y + height)));
        (x, high) = (x + width + SPACE, high.max(height));
    }
    (if high > 0.0 { y + high + SPACE } else { y }, covered)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
