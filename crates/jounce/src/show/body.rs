//! Which body a thing belongs to, and where on it.

use super::words;
use crate::picture::{Carrier, DrawnBeam, DrawnBody, DrawnPatch, DrawnStop};
use crate::spec::{Beam, Quantity, Side, Spec, Stop};

/// What a reference to a point names.
struct Place<'s> {
    body: &'s str,
    /// Name of the point, or nothing for the body itself.
    point: Option<&'s str>,
}

impl<'s> Place<'s> {
    fn of(text: &'s str) -> Self {
        match text.split_once('.') {
            Some((body, point)) => Self { body, point: Some(point) },
            None => Self { body: text, point: None },
        }
    }

    /// Distance from the root of the beam `name`, m, where the place lies on it.
    fn along(&self, name: &str, beam: &Beam) -> Option<f64> {
        let point = self.point.filter(|_| self.body == name)?;
        match point {
            "root" => Some(0.0),
            "end" => Some(beam.length_m),
            _ => beam.point.get(point).copied(),
        }
    }
}

/// All bodies: masses with their beams, beams on the ground, structures given by their modes.
pub fn bodies(spec: &Spec) -> Vec<DrawnBody> {
    let mut bodies: Vec<DrawnBody> = Vec::new();
    for (name, mass) in &spec.mass {
        let carrier = || Carrier::Mass { label: name.clone(), words: words::mass(mass), sprung: mass.stiffness_n_m.is_some() };
        let beams: Vec<_> = spec.beam.iter().filter(|(_, beam)| beam.root == *name).collect();
        if beams.is_empty() {
            bodies.push(body(spec, Some(name), carrier(), None));
        }
        // The mass is drawn again with each of its beams; what acts on the mass itself only with the first.
        bodies.extend(beams.into_iter().enumerate().map(|(k, beam)| body(spec, Some(name).filter(|_| k == 0), carrier(), Some(beam))));
    }
    let clamped = spec.beam.iter().filter(|(_, beam)| !spec.mass.contains_key(&beam.root));
    // A beam on another is drawn on a block with the name of the point that carries it.
    let carrier = |beam: &Beam| match beam.root.contains('.') {
        true => Carrier::Mass { label: beam.root.clone(), words: Vec::new(), sprung: false },
        false => Carrier::Ground,
    };
    bodies.extend(clamped.map(|beam| body(spec, None, carrier(beam.1), Some(beam))));
    for (name, modal) in &spec.modal {
        let words = vec![format!("{} modes", modal.frequency_hz.len())];
        bodies.push(body(spec, Some(name), Carrier::Given { label: name.clone(), words }, None));
    }
    bodies
}

fn body(spec: &Spec, carrier_name: Option<&String>, carrier: Carrier, beam: Option<(&String, &Beam)>) -> DrawnBody {
    let on_carrier = |place: &Place| carrier_name.is_some_and(|name| name == place.body);
    let along = |place: &Place| beam.and_then(|(name, beam)| place.along(name, beam));
    let here = |at: &str| {
        let place = Place::of(at);
        along(&place).map(Some).or_else(|| on_carrier(&place).then_some(None))
    };
    let rides_on = beam.map(|(_, beam)| beam.root.as_str()).or(carrier_name.map(String::as_str));
    DrawnBody {
        carrier,
        beam: beam.map(|(name, beam)| drawn_beam(spec, name, beam)),
        stops: (spec.stop.iter())
            .filter_map(|(name, stop)| Some(drawn_stop(name, stop, here(&stop.at)?, rides_on == Some(stop.frame.as_str()))))
            .collect(),
        drives: spec.drive.iter().filter_map(|(name, drive)| Some((words::drive(name, drive), here(&drive.at)?))).collect(),
    }
}

fn drawn_stop(name: &str, stop: &Stop, place_m: Option<f64>, rides: bool) -> DrawnStop {
    DrawnStop {
        label: format!("stop {name}"),
        place_m,
        above: stop.side == Side::Positive,
        gap_m: stop.gap_m,
        frame: stop.frame.clone(),
        rides: rides && stop.frame != "ground",
        law: words::law(&stop.law),
    }
}

fn drawn_beam(spec: &Spec, name: &str, beam: &Beam) -> DrawnBeam {
    let patches = spec.patch.iter().filter(|(_, patch)| patch.on == name).map(|(label, patch)| DrawnPatch {
        label: label.clone(),
        start_m: patch.start_m,
        length_m: patch.length_m,
        thickness_m: patch.thickness_m,
        load: (spec.circuit.iter().find(|(_, circuit)| circuit.connections().any(|(patch, _)| patch == label)))
            .map(|(load, circuit)| format!("{load} {}", words::value(Quantity::Resistance, circuit.resistance_ohm))),
    });
    DrawnBeam {
        label: name.to_owned(),
        length_m: beam.length_m,
        thickness_m: beam.thickness_m,
        patches: patches.collect(),
        points: beam.point.iter().map(|(point, place_m)| (point.clone(), *place_m)).collect(),
    }
}
