//! Connected structures: a tree of beams and masses on the ground or another base, on a sprung
//! mass, or free.
//!
//! Every part has one support, so a body is statically determinate. Its strains and the
//! displacements of its free masses are coordinates without constraints between them.

use crate::structure::error::StructureError;
use jounce_spec::{Beam, GROUND, Mass, NO_SUPPORT, Spec};
use std::collections::BTreeSet;

/// A connected structure; its modes are independent of those of every other structure.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::structure) struct Body<'a> {
    /// Beams and masses, each after its support.
    pub parts: Vec<Part<'a>>,
}

/// A beam or a mass and its support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::structure) struct Part<'a> {
    pub name: &'a str,
    pub kind: PartKind<'a>,
    pub on: Support,
}

/// Kind of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::structure) enum PartKind<'a> {
    Beam(&'a Beam),
    Mass(&'a Mass),
}

/// Support of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::structure) enum Support {
    /// The ground or another base, or a held mass.
    Ground,
    /// No support: a free mass.
    Nothing,
    /// A mass, by its index among the parts.
    Mass(usize),
    /// A point of a beam, by its index among the parts, at this distance from its root, m.
    Point(usize, f64),
}

impl<'a> Body<'a> {
    /// Returns the name of the part that carries the others.
    pub fn name(&self) -> &'a str {
        self.parts.first().map_or("", |part| part.name)
    }

    /// Returns the support of the body: a base, a held mass, or no support.
    pub fn support(&self) -> &'a str {
        match self.parts.first().map(|part| part.kind) {
            Some(PartKind::Beam(beam)) => &beam.root,
            Some(PartKind::Mass(mass)) => &mass.on,
            None => NO_SUPPORT,
        }
    }

    /// Returns the beams with their indices among the parts, in the order of their names.
    pub fn beams(&self) -> Vec<(usize, &'a str, &'a Beam)> {
        let mut beams: Vec<_> = (self.parts.iter().enumerate())
            .filter_map(|(part, it)| {
                if let PartKind::Beam(beam) = it.kind {
                    Some((part, it.name, beam))
                } else {
                    None
                }
            })
            .collect();
        beams.sort_by_key(|(_, name, _)| *name);
        beams
    }

    /// Returns the masses with their indices among the parts.
    pub fn masses(&self) -> impl Iterator<Item = (usize, &'a str, &'a Mass)> {
        self.parts.iter().enumerate().filter_map(|(part, it)| {
            if let PartKind::Mass(mass) = it.kind {
                Some((part, it.name, mass))
            } else {
                None
            }
        })
    }

    /// Adds a part, then all parts that it supports: masses first, then beams, each in the order of
    /// their names.
    fn add_part(&mut self, spec: &'a Spec, name: &'a str, kind: PartKind<'a>, on: Support) {
        let index = self.parts.len();
        self.parts.push(Part { name, kind, on });
        let support = |text: &str| match (kind, text.split_once('.')) {
            (PartKind::Mass(_), None) if text == name => Some(Support::Mass(index)),
            (PartKind::Beam(beam), Some((of, point))) if of == name => {
                Some(Support::Point(index, position_m(beam, point)?))
            }
            _ => None,
        };
        let masses: Vec<_> = spec
            .mass
            .iter()
            .filter_map(|(key, mass)| Some((key, mass, support(&mass.on)?)))
            .collect();
        let beams: Vec<_> = spec
            .beam
            .iter()
            .filter_map(|(key, beam)| Some((key, beam, support(&beam.root)?)))
            .collect();
        masses
            .into_iter()
            .for_each(|(key, mass, on)| self.add_part(spec, key, PartKind::Mass(mass), on));
        beams
            .into_iter()
            .for_each(|(key, beam, on)| self.add_part(spec, key, PartKind::Beam(beam), on));
    }
}

/// Returns the connected structures of a spec with the masses `fixed_masses` fixed.
///
/// # Errors
/// `UnknownSupport`, `UnknownBeam`, `SupportCycle`, `CannotHold`, `CannotHoldGiven`, `OutOfRange`.
pub(in crate::structure) fn bodies<'a>(
    spec: &'a Spec,
    fixed_masses: &[String],
) -> Result<Vec<Body<'a>>, StructureError> {
    check_references(spec)?;
    spec.mass
        .iter()
        .try_for_each(|(name, mass)| check_mass(spec, name, mass))?;
    check_fixable(spec, fixed_masses)?;
    let mut bodies = Vec::new();
    let mut rooted = |name: &'a str, kind, on| {
        let mut body = Body { parts: Vec::new() };
        body.add_part(spec, name, kind, on);
        bodies.push(body);
    };
    for (name, mass) in spec
        .mass
        .iter()
        .filter(|(name, _)| !fixed_masses.contains(name))
    {
        match mass.on.as_str() {
            NO_SUPPORT => rooted(name.as_str(), PartKind::Mass(mass), Support::Nothing),
            on if spec.is_base(on) || fixed_masses.iter().any(|mass| mass == on) => {
                rooted(name.as_str(), PartKind::Mass(mass), Support::Ground)
            }
            _ => {}
        }
    }
    for (name, beam) in spec
        .beam
        .iter()
        .filter(|(_, beam)| spec.is_base(&beam.root) || fixed_masses.contains(&beam.root))
    {
        rooted(name.as_str(), PartKind::Beam(beam), Support::Ground);
    }
    let reached: BTreeSet<&str> = bodies
        .iter()
        .flat_map(|body| body.parts.iter().map(|part| part.name))
        .collect();
    let masses = spec
        .mass
        .iter()
        .filter(|(name, mass)| !fixed_masses.contains(name) && spec.plate_point(&mass.on).is_none())
        .map(|(name, _)| name);
    match spec
        .beam
        .keys()
        .chain(masses)
        .find(|name| !reached.contains(name.as_str()))
    {
        None => Ok(bodies),
        Some(name) => Err(StructureError::SupportCycle { name: name.clone() }),
    }
}

/// Returns the distance of a point from the root of its beam, m.
fn position_m(beam: &Beam, point: &str) -> Option<f64> {
    match point {
        "root" => Some(0.0),
        "end" => Some(beam.length_m),
        _ => beam.point.get(point).copied(),
    }
}

fn check_references(spec: &Spec) -> Result<(), StructureError> {
    check_supports(spec)?;
    check_carriers(spec)
}

/// Checks what the roots of beams and the masses stand on.
fn check_supports(spec: &Spec) -> Result<(), StructureError> {
    let stands = |support: &str, words: &[&str]| match support.split_once('.') {
        None => {
            words.contains(&support) || spec.is_base(support) || spec.mass.contains_key(support)
        }
        Some((name, point)) => spec
            .beam
            .get(name)
            .is_some_and(|beam| position_m(beam, point).is_some()),
    };
    let is_on_plate = |name: &str| spec.plate_point(name).is_some();
    let roots = spec
        .beam
        .iter()
        .map(|(name, beam)| (format!("beam.{name}.root"), &beam.root, &[GROUND][..]));
    let feet = spec.mass.iter().map(|(name, mass)| {
        (
            format!("mass.{name}.on"),
            &mass.on,
            &[GROUND, NO_SUPPORT][..],
        )
    });
    if let Some((index, found, words)) = roots.chain(feet).find(|(_, support, words)| {
        let is_fixed_mass = words.contains(&NO_SUPPORT) && is_on_plate(support);
        !stands(support, words) && !is_fixed_mass
    }) {
        let known = listed(
            words
                .iter()
                .copied()
                .chain(spec.mass.keys().map(String::as_str)),
        );
        return Err(StructureError::UnknownSupport {
            place: index,
            found: found.clone(),
            known,
        });
    }
    Ok(())
}

/// Checks what carries the patches and layers.
fn check_carriers(spec: &Spec) -> Result<(), StructureError> {
    let patches = spec
        .patch
        .iter()
        .map(|(name, patch)| (format!("patch.{name}"), &patch.on));
    let layers = spec
        .layer
        .iter()
        .map(|(name, layer)| (format!("layer.{name}"), &layer.on));
    match patches
        .chain(layers)
        .find(|(_, on)| !spec.beam.contains_key(*on) && !spec.plate.contains_key(*on))
    {
        None => Ok(()),
        Some((index, on)) => {
            let beams = listed(
                spec.beam
                    .keys()
                    .chain(spec.plate.keys())
                    .map(String::as_str),
            );
            Err(StructureError::UnknownBeam {
                place: index,
                beam: on.clone(),
                beams,
            })
        }
    }
}

fn check_mass(spec: &Spec, name: &str, mass: &Mass) -> Result<(), StructureError> {
    StructureError::positive(format!("mass.{name}.mass"), mass.mass_kg)?;
    StructureError::not_negative(
        format!("mass.{name}.rotary_inertia"),
        mass.rotary_inertia_kg_m2,
    )?;
    match mass.stiffness_n_m {
        None if spec.is_base(&mass.on) => Err(StructureError::MissingSpring { mass: name.into() }),
        None => Ok(()),
        Some(_) if mass.on == NO_SUPPORT => {
            Err(StructureError::SpringToNothing { mass: name.into() })
        }
        Some(stiffness_n_m) => {
            StructureError::positive(format!("mass.{name}.stiffness"), stiffness_n_m)?;
            StructureError::not_negative(
                format!("mass.{name}.damping_ratio"),
                mass.damping_ratio.unwrap_or(f64::NAN),
            )
        }
    }
}

/// A mass on the ground or free can be held; holding a mass on a beam or on another mass would make
/// the structure statically indeterminate.
fn check_fixable(spec: &Spec, names: &[String]) -> Result<(), StructureError> {
    let is_user_mode = |name: &str| {
        let first = name.split('.').next();
        first.is_some_and(|first| spec.modal.contains_key(first))
    };
    let can = |mass: &Mass| spec.is_base(&mass.on) || mass.on == NO_SUPPORT;
    let refused = names
        .iter()
        .filter(|name| !spec.mass.get(*name).is_some_and(can));
    let (given, others): (Vec<String>, Vec<String>) =
        refused.cloned().partition(|name| is_user_mode(name));
    match (others.is_empty(), given.is_empty()) {
        (true, true) => Ok(()),
        (true, false) => Err(StructureError::CannotHoldGiven { names: given }),
        (false, _) => {
            let masses = spec.mass.iter().filter(|(_, mass)| can(mass));
            Err(StructureError::CannotHold {
                names: [others, given].concat(),
                masses: listed(masses.map(|(name, _)| name.as_str())),
            })
        }
    }
}

fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.collect();
    if names.is_empty() {
        "there is none".into()
    } else {
        names.join(", ")
    }
}
