//! Supports: they exist, form no loop, and springs and rotary inertias are used only where they
//! have an effect.

use std::cell::LazyCell;
use std::collections::BTreeSet;

use super::ValidationFaults;
use super::reference::unknown;
use crate::nearest::clip;
use crate::{Beam, GROUND, Mass, NO_SUPPORT, Plate, Spec, Start};

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    // Listed once, and only if there is a fault.
    let supports = LazyCell::new(|| support_names(spec));
    for (name, beam) in &spec.beam {
        check_support(
            spec,
            &supports,
            &|| format!("beam.{name}.root"),
            &beam.root,
            &[GROUND],
            faults,
        );
    }
    for (name, mass) in &spec.mass {
        check_support(
            spec,
            &supports,
            &|| format!("mass.{name}.on"),
            &mass.on,
            &[GROUND, NO_SUPPORT],
            faults,
        );
        check_mass(spec, name, mass, faults);
    }
    check_cycles(spec, faults);
}

fn check_support<F: FnOnce() -> Vec<String>>(
    spec: &Spec,
    supports: &LazyCell<Vec<String>, F>,
    key: &dyn Fn() -> String,
    support: &str,
    words: &[&str],
    faults: &mut ValidationFaults,
) {
    let is_on_plate = spec.plate_point(support).is_some();
    if is_on_plate && !words.contains(&NO_SUPPORT) {
        let text = "is a point of a plate, which carries only fixed masses; clamp the beam to a base, a mass or a beam";
        faults.push(key, || text.to_owned());
        return;
    }
    let is_known = match support.split_once('.') {
        None => {
            support.is_empty()
                || words.contains(&support)
                || spec.mass.contains_key(support)
                || spec.is_base(support)
        }
        Some((beam, point)) => spec
            .beam
            .get(beam)
            .is_some_and(|beam| ["root", "end"].contains(&point) || beam.point.contains_key(point)),
    };
    if !is_known && !is_on_plate {
        faults.push(key, || {
            let mut names = words.to_vec();
            names.extend(spec.bases());
            names.extend(supports.iter().map(String::as_str));
            unknown("mass or point", support, "possible supports", &names)
        });
    }
}

/// Returns masses, points of beams except their roots, and points of plates.
fn support_names(spec: &Spec) -> Vec<String> {
    let of_beam = |(name, beam): (&String, &Beam)| -> Vec<String> {
        beam.point
            .keys()
            .map(String::as_str)
            .chain(["end"])
            .map(|point| format!("{name}.{point}"))
            .collect()
    };
    let of_plate = |(name, plate): (&String, &Plate)| -> Vec<String> {
        let points = plate.point.keys();
        points.map(|point| format!("{name}.{point}")).collect()
    };
    spec.mass
        .keys()
        .cloned()
        .chain(spec.beam.iter().flat_map(of_beam))
        .chain(spec.plate.iter().flat_map(of_plate))
        .collect()
}

/// A mass on a spring has a damping ratio; a mass without a spring is free or fixed to a mass or a
/// beam.
fn check_mass(spec: &Spec, name: &str, mass: &Mass, faults: &mut ValidationFaults) {
    let on = mass.on.as_str();
    match (mass.stiffness_n_m, mass.damping_ratio) {
        (None, _) if spec.is_base(on) => faults.push(
            || format!("mass.{name}"),
            || "one of `frequency` or `stiffness` is missing; a mass on the ground or another base needs a spring (on = \"nothing\" makes it free)".into(),
        ),
        (Some(_), _) if on == NO_SUPPORT => {
            faults.push(|| format!("mass.{name}.on"), || "is \"nothing\", but the mass has a spring; remove the spring, or name its support".into())
        }
        (Some(_), None) => {
            faults.push(|| format!("mass.{name}"), || "`damping_ratio` is missing; expected a plain number without quotes or unit".into())
        }
        (None, Some(_)) => faults.push(
            || format!("mass.{name}.damping_ratio"),
            || "does not apply to a mass without a spring, which has no mode of its own; give `frequency` or `stiffness` too".into(),
        ),
        _ => {}
    }
    check_velocity(spec, name, mass, faults);
    check_friction(spec, name, mass, faults);
    let turns = mass.stiffness_n_m.is_none() && turns_with(spec, on, spec.mass.len());
    if mass.rotary_inertia_kg_m2 > 0.0 && !turns {
        faults.push(
            || format!("mass.{name}.rotary_inertia"),
            || {
                "has no effect: only a mass without a spring on a point of a beam rotates; omit it"
                    .into()
            },
        );
    }
}

/// A velocity is allowed for a free mass or a mass on a spring that carries no beam.
fn check_velocity(spec: &Spec, name: &str, mass: &Mass, faults: &mut ValidationFaults) {
    if mass
        .velocity_m_s
        .is_none_or(|velocity_m_s| velocity_m_s == 0.0)
    {
        return;
    }
    let key = || format!("mass.{name}.velocity");
    if mass.stiffness_n_m.is_none() && mass.on != NO_SUPPORT {
        faults.push(key, || {
            "does not apply to a mass that is fixed to its support; give it to a free mass or a mass on a spring".into()
        });
    }
    if let Some((beam, _)) = spec
        .beam
        .iter()
        .find(|(_, beam)| spec.is_fixed_to(&beam.root, name))
    {
        let text = || {
            format!(
                "is that of the mass alone, but the root of beam \"{}\" is clamped to the mass; give a [drive.NAME] with signal = \"velocity-step\" instead",
                clip(beam)
            )
        };
        faults.push(key, text);
    }
    if matches!(spec.run.start, Start::State(_)) {
        faults.push(key, || "has no effect: the state file of run.start contains the velocities; omit one of the two".into());
    }
}

/// Friction is allowed for a free mass that carries no moving element.
fn check_friction(spec: &Spec, name: &str, mass: &Mass, faults: &mut ValidationFaults) {
    if mass.friction_n_s_m.is_none() {
        return;
    }
    let key = || format!("mass.{name}.friction");
    if mass.stiffness_n_m.is_some() {
        faults
            .push(key, || "does not apply to a mass on a spring, whose loss is set by `damping_ratio`; omit `friction`".into());
    } else if mass.on != NO_SUPPORT && !mass.on.is_empty() {
        faults.push(key, || "is for a free mass that moves in a channel; set on = \"nothing\", or omit `friction`".into());
    }
    let beams = spec
        .beam
        .iter()
        .map(|(other, beam)| (format!("beam.{other}"), &beam.root));
    let sprung = spec
        .mass
        .iter()
        .filter(|(_, other)| other.stiffness_n_m.is_some())
        .map(|(other, other_mass)| (format!("mass.{other}"), &other_mass.on));
    if let Some((other, _)) = beams
        .chain(sprung)
        .find(|(_, support)| spec.is_fixed_to(support, name))
    {
        let text = || {
            format!(
                "does not apply to a mass that carries a moving element, here {}; remove one of the two",
                clip(&other)
            )
        };
        faults.push(key, text);
    }
}

/// True if a support rotates with a beam; `depth` bounds the recursion.
fn turns_with(spec: &Spec, support: &str, depth: usize) -> bool {
    match (support.contains('.'), spec.mass.get(support)) {
        (true, _) => true,
        (false, Some(mass)) if depth > 0 && mass.stiffness_n_m.is_none() => {
            turns_with(spec, &mass.on, depth - 1)
        }
        _ => false,
    }
}

/// Follows every support downwards; a loop is reported once, at its first name.
fn check_cycles(spec: &Spec, faults: &mut ValidationFaults) {
    let below = |(is_beam, name): (bool, &str)| -> Option<(bool, String)> {
        let support = if is_beam {
            &spec.beam.get(name)?.root
        } else {
            &spec.mass.get(name)?.on
        };
        match support.split_once('.') {
            Some((beam, _)) => spec
                .beam
                .contains_key(beam)
                .then(|| (true, beam.to_owned())),
            None if [GROUND, NO_SUPPORT].contains(&support.as_str()) => None,
            None => spec
                .mass
                .contains_key(support)
                .then(|| (false, support.clone())),
        }
    };
    let beams = spec.beam.keys().map(|name| (true, name.clone()));
    let masses = spec.mass.keys().map(|name| (false, name.clone()));
    let mut settled: BTreeSet<(bool, String)> = BTreeSet::new();
    for start in beams.chain(masses) {
        let mut chain = vec![start];
        while let Some(next) = chain
            .last()
            .and_then(|(is_beam, name)| below((*is_beam, name.as_str())))
        {
            if settled.contains(&next) {
                break;
            }
            if let Some(first) = chain.iter().position(|link| *link == next) {
                let key = match &chain[first] {
                    (true, name) => format!("beam.{name}.root"),
                    (false, name) => format!("mass.{name}.on"),
                };
                let names = chain[first..]
                    .iter()
                    .chain([&next])
                    .map(|(_, name)| clip(name))
                    .collect::<Vec<_>>()
                    .join(" on ");
                faults.push(
                    || key,
                    || {
                        format!(
                            "these support each other in a loop: {names}; put one of them on the ground"
                        )
                    },
                );
                break;
            }
            chain.push(next);
        }
        settled.extend(chain);
    }
}
