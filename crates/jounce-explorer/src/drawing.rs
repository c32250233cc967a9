//! Drawing of a design, and the keys that move when its parts are dragged.

use crate::design::Design;
use jounce::picture::{Drawing, DrawnShape, GripPart, Rect};
use jounce::show;
use serde_json::{Value, json};

/// Returns the drawing as SVG, the extents of its side view, circuits and close-ups (left, upper
/// edge, width, height, px), and its grips. A grip has a position, the keys that it moves, and
/// their scale (px per metre of the first key).
pub fn drawing(title: &str, design: &Design) -> Value {
    let drawn = show::drawing(title, &design.spec);
    let sheet = drawn.sheet();
    let grips = sheet.grips.iter().filter_map(|grip| {
        let mut told = keys(&drawn, design, grip.part)?;
        told["at"] = json!(grip.at);
        told["px_per_m"] = json!(grip.px_per_m);
        Some(told)
    });
    json!({
        "svg": sheet.svg, "side": window(&sheet.side), "cells": sheet.circuits.iter().chain(&sheet.looks).map(window).collect::<Vec<_>>(),
        "grips": grips.collect::<Vec<_>>(),
    })
}

fn window(rect: &Rect) -> [f64; 4] {
    [rect.left, rect.top, rect.width(), rect.height()]
}

/// Returns the keys that a grip moves; `None` where no number of the spec defines the position,
/// such as a stop at the end of a beam.
fn keys(drawn: &Drawing, design: &Design, part: GripPart) -> Option<Value> {
    let patch = |body: usize, patch: usize| match &drawn.bodies[body].shape {
        DrawnShape::Beam(beam) => Some(&beam.patches[patch].label),
        _ => None,
    };
    Some(match part {
        GripPart::PatchStart { body, patch: index } => {
            let name = patch(body, index)?;
            json!({ "kind": "start", "name": name, "key": format!("patch.{name}.start"), "length": format!("patch.{name}.length") })
        }
        GripPart::PatchEnd { body, patch: index } => {
            let name = patch(body, index)?;
            json!({ "kind": "end", "name": name, "key": format!("patch.{name}.length") })
        }
        GripPart::Place { contact } => {
            let name = &drawn.contacts[contact].label;
            let (beam, point) = design.spec.stop.get(name)?.at.split_once('.')?;
            let key = format!("beam.{beam}.point.{point}");
            design.key(&key).ok()?;
            json!({ "kind": "place", "name": name, "key": key })
        }
        GripPart::Gap { contact } => {
            let name = &drawn.contacts[contact].label;
            json!({ "kind": "gap", "name": name, "key": format!("stop.{name}.gap") })
        }
    })
}
