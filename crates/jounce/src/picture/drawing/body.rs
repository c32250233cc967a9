//! The side view of a body.

use super::hatch::{Far, ground};
use super::sheet::View;
use super::{Carrier, DrawnBeam, DrawnBody, DrawnPatch, dimension, stop, symbols};
use crate::picture::svg::{Anchor, Svg, number};
use crate::picture::text::{SMALL, width};

/// Size of a box that stands for a mass, px.
const BOX: (f64, f64) = (86.0, 58.0);

const THIN: &str = "class=\"jounce-grid\" stroke=\"#8a8a8a\" stroke-width=\"0.8\" fill=\"none\"";

/// What stands at the root.
pub fn carrier(svg: &mut Svg, body: &DrawnBody, view: View) {
    let (left, top) = (view.root_x - BOX.0, view.y - 0.5 * BOX.1);
    let words = match &body.carrier {
        Carrier::Ground => {
            ground(svg, (view.root_x, view.y - 28.0), 56.0, Far::Left);
            return;
        }
        Carrier::Mass { label, words, sprung } => {
            symbols::labelled_box(svg, (left, top, BOX.0, BOX.1), label);
            if *sprung {
                symbols::spring(svg, left + 0.5 * BOX.0, top + BOX.1, 38.0);
            }
            words
        }
        Carrier::Given { label, words } => {
            symbols::labelled_box(svg, (left, top, BOX.0 + 60.0, BOX.1), label);
            words
        }
    };
    for (line, text) in words.iter().enumerate() {
        svg.text(12.0, top + BOX.1 + 18.0 + 15.0 * line as f64, SMALL, Anchor::Start, text);
    }
}

/// The beam with its patches and places.
pub fn beam(svg: &mut Svg, beam: &DrawnBeam, view: View) {
    let thick = view.thick(beam.thickness_m);
    svg.rect(view.root_x, view.y - 0.5 * thick, beam.length_m * view.px_per_m, thick, "class=\"jounce-beam\" fill=\"#4a5560\"");
    beam.patches.iter().for_each(|patch| drawn_patch(svg, patch, beam, view));
    // Names that would run into each other take turns over two lines.
    let mut free = [f64::MIN; 3];
    let mut places: Vec<&(String, f64)> = beam.points.iter().collect();
    places.sort_by(|a, b| a.1.total_cmp(&b.1));
    for (name, place_m) in places {
        let words = format!("{name} {}", dimension::length(*place_m));
        let (x, half) = (view.x(*place_m), 0.5 * width(&words, SMALL) + 4.0);
        let line = free.iter().position(|right| *right <= x - half).unwrap_or(2);
        free[line] = x + half;
        let y = view.y + 98.0 + 15.0 * line as f64;
        svg.path(&format!("M{x0} {}L{x0} {}", number(view.y + 0.5 * thick + 2.0), number(y - 12.0), x0 = number(x)), THIN);
        svg.text(x, y, SMALL, Anchor::Middle, &words);
    }
    let words = [beam.label.clone(), dimension::length(beam.length_m), format!("× {}", dimension::length(beam.thickness_m))];
    for (line, words) in words.iter().enumerate() {
        svg.text(view.x(beam.length_m) + 8.0, view.y + 4.0 + 15.0 * line as f64, SMALL, Anchor::Start, words);
    }
}

fn drawn_patch(svg: &mut Svg, patch: &DrawnPatch, beam: &DrawnBeam, view: View) {
    let (half, thick) = (0.5 * view.thick(beam.thickness_m), view.thick(patch.thickness_m));
    let (from, to) = (view.x(patch.start_m), view.x(patch.start_m + patch.length_m));
    svg.rect(from, view.y - half - thick, to - from, thick, "class=\"jounce-patch\" fill=\"#e69f00\"");
    svg.text(0.5 * (from + to), view.y - half - thick - 8.0, SMALL, Anchor::Middle, &patch.label);
    if let Some(words) = &patch.load {
        symbols::load(svg, (from + 4.0, to - 4.0), view.y + half, words);
    }
}

/// The stops that its points strike.
pub fn stops(svg: &mut Svg, body: &DrawnBody, view: View) {
    for drawn in &body.stops {
        let (x, face_m) = match (drawn.place_m, &body.beam) {
            (Some(place_m), Some(beam)) => (view.x(place_m), 0.5 * beam.thickness_m),
            // Beside the words of the drive, which stand above the box.
            _ => (view.root_x + if matches!(body.carrier, Carrier::Given { .. }) { 30.0 } else { -0.2 * BOX.0 }, 0.0),
        };
        let way = if drawn.above { -0.5 } else { 0.5 };
        let own = if drawn.place_m.is_none() { View { y: view.y + way * BOX.1, ..view } } else { view };
        stop::drawn(svg, drawn, x, face_m, own, (view.root_x - 0.3 * BOX.0, view.y + way * BOX.1));
    }
}

/// The drives.
pub fn drives(svg: &mut Svg, body: &DrawnBody, view: View) {
    for (index, (words, place_m)) in body.drives.iter().enumerate() {
        let x = place_m.map_or(view.root_x - BOX.0 - 18.0, |place_m| view.x(place_m));
        let y = if place_m.is_some() { view.y - 40.0 } else { view.y };
        dimension::arrow(svg, x, (y + 24.0, y - 24.0), true);
        let at = (x.min(view.root_x - BOX.0) - 8.0).max(12.0);
        match place_m {
            Some(_) => svg.text(x + 8.0, y - 16.0, SMALL, Anchor::Start, words),
            None => svg.text(at.max(12.0) - at + 12.0, view.y - 44.0 - 15.0 * index as f64, SMALL, Anchor::Start, words),
        }
    }
}
