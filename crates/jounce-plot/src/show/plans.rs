//! Plan views of the plates of a spec.

use super::circuits;
use crate::{DrawnEdge, DrawnPlan, DrawnPoint, DrawnRectangle};
use jounce_spec::{Edge, Face, Plate, PlateArea, Spec};

/// Returns the plan views of all plates.
pub fn plans(spec: &Spec) -> Vec<DrawnPlan> {
    spec.plate
        .iter()
        .map(|(name, plate)| plan(spec, name, plate))
        .collect()
}

/// Returns the label of a plate: name and material.
pub fn label(name: &str, plate: &Plate) -> String {
    if plate.material.is_empty() {
        name.to_owned()
    } else {
        format!("{name}, {}", plate.material)
    }
}

fn plan(spec: &Spec, name: &str, plate: &Plate) -> DrawnPlan {
    let layers = spec.layer.iter().filter(|(_, layer)| layer.on == name);
    let patches = spec.patch.iter().filter(|(_, patch)| patch.on == name);
    let point = |(point, place): (&String, &jounce_spec::PlatePoint)| DrawnPoint {
        label: at_point(spec, &format!("{name}.{point}"), point),
        x_m: place.x_m,
        y_m: place.y_m,
    };
    DrawnPlan {
        label: label(name, plate),
        length_m: plate.length_m,
        width_m: plate.width_m,
        thickness_m: plate.thickness_m,
        edges: plate.edges().map(|edge| match edge {
            Edge::Clamped => DrawnEdge::Clamped,
            Edge::SimplySupported => DrawnEdge::SimplySupported,
            Edge::Free => DrawnEdge::Free,
        }),
        layers: layers
            .map(|(label, l)| {
                let area = plate.area(l.start_m, l.length_m, l.width_m, &l.on_plate);
                rectangle(label.clone(), area, l.face)
            })
            .collect(),
        patches: patches
            .map(|(label, p)| {
                let area = plate.area(p.start_m, p.length_m, p.width_m, &p.on_plate);
                rectangle(circuits::marked(spec, label), area, p.face)
            })
            .collect(),
        points: plate.point.iter().map(point).collect(),
    }
}

fn rectangle(label: String, area: PlateArea, face: Face) -> DrawnRectangle {
    DrawnRectangle {
        label,
        x_m: area.x_m,
        y_m: area.y_m,
        top: face == Face::Top,
    }
}

/// Returns the name of a point with the masses, stops and forces there.
fn at_point(spec: &Spec, reference: &str, point: &str) -> String {
    let masses = spec.mass.iter().filter(|(_, mass)| mass.on == reference);
    let stops = spec
        .stop
        .iter()
        .filter(|(_, stop)| stop.at == reference || stop.frame == reference);
    let forces = spec
        .drive
        .iter()
        .filter(|(_, drive)| drive.base().is_none() && drive.at == reference);
    let things = masses
        .map(|(name, _)| format!("mass {name}"))
        .chain(stops.map(|(name, _)| format!("stop {name}")))
        .chain(forces.map(|(name, _)| format!("force {name}")));
    let listed: Vec<String> = things.collect();
    if listed.is_empty() {
        point.to_owned()
    } else {
        format!("{point}: {}", listed.join(", "))
    }
}
