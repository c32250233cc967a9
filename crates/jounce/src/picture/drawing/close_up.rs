//! A closer look at a stop: the gap and what it lies between, at a scale that shows both.

use super::canvas::THIN;
use super::hatch::{Far, ground};
use super::{Drawing, DrawnContact, DrawnPlace, DrawnShape, contacts, dimension, symbols};
use crate::picture::svg::{Anchor, Svg, number};
use crate::picture::text::SMALL;

/// Size of a closer look, px.
pub const SIZE: (f64, f64) = (260.0, 190.0);

/// Height that gap and what strikes fill together, px.
const FILLED: f64 = 60.0;

/// Whether a stop needs a closer look: its gap is hardly seen at the scale of the side view, but is there.
pub fn needed(contact: &DrawnContact, px_per_m: f64) -> bool {
    px_per_m > 0.0 && contact.gap_m != 0.0 && contact.gap_m * px_per_m < contacts::SEEN
}

/// The sizes of a closer look.
pub struct Closeness {
    /// Pixels per metre.
    scale: f64,
    /// -1 where what is struck stands above.
    way: f64,
    /// Height of the face that strikes, px under the upper edge of the window.
    face: f64,
    /// Height of the face that is struck.
    struck: f64,
}

/// Upper edge of the window under that of the whole, and its height, px.
const WINDOW: (f64, f64) = (26.0, SIZE.1 - 54.0);

impl Closeness {
    /// How close a contact is looked at.
    pub fn of(drawing: &Drawing, contact: &DrawnContact) -> Self {
        let own = thickness(drawing, contact.at).unwrap_or(0.0);
        let scale = FILLED / (contact.gap_m.abs() + own);
        let way = if contact.above { -1.0 } else { 1.0 };
        let face = 0.5 * WINDOW.1 - way * (0.5 * FILLED - own * scale);
        Self { scale, way, face, struck: face + way * contact.gap_m * scale }
    }

    /// Where the struck face is in a look with its upper left corner at `(x, y)`, and how it moves with the gap, px/m.
    pub fn grip(&self, (x, y): (f64, f64)) -> ((f64, f64), f64) {
        ((x + 0.5 * SIZE.0, y + WINDOW.0 + self.struck), self.way * self.scale)
    }
}

fn thickness(drawing: &Drawing, place: DrawnPlace) -> Option<f64> {
    if let DrawnShape::Beam(beam) = &drawing.bodies[place.body].shape { Some(beam.thickness_m) } else { None }
}

/// Draws it with its upper left corner at `(x, y)`; `px_per_m` is the scale of the side view.
pub fn draw(svg: &mut Svg, drawing: &Drawing, contact: &DrawnContact, (x, y): (f64, f64), px_per_m: f64) {
    svg.rect(x, y, SIZE.0, SIZE.1, THIN);
    let Closeness { scale, way, face, struck } = Closeness::of(drawing, contact);
    svg.text(x + 8.0, y + 18.0, SMALL, Anchor::Start, &format!("stop {}, {}", contact.label, contacts::gap(contact.gap_m)));
    svg.open_window(x, y + WINDOW.0, SIZE.0, WINDOW.1);
    let middle = 0.5 * SIZE.0;
    side(svg, (face, -way), thickness(drawing, contact.at).map(|t| t * scale));
    match contact.on {
        None => {
            svg.path(
                &symbols::tip(middle, struck, way, 14.0),
                "class=\"jounce-stop\" fill=\"#8a8a8a\" fill-opacity=\"0.8\" stroke=\"none\"",
            );
            ground(svg, (middle - 50.0, struck + way * 28.0), 100.0, if contact.above { Far::Above } else { Far::Below });
        }
        Some(on) => side(svg, (struck, way), thickness(drawing, on).map(|t| t * scale)),
    }
    let at = middle + 42.0;
    dimension::arrow(svg, at, (face, struck), true);
    let level = format!("M{} {y}L{} {y}", number(middle + 10.0), number(at + 8.0), y = number(struck));
    svg.path(&level, THIN);
    svg.close_window();
    svg.text(x + 8.0, y + SIZE.1 - 10.0, SMALL, Anchor::Start, &times(scale / px_per_m));
}

/// One side of a gap: a beam of a thickness, or a mass.
fn side(svg: &mut Svg, (face, way): (f64, f64), thick: Option<f64>) {
    let (height, look) = match thick {
        Some(thick) => (thick.max(2.0), "class=\"jounce-beam\" fill=\"#4a5560\" fill-opacity=\"0.9\""),
        None => (34.0, "class=\"jounce-body\" fill=\"#dfe3e8\" fill-opacity=\"0.9\" stroke=\"#1a1a1a\" stroke-width=\"1.2\""),
    };
    svg.rect(-2.0, if way < 0.0 { face - height } else { face }, SIZE.0 + 4.0, height, look);
}

/// How much larger than the side view, to two digits.
fn times(ratio: f64) -> String {
    let rounded: f64 = format!("{ratio:.1e}").parse().unwrap_or(ratio);
    format!("drawn {rounded} times larger than above")
}
