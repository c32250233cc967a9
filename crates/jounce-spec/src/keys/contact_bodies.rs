//! `[stop.NAME]`: getters and setters of the two bodies of a contact.

use super::stop_law::set_stiffness;
use crate::material;
use crate::{BodyShape, ContactBodies, ContactBody, Spec, Stop};

pub(super) const SHAPES: &[&str] = &["sphere", "cylinder", "ellipsoid"];

pub(super) fn striking(stop: &Stop) -> Option<&ContactBody> {
    stop.bodies.as_ref().map(|bodies| &bodies.striking)
}

pub(super) fn struck(stop: &Stop) -> Option<&ContactBody> {
    stop.bodies.as_ref().map(|bodies| &bodies.stop)
}

/// Changes the bodies, and with them the stiffness of the law.
pub(super) fn set(stop: &mut Stop, change: impl FnOnce(&mut ContactBodies)) {
    let bodies = stop.bodies.get_or_insert_default();
    change(bodies);
    if let Some(stiffness) = bodies.stiffness() {
        set_stiffness(&mut stop.law, stiffness);
    }
}

/// Returns why a spec has no number at a path: the stiffness of a stop may follow from its bodies.
pub(crate) fn no_number(spec: &Spec, path: &str) -> &'static str {
    let stop = path
        .strip_prefix("stop.")
        .and_then(|path| path.strip_suffix(".stiffness"));
    if stop.is_some_and(|name| {
        spec.stop
            .get(name)
            .is_some_and(|stop| stop.bodies.is_some())
    }) {
        "this stiffness follows from the bodies; vary `radius`, `youngs_modulus` or another of their keys"
    } else {
        "this spec has no key with a number here; give a key with a number"
    }
}

/// Takes the missing values from the library.
pub(super) fn fill(body: &mut ContactBody, name: &str) {
    name.clone_into(&mut body.material);
    if let Some(known) = material::named(name) {
        (body.youngs_modulus_pa, body.poisson_ratio) =
            (Some(known.youngs_modulus_pa), known.poisson_ratio);
    }
}

/// Returns the word of a shape; empty where there is no body, or where it is flat.
pub(super) fn shape_word(body: Option<&ContactBody>) -> String {
    match body.map(|body| (body.shape, body.radius_m)) {
        None | Some((BodyShape::Sphere, None)) => "",
        Some((BodyShape::Sphere, _)) => "sphere",
        Some((BodyShape::Cylinder, _)) => "cylinder",
        Some((BodyShape::Ellipsoid, _)) => "ellipsoid",
    }
    .to_owned()
}

pub(super) fn shape_of(word: &str) -> BodyShape {
    match word {
        "cylinder" => BodyShape::Cylinder,
        "ellipsoid" => BodyShape::Ellipsoid,
        _ => BodyShape::Sphere,
    }
}
