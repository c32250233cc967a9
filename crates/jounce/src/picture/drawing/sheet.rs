//! The sheet: side views one below the other, then the closer looks.

use super::{Drawing, DrawnBody, body, close_up, dimension};
use crate::picture::svg::{Anchor, Svg};
use crate::picture::text::{SMALL, TITLE};

/// Width of the sheet, px.
const WIDTH: f64 = 900.0;

/// Room for carriers at the left, px.
const LEFT: f64 = 190.0;

/// Room for labels at the right, px.
const RIGHT: f64 = 110.0;

/// Height of a side view, px.
const BODY: f64 = 225.0;

/// Width of a closer look, px.
const LOOK: f64 = 285.0;

/// Height of a closer look, px.
const LOOK_HIGH: f64 = 230.0;

/// Where lengths of a side view stand on the sheet.
#[derive(Debug, Clone, Copy)]
pub struct View {
    /// Pixels per metre.
    pub px_per_m: f64,
    /// Abscissa of the roots.
    pub root_x: f64,
    /// Height of the mid-plane.
    pub y: f64,
}

impl View {
    /// Abscissa of a place along the beam.
    pub fn x(&self, place_m: f64) -> f64 {
        self.root_x + place_m * self.px_per_m
    }

    /// A length in pixels, at least one.
    pub fn thick(&self, length_m: f64) -> f64 {
        (length_m * self.px_per_m).max(1.0)
    }
}

/// The drawing as SVG.
pub fn drawn(drawing: &Drawing) -> String {
    let longest_m = drawing.bodies.iter().filter_map(|body| body.beam.as_ref()).map(|beam| beam.length_m).fold(0.0, f64::max);
    let px_per_m = if longest_m > 0.0 { (WIDTH - LEFT - RIGHT) / longest_m } else { 0.0 };
    let looks: Vec<_> = drawing.bodies.iter().flat_map(|body| body.stops.iter().map(move |stop| (body.beam.as_ref(), stop))).collect();
    let per_line = (WIDTH / LOOK) as usize;
    let looks_from = 40.0 + BODY * drawing.bodies.len() as f64 + if longest_m > 0.0 { 40.0 } else { 0.0 };
    let height = looks_from + LOOK_HIGH * looks.len().div_ceil(per_line) as f64 + 10.0;
    let mut svg = Svg::new(WIDTH, height, &drawing.title);
    svg.text(12.0, 12.0 + TITLE, TITLE, Anchor::Start, &drawing.title);
    for (index, body) in drawing.bodies.iter().enumerate() {
        let view = View { px_per_m, root_x: LEFT, y: 130.0 + BODY * index as f64 };
        side_view(&mut svg, body, view);
    }
    if longest_m > 0.0 {
        let bar_m = dimension::round_below(0.25 * longest_m);
        let bar_px = bar_m * px_per_m;
        let y = looks_from - 18.0;
        dimension::bar(&mut svg, LEFT, y, bar_px);
        let words = format!("{}, the same in both directions", dimension::length(bar_m));
        svg.text(LEFT + bar_px + 10.0, y + 4.0, SMALL, Anchor::Start, &words);
    }
    for (index, (beam, stop)) in looks.into_iter().enumerate() {
        let (x, y) = ((index % per_line) as f64 * LOOK + 20.0, looks_from + (index / per_line) as f64 * LOOK_HIGH);
        close_up::close_up(&mut svg, (x, y, LOOK - 25.0, LOOK_HIGH - 20.0), beam, stop, px_per_m);
    }
    svg.finish()
}

fn side_view(svg: &mut Svg, body: &DrawnBody, view: View) {
    body::carrier(svg, body, view);
    if let Some(beam) = &body.beam {
        body::beam(svg, beam, view);
    }
    body::stops(svg, body, view);
    body::drives(svg, body, view);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Carrier, DrawnBeam, DrawnStop};

    /// Width and height of the first rectangle of a class.
    fn rectangle(svg: &str, class: &str) -> Option<(f64, f64)> {
        let element = svg.split(&format!("class=\"{class}\"")).next()?.rsplit("<rect").next()?;
        let read = |name: &str| element.split(&format!(" {name}=\"")).nth(1)?.split('"').next()?.parse().ok();
        Some((read("width")?, read("height")?))
    }

    #[test]
    fn length_and_thickness_have_one_scale() {
        let beam = DrawnBeam { label: "beam".into(), length_m: 0.3, thickness_m: 6e-3, patches: Vec::new(), points: Vec::new() };
        let stop = DrawnStop {
            label: "stop".into(),
            place_m: Some(0.3),
            above: true,
            gap_m: 2e-3,
            frame: "ground".into(),
            rides: false,
            law: "spring".into(),
        };
        let body = DrawnBody { carrier: Carrier::Ground, beam: Some(beam), stops: vec![stop], drives: Vec::new() };
        let svg = drawn(&Drawing { title: "two".into(), bodies: vec![body] });
        let (length, thickness) = rectangle(&svg, "jounce-beam").unwrap_or_default();
        assert!((thickness / length - 6e-3 / 0.3).abs() < 1e-4, "{length} {thickness}");
        assert!(svg.contains("gap 2 mm") && svg.contains("drawn 4 times larger than above"), "{svg}");
    }
}
