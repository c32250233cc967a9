//! The drawing of a design, and which of its parts can be dragged.

use crate::design::Design;
use jounce::show;
use serde_json::{Value, json};

/// The drawing as SVG, with the keys behind its patches and stops in the order in which they are drawn.
pub fn drawing(title: &str, design: &Design) -> Value {
    let spec = &design.spec;
    let drawn = show::drawing(title, spec);
    let (mut beams, mut patches, mut stops) = (Vec::new(), Vec::new(), Vec::new());
    for body in &drawn.bodies {
        if let Some(beam) = &body.beam {
            beams.push(json!({ "name": beam.label, "length": beam.length_m }));
            patches.extend(beam.patches.iter().map(|patch| {
                let name = &patch.label;
                json!({ "name": name, "beam": beams.len() - 1, "start": format!("patch.{name}.start"), "length": format!("patch.{name}.length") })
            }));
        }
        for stop in &body.stops {
            let name = stop.label.strip_prefix("stop ").unwrap_or(&stop.label);
            let at = spec.stop.get(name).map(|stop| stop.at.clone()).unwrap_or_default();
            let place = at.split_once('.').map(|(beam, point)| format!("beam.{beam}.point.{point}"));
            let place = place.filter(|path| design.key(path).is_ok());
            let beam = if stop.place_m.is_some() { beams.len().checked_sub(1) } else { None };
            stops.push(json!({
                "name": name, "beam": beam, "gap": format!("stop.{name}.gap"), "gap_m": stop.gap_m, "place": place, "above": stop.above,
            }));
        }
    }
    json!({ "svg": drawn.to_svg(), "beams": beams, "patches": patches, "stops": stops })
}
