//! What hangs together: a mass with the beams it carries, or a beam clamped to the ground.

use super::error::StructureError;
use crate::spec::{Mass, Spec};

/// The name of a beam's root that stands for the ground.
const GROUND: &str = "ground";

/// A connected structure; its modes are independent of those of every other.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body<'a> {
    /// The mass that carries the beams; none where a beam is clamped to the ground.
    pub mass: Option<(&'a str, &'a Mass)>,
    /// Names of the beams, ascending.
    pub beams: Vec<&'a str>,
}

impl<'a> Body<'a> {
    /// The mass, or the only beam.
    pub fn name(&self) -> &'a str {
        self.mass.map_or_else(|| self.beams.first().copied().unwrap_or_default(), |(name, _)| name)
    }
}

/// The connected structures of a spec with the masses `held` fixed.
///
/// # Errors
/// `UnknownRoot`, `UnknownBeam`, `CannotHold`, `CannotHoldGiven`, `OutOfRange`.
pub(super) fn bodies<'a>(spec: &'a Spec, held: &[String]) -> Result<Vec<Body<'a>>, StructureError> {
    check_references(spec)?;
    held.iter().try_for_each(|name| check_held(spec, name))?;
    let mut bodies = Vec::new();
    for (name, mass) in spec.mass.iter().filter(|(name, _)| !held.contains(name)) {
        StructureError::positive(format!("mass.{name}.mass"), mass.mass_kg)?;
        StructureError::not_negative(format!("mass.{name}.stiffness"), mass.stiffness_n_m)?;
        let beams = spec.beam.iter().filter(|(_, beam)| beam.root == *name).map(|(key, _)| key.as_str()).collect();
        bodies.push(Body { mass: Some((name, mass)), beams });
    }
    let clamped = spec.beam.iter().filter(|(_, beam)| beam.root == GROUND || held.contains(&beam.root));
    bodies.extend(clamped.map(|(name, _)| Body { mass: None, beams: vec![name.as_str()] }));
    Ok(bodies)
}

fn check_references(spec: &Spec) -> Result<(), StructureError> {
    if let Some((name, beam)) = spec.beam.iter().find(|(_, beam)| beam.root != GROUND && !spec.mass.contains_key(&beam.root)) {
        return Err(StructureError::UnknownRoot { beam: name.clone(), root: beam.root.clone(), masses: listed(spec.mass.keys()) });
    }
    match spec.patch.iter().find(|(_, patch)| !spec.beam.contains_key(&patch.on)) {
        None => Ok(()),
        Some((name, patch)) => {
            Err(StructureError::UnknownBeam { patch: name.clone(), beam: patch.on.clone(), beams: listed(spec.beam.keys()) })
        }
    }
}

fn check_held(spec: &Spec, name: &str) -> Result<(), StructureError> {
    let given = name.split('.').next().is_some_and(|first| spec.modal.contains_key(first));
    match (spec.mass.contains_key(name), given) {
        (true, _) => Ok(()),
        (false, true) => Err(StructureError::CannotHoldGiven { name: name.into() }),
        (false, false) => Err(StructureError::CannotHold { name: name.into(), masses: listed(spec.mass.keys()) }),
    }
}

fn listed<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let names: Vec<_> = names.map(String::as_str).collect();
    if names.is_empty() { "there is none".into() } else { names.join(", ") }
}
