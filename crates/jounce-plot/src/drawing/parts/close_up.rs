//! Close-up of a stop: the gap and its two sides, at a larger scale.

use super::bodies::{BODY, LAYER, PATCH};
use super::contacts;
use crate::drawing::canvas::THIN;
use crate::drawing::layout::assembly::covers;
use crate::drawing::symbols::dimension;
use crate::drawing::symbols::hatch::{HatchSide, ground};
use crate::drawing::{Drawing, DrawnContact, DrawnPatch, DrawnPlace, DrawnShape, symbols};
use crate::svg::{Anchor, Svg, number};
use crate::text::SMALL;

/// Size of a close-up, px.
pub const SIZE: (f64, f64) = (260.0, 190.0);

/// Height of a mass, px.
const MASS: f64 = 34.0;

/// Style of a beam.
const BEAM: &str = "class=\"jounce-beam\" fill=\"#4a5560\" fill-opacity=\"0.9\"";

/// Height of the gap and the striking body together, px.
const FILLED: f64 = 60.0;

/// True where a stop needs a close-up: its gap is not zero but too small at the scale of the side
/// view.
pub fn needed(contact: &DrawnContact, px_per_m: f64) -> bool {
    px_per_m > 0.0 && contact.gap_m != 0.0 && contact.gap_m * px_per_m < contacts::SEEN
}

/// Dimensions of a close-up.
pub struct CloseUpSize {
    /// Pixels per metre.
    scale: f64,
    /// -1 if the struck face is above.
    way: f64,
    /// Height of the striking face, px under the upper edge of the window.
    face: f64,
    /// Height of the struck face.
    stop_face: f64,
}

/// Distance of the window from the upper edge of the close-up, and its height, px.
const WINDOW: (f64, f64) = (26.0, SIZE.1 - 54.0);

impl CloseUpSize {
    /// Returns the dimensions for a contact.
    pub fn of(drawing: &Drawing, contact: &DrawnContact) -> Self {
        let total_thickness_m: f64 = plies(drawing, contact.at, contact.above)
            .iter()
            .map(|(thickness_m, _)| thickness_m)
            .sum();
        let scale = FILLED / (contact.gap_m.abs() + total_thickness_m);
        let sign = if contact.above { -1.0 } else { 1.0 };
        let face = 0.5 * WINDOW.1 - sign * (0.5 * FILLED - total_thickness_m * scale);
        Self {
            scale,
            way: sign,
            face,
            stop_face: face + sign * contact.gap_m * scale,
        }
    }

    /// Returns the position of the struck face in a close-up with its upper left corner at
    /// `(x, y)`, and its derivative by the gap, px/m.
    pub fn grip(&self, (x, y): (f64, f64)) -> ((f64, f64), f64) {
        (
            (x + 0.5 * SIZE.0, y + WINDOW.0 + self.stop_face),
            self.way * self.scale,
        )
    }
}

/// Returns the plies of a beam at a place, from its upper or lower face on: thickness, m, and
/// style. Empty for a mass.
fn plies(drawing: &Drawing, position: DrawnPlace, top: bool) -> Vec<(f64, &'static str)> {
    let DrawnShape::Beam(beam) = &drawing.bodies[position.body].shape else {
        return Vec::new();
    };
    let at = |covering: &'static str, coverings: &[DrawnPatch], side: bool| {
        let covering_here = coverings
            .iter()
            .find(|cover| cover.top == side && covers(cover, position.along_m));
        covering_here.map(|cover| (cover.thickness_m, covering))
    };
    let near = [at(PATCH, &beam.patches, top), at(LAYER, &beam.layers, top)];
    let far = [
        at(LAYER, &beam.layers, !top),
        at(PATCH, &beam.patches, !top),
    ];
    near.into_iter()
        .flatten()
        .chain([(beam.thickness_m, BEAM)])
        .chain(far.into_iter().flatten())
        .collect()
}

/// Draws a close-up with its upper left corner at `(x, y)`; `px_per_m` is the scale of the side
/// view.
pub fn draw(
    svg: &mut Svg,
    drawing: &Drawing,
    contact: &DrawnContact,
    (x, y): (f64, f64),
    px_per_m: f64,
) {
    svg.rect(x, y, SIZE.0, SIZE.1, THIN);
    let CloseUpSize {
        scale,
        way: sign,
        face,
        stop_face,
    } = CloseUpSize::of(drawing, contact);
    svg.text(
        x + 8.0,
        y + 18.0,
        SMALL,
        Anchor::Start,
        &format!("stop {}, {}", contact.label, contacts::gap(contact.gap_m)),
    );
    svg.open_window(x, y + WINDOW.0, SIZE.0, WINDOW.1);
    let middle = 0.5 * SIZE.0;
    side(
        svg,
        (face, -sign),
        &plies(drawing, contact.at, contact.above),
        scale,
    );
    match contact.on {
        None => ground_tip(svg, (middle, stop_face), sign),
        Some(on) => side(
            svg,
            (stop_face, sign),
            &plies(drawing, on, !contact.above),
            scale,
        ),
    }
    let at = middle + 42.0;
    dimension::arrow(svg, at, (face, stop_face), true);
    let level = format!(
        "M{} {y}L{} {y}",
        number(middle + 10.0),
        number(at + 8.0),
        y = number(stop_face)
    );
    svg.path(&level, THIN);
    svg.close_window();
    svg.text(
        x + 8.0,
        y + SIZE.1 - 10.0,
        SMALL,
        Anchor::Start,
        &times(scale / px_per_m),
    );
}

/// Draws the tip of a stop on the ground; `sign` is -1 if it is above the gap.
fn ground_tip(svg: &mut Svg, (middle, stop_face): (f64, f64), sign: f64) {
    svg.path(
        &symbols::tip(middle, stop_face, sign, 14.0),
        "class=\"jounce-stop\" fill=\"#8a8a8a\" fill-opacity=\"0.8\" stroke=\"none\"",
    );
    ground(
        svg,
        (middle - 50.0, stop_face + sign * 28.0),
        100.0,
        if sign < 0.0 {
            HatchSide::Above
        } else {
            HatchSide::Below
        },
    );
}

/// Draws one side of a gap, from its face away from the gap: a beam with its plies, or a mass.
fn side(svg: &mut Svg, (face, sign): (f64, f64), plies: &[(f64, &'static str)], scale: f64) {
    let sizes = plies
        .iter()
        .map(|(thickness_m, style)| ((thickness_m * scale).max(2.0), *style));
    let sizes: Vec<(f64, &str)> = if plies.is_empty() {
        vec![(MASS, BODY)]
    } else {
        sizes.collect()
    };
    let mut near = face;
    for (height, style) in sizes {
        svg.rect(
            -2.0,
            if sign < 0.0 { near - height } else { near },
            SIZE.0 + 4.0,
            height,
            style,
        );
        near += sign * height;
    }
}

/// Returns the magnification relative to the side view, to two digits.
fn times(ratio: f64) -> String {
    let rounded: f64 = format!("{ratio:.1e}").parse().unwrap_or(ratio);
    format!("drawn {rounded} times larger than above")
}
