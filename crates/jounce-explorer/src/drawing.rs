//! Drawing of a design, and the keys that move when its parts are dragged.

use crate::design::Design;
use jounce_core::picture::{Drawing, DrawnShape, GripPart, Rect};
use jounce_core::show;
use serde_json::{Value, json};

/// Returns the drawing as SVG, the extents of its side view, circuits and close-ups (left, upper
/// edge, width, height, px), and its grips. A grip has a position, the keys that it moves, and
/// their scale (px per metre of the first key).
pub fn drawing(title: &str, design: &Design) -> Value {
    let drawing = show::drawing(title, &design.spec);
    let sheet = drawing.sheet();
    let grips = sheet.grips.iter().filter_map(|grip| {
        let mut entry = keys(&drawing, design, grip.part)?;
        entry["at"] = json!(grip.at);
        entry["px_per_m"] = json!(grip.px_per_m);
        Some(entry)
    });
    json!({
        "svg": sheet.svg, "side": extent(&sheet.side), "cells": sheet.circuits.iter().chain(&sheet.looks).map(extent).collect::<Vec<_>>(),
        "grips": grips.collect::<Vec<_>>(),
    })
}

fn extent(rect: &Rect) -> [f64; 4] {
    [rect.left, rect.top, rect.width(), rect.height()]
}

/// Returns the keys that a grip moves; `None` where no number of the spec defines the position,
/// such as a stop at the end of a beam.
fn keys(drawing: &Drawing, design: &Design, part: GripPart) -> Option<Value> {
    let patch = |body: usize, patch: usize| match &drawing.bodies[body].shape {
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
            let name = &drawing.contacts[contact].label;
            let (beam, point) = design.spec.stop.get(name)?.at.split_once('.')?;
            let key = format!("beam.{beam}.point.{point}");
            design.key(&key).ok()?;
            json!({ "kind": "place", "name": name, "key": key })
        }
        GripPart::Gap { contact } => {
            let name = &drawing.contacts[contact].label;
            json!({ "kind": "gap", "name": name, "key": format!("stop.{name}.gap") })
        }
    })
}
