//! Bodies of a spec, and the body of a reference.

use super::{circuits, plans, words};
use crate::{DrawnBeam, DrawnBody, DrawnContact, DrawnPatch, DrawnPlace, DrawnShape, Seat};
use jounce_spec::{Beam, Face, Mass, Spec};

/// Index of every body in the drawing: masses, then beams, then structures given by their modes,
/// then plates.
pub struct Index<'s> {
    masses: Vec<&'s str>,
    beams: Vec<&'s str>,
    modal: Vec<&'s str>,
    plates: Vec<&'s str>,
}

impl<'s> Index<'s> {
    /// Collects the bodies of a spec.
    pub fn of(spec: &'s Spec) -> Self {
        Self {
            masses: spec.mass.keys().map(String::as_str).collect(),
            beams: spec.beam.keys().map(String::as_str).collect(),
            modal: spec.modal.keys().map(String::as_str).collect(),
            plates: spec.plate.keys().map(String::as_str).collect(),
        }
    }

    /// Returns the bodies mounted on a base, directly or through other bodies.
    pub fn on_base(&self, spec: &Spec, base: &str) -> Vec<usize> {
        // Any point of a beam, of a structure given by its modes or of a plate represents the entire
        // body.
        let long: Vec<String> = self
            .beams
            .iter()
            .chain(&self.modal)
            .chain(&self.plates)
            .map(|name| format!("{name}.root"))
            .collect();
        let points = self
            .masses
            .iter()
            .copied()
            .chain(long.iter().map(String::as_str));
        points
            .enumerate()
            .filter(|(_, point)| spec.base_under(point) == base)
            .map(|(body, _)| body)
            .collect()
    }

    /// Returns the contacts whose stop is mounted directly on a base, not on a body.
    pub fn stops_on(spec: &Spec, contacts: &[(&str, DrawnContact)], base: &str) -> Vec<usize> {
        let frame = |name: &str| spec.stop.get(name).map(|stop| stop.frame.as_str());
        let stop_names = contacts
            .iter()
            .enumerate()
            .filter(|(_, (name, _))| frame(name) == Some(base));
        stop_names.map(|(index, _)| index).collect()
    }

    /// Returns the position of a reference: a mass, or a point of a beam, of a structure given by its
    /// modes or of a plate; `None` for the ground.
    pub fn position_of(&self, spec: &Spec, reference: &str) -> Option<DrawnPlace> {
        let find = |names: &[&str], name: &str| names.iter().position(|known| *known == name);
        let Some((body, point)) = reference.split_once('.') else {
            return Some(DrawnPlace {
                body: find(&self.masses, reference)?,
                along_m: 0.0,
            });
        };
        if let Some(index) = find(&self.beams, body) {
            return Some(DrawnPlace {
                body: self.masses.len() + index,
                along_m: along(&spec.beam[body], point)?,
            });
        }
        let without_shape: Vec<&str> = self.modal.iter().chain(&self.plates).copied().collect();
        let index = find(&without_shape, body)?;
        Some(DrawnPlace {
            body: self.masses.len() + self.beams.len() + index,
            along_m: 0.0,
        })
    }
}

/// Returns the distance of a point of a beam from its root, m.
fn along(beam: &Beam, point: &str) -> Option<f64> {
    match point {
        "root" => Some(0.0),
        "end" => Some(beam.length_m),
        _ => beam.point.get(point).copied(),
    }
}

/// Returns all bodies, in the order of their index.
pub fn bodies(spec: &Spec, index: &Index) -> Vec<DrawnBody> {
    let masses = spec
        .mass
        .iter()
        .map(|(name, mass)| draw_mass(spec, index, name, mass));
    let beams = spec.beam.iter().map(|(name, beam)| DrawnBody {
        words: words::on_base(spec, words::beam(name, beam), &beam.root),
        shape: DrawnShape::Beam(draw_beam(spec, name, beam)),
        seat: index
            .position_of(spec, &beam.root)
            .map_or(Seat::Ground, Seat::On),
    });
    let modal = spec.modal.iter().map(|(name, modal)| DrawnBody {
        words: words::modal(name, modal),
        shape: DrawnShape::Given,
        seat: Seat::Nothing,
    });
    let plates = spec.plate.iter().map(|(name, plate)| {
        let words = vec![
            plans::label(name, plate),
            "plate: see its plan view".to_owned(),
        ];
        DrawnBody {
            words: words::on_base(spec, words, &plate.on),
            shape: DrawnShape::Given,
            seat: Seat::Nothing,
        }
    });
    masses.chain(beams).chain(modal).chain(plates).collect()
}

fn draw_mass(spec: &Spec, index: &Index, name: &str, mass: &Mass) -> DrawnBody {
    let on = index.position_of(spec, &mass.on);
    let seat = match (mass.stiffness_n_m, on) {
        (Some(_), on) => Seat::Spring(on),
        (None, Some(on)) => Seat::On(on),
        (None, None) => Seat::Nothing,
    };
    let shape = if seat == Seat::Nothing {
        DrawnShape::Ball
    } else {
        DrawnShape::Block
    };
    DrawnBody {
        words: words::on_base(spec, words::mass(name, mass), &mass.on),
        shape,
        seat,
    }
}

fn cover(
    label: &str,
    start_m: f64,
    [length_m, width_m, thickness_m]: [f64; 3],
    face: Face,
) -> DrawnPatch {
    DrawnPatch {
        label: label.to_owned(),
        start_m,
        length_m,
        width_m,
        thickness_m,
        top: face == Face::Top,
    }
}

fn draw_beam(spec: &Spec, name: &str, beam: &Beam) -> DrawnBeam {
    let layers = spec.layer.iter().filter(|(_, layer)| layer.on == name);
    let patches = spec.patch.iter().filter(|(_, patch)| patch.on == name);
    let starts = patches
        .clone()
        .filter(|(_, patch)| patch.start_m > 0.0)
        .map(|(label, patch)| (label.clone(), patch.start_m));
    DrawnBeam {
        length_m: beam.length_m,
        width_m: beam.width_m,
        thickness_m: beam.thickness_m,
        layers: layers
            .map(|(label, l)| {
                let size_m = [l.length_m, l.width_m, l.thickness_m];
                cover(label, l.start_m, size_m, l.face)
            })
            .collect(),
        patches: patches
            .map(|(label, p)| {
                let size_m = [p.length_m, p.width_m, p.total_thickness_m()];
                cover(&circuits::marked(spec, label), p.start_m, size_m, p.face)
            })
            .collect(),
        points: beam
            .point
            .iter()
            .map(|(point, along_m)| (point.clone(), *along_m))
            .chain(starts)
            .collect(),
    }
}
