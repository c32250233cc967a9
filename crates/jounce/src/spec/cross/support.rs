//! What stands on what: supports exist, none holds itself up, springs and rotary inertias go where they mean something.

use super::Broken;
use crate::spec::nearest::{clip, did_you_mean, listed};
use crate::spec::{Mass, Spec};

const GROUND: &str = "ground";
const NOTHING: &str = "nothing";

pub(super) fn check(spec: &Spec, broken: &mut Broken) {
    for (name, beam) in &spec.beam {
        check_support(spec, || format!("beam.{name}.root"), &beam.root, &[GROUND], broken);
    }
    for (name, mass) in &spec.mass {
        check_support(spec, || format!("mass.{name}.on"), &mass.on, &[GROUND, NOTHING], broken);
        check_mass(spec, name, mass, broken);
    }
    check_cycles(spec, broken);
}

fn check_support(spec: &Spec, key: impl FnOnce() -> String, support: &str, words: &[&'static str], broken: &mut Broken) {
    let there = match support.split_once('.') {
        None => support.is_empty() || words.contains(&support) || spec.mass.contains_key(support),
        Some((beam, point)) => spec.beam.get(beam).is_some_and(|beam| ["root", "end"].contains(&point) || beam.point.contains_key(point)),
    };
    if there || broken.is_full() {
        return;
    }
    let points = spec.beam.iter().flat_map(|(name, beam)| {
        let named = beam.point.keys().map(String::as_str);
        named.chain(["end"]).map(move |point| format!("{name}.{point}"))
    });
    let known: Vec<String> = words.iter().map(|word| (*word).to_owned()).chain(spec.mass.keys().cloned()).chain(points).collect();
    let names = || known.iter().map(String::as_str);
    broken.push(key, || {
        let (shown, meant, all) = (clip(support), did_you_mean(support, names()), listed(names()));
        format!("there is no mass or point \"{shown}\"{meant}; it can stand on: {all}")
    });
}

/// A mass on a spring has a damping ratio; one without is fixed to a mass or a beam, or free.
fn check_mass(spec: &Spec, name: &str, mass: &Mass, broken: &mut Broken) {
    let on = mass.on.as_str();
    match (mass.stiffness_n_m, mass.damping_ratio) {
        (None, _) if on == GROUND => broken.push(
            || format!("mass.{name}"),
            || "one of `frequency` or `stiffness` is missing: on the ground a mass needs a spring; on = \"nothing\" makes it free".into(),
        ),
        (Some(_), _) if on == NOTHING => {
            broken.push(|| format!("mass.{name}.on"), || "is \"nothing\", but the mass has a spring; leave one of them out".into())
        }
        (Some(_), None) => {
            broken.push(|| format!("mass.{name}"), || "`damping_ratio` is missing; a plain number is due, without quotes".into())
        }
        (None, Some(_)) => broken.push(
            || format!("mass.{name}.damping_ratio"),
            || "does not go with a mass without spring: it has no mode of its own; give `frequency` or `stiffness` too".into(),
        ),
        _ => {}
    }
    let turns = mass.stiffness_n_m.is_none() && turns_with(spec, on, spec.mass.len());
    if mass.rotary_inertia_kg_m2 > 0.0 && !turns {
        broken.push(
            || format!("mass.{name}.rotary_inertia"),
            || "has no effect: only a mass without spring on a point of a beam turns; leave it out".into(),
        );
    }
}

/// True where a support turns with a beam; `depth` bounds the walk.
fn turns_with(spec: &Spec, support: &str, depth: usize) -> bool {
    match (support.contains('.'), spec.mass.get(support)) {
        (true, _) => true,
        (false, Some(mass)) if depth > 0 && mass.stiffness_n_m.is_none() => turns_with(spec, &mass.on, depth - 1),
        _ => false,
    }
}

/// Follows every support downwards; one that comes back to where it began is told once, at its first name.
fn check_cycles(spec: &Spec, broken: &mut Broken) {
    let below = |(is_beam, name): (bool, &str)| -> Option<(bool, String)> {
        let support = if is_beam { &spec.beam.get(name)?.root } else { &spec.mass.get(name)?.on };
        match support.split_once('.') {
            Some((beam, _)) => spec.beam.contains_key(beam).then(|| (true, beam.to_owned())),
            None => spec.mass.contains_key(support).then(|| (false, support.clone())),
        }
    };
    let beams = spec.beam.keys().map(|name| (true, name.clone()));
    let masses = spec.mass.keys().map(|name| (false, name.clone()));
    let mut settled: std::collections::BTreeSet<(bool, String)> = std::collections::BTreeSet::new();
    for start in beams.chain(masses) {
        let mut chain = vec![start];
        while let Some(next) = chain.last().and_then(|(is_beam, name)| below((*is_beam, name.as_str()))) {
            if settled.contains(&next) {
                break;
            }
            if let Some(first) = chain.iter().position(|link| *link == next) {
                let key = match &chain[first] {
                    (true, name) => format!("beam.{name}.root"),
                    (false, name) => format!("mass.{name}.on"),
                };
                let names = chain[first..].iter().chain([&next]).map(|(_, name)| clip(name)).collect::<Vec<_>>().join(" on ");
                broken.push(|| key, || format!("nothing holds these up: {names}; let one of them stand on the ground"));
                break;
            }
            chain.push(next);
        }
        settled.extend(chain);
    }
}
