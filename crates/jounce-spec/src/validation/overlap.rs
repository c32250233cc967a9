//! Bodies do not overlap at rest.
//!
//! Only weight presses a free body into a stop. At rest its penetration is at most the static
//! penetration under the weight of all free bodies. Two unsupported free bodies fall together and
//! do not press on each other.

use std::collections::BTreeSet;

use super::ValidationFaults;
use super::geometry::metres;
use crate::nearest::clip;
use crate::{NO_SUPPORT, Quantity, Side, Spec, Start, Stop, StopLaw};

/// Relative excess over the static penetration that is allowed, because depths are written with few
/// digits.
const DEPTH_ROUNDOFF: f64 = 1e-3;

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    let one_sided = |stop: &Stop| !matches!(stop.law, StopLaw::Cubic { .. });
    for (name, stop) in spec
        .stop
        .iter()
        .filter(|(_, stop)| stop.gap_m < 0.0 && one_sided(stop))
    {
        let free = [&stop.at, &stop.frame].map(|point| free_below(spec, point));
        let Some(mass) = free[0].or(free[1]).filter(|_| free[0] != free[1]) else {
            check_inside_at_rest(spec, (name, stop), faults);
            continue;
        };
        // Under gravity, other starts than rest place the bodies elsewhere: a sagging beam makes
        // room.
        if pulls(spec) && free.contains(&None) && spec.run.start != Start::Rest {
            continue;
        }
        let most_m = pressed_m(spec, stop, free);
        if -stop.gap_m > most_m * (1.0 + DEPTH_ROUNDOFF) {
            let gap = Quantity::Length.write(stop.gap_m);
            let least = if most_m > 0.0 {
                Quantity::Length.write(-rounded(most_m))
            } else {
                "0".to_owned()
            };
            let reason = if most_m > 0.0 {
                " deeper than weight allows"
            } else {
                ""
            };
            let text = || {
                format!(
                    "is {gap}: at rest the free mass \"{}\" would penetrate the stop{reason}; give at least {least}",
                    clip(mass)
                )
            };
            faults.push(|| format!("stop.{name}.gap"), text);
        }
    }
    check_facing(spec, faults);
}

/// Refuses a supported point that lies inside a rigid stop at rest, since a run from rest cannot
/// start there. For two different bases this is checked at placement.
fn check_inside_at_rest(spec: &Spec, (name, stop): (&str, &Stop), faults: &mut ValidationFaults) {
    let is_rigid = matches!(stop.law, StopLaw::Rigid { .. });
    if is_rigid
        && spec.run.start == Start::Rest
        && spec.base_under(&stop.at) == spec.base_under(&stop.frame)
    {
        let text = || {
            format!(
                "is {}: at rest \"{}\" would lie inside the rigid stop; give at least 0, a compliant law (hertz, spring), or a run.start other than \"rest\"",
                metres(stop.gap_m),
                clip(&stop.at)
            )
        };
        faults.push(|| format!("stop.{name}.gap"), text);
    }
}

/// Two rigid stops on the two sides of one point must not overlap.
fn check_facing(spec: &Spec, faults: &mut ValidationFaults) {
    let rigid = |side: Side| {
        spec.stop
            .iter()
            .filter(move |(_, stop)| stop.side == side && matches!(stop.law, StopLaw::Rigid { .. }))
    };
    let lower: Vec<(&String, &Stop)> = rigid(Side::Negative).collect();
    for (name, stop) in rigid(Side::Positive) {
        let faces =
            |(_, other): &&(&String, &Stop)| other.at == stop.at && other.frame == stop.frame;
        for (other, facing) in lower.iter().filter(faces) {
            let room_m = stop.gap_m + facing.gap_m;
            if room_m < 0.0 {
                let [gap, overlap] = [stop.gap_m, -room_m].map(metres);
                let text = || {
                    format!(
                        "is {gap}: it overlaps the rigid stop \"{}\" on the other side by {overlap}; increase one of the two gaps",
                        clip(other)
                    )
                };
                faults.push(|| format!("stop.{name}.gap"), text);
            }
        }
    }
}

fn pulls(spec: &Spec) -> bool {
    spec.gravity
        .acceleration_m_s2
        .is_some_and(|acceleration| acceleration != 0.0)
}

/// Returns the largest static penetration of a stop under weight, m.
fn pressed_m(spec: &Spec, stop: &Stop, free: [Option<&str>; 2]) -> f64 {
    let Some(acceleration_m_s2) = spec.gravity.acceleration_m_s2 else {
        return 0.0;
    };
    // Against a supported body the weight must point into the stop; a stack may press both ways.
    let towards = if stop.side == Side::Positive {
        acceleration_m_s2
    } else {
        -acceleration_m_s2
    };
    let presses = match free {
        [Some(_), None] => towards > 0.0,
        [None, Some(_)] => towards < 0.0,
        [Some(mass), _] => carried_bodies(spec).contains(mass),
        [None, None] => true,
    };
    let weight_n = acceleration_m_s2.abs() * free_mass_kg(spec);
    if presses {
        stop.static_penetration_m(weight_n).unwrap_or(f64::INFINITY)
    } else {
        0.0
    }
}

/// Returns the free masses that rest on a supported body, directly or through other free masses.
fn carried_bodies(spec: &Spec) -> BTreeSet<&str> {
    let mut bodies = BTreeSet::new();
    for _ in 0..spec.mass.len() {
        for stop in spec.stop.values() {
            let free = [&stop.at, &stop.frame].map(|point| free_below(spec, point));
            if free
                .iter()
                .any(|mass| mass.is_none_or(|mass| bodies.contains(mass)))
            {
                bodies.extend(free.into_iter().flatten());
            }
        }
    }
    bodies
}

/// Returns the mass of all unsupported bodies, kg.
fn free_mass_kg(spec: &Spec) -> f64 {
    let masses = spec
        .mass
        .iter()
        .filter(|(name, _)| free_below(spec, name).is_some())
        .map(|(_, mass)| mass.mass_kg);
    let free = |beam: &str| free_below(spec, beam).is_some();
    let beams = spec.beam.iter().filter(|(name, _)| free(name));
    let beams =
        beams.map(|(_, beam)| beam.density_kg_m3 * beam.length_m * beam.width_m * beam.thickness_m);
    let patches = spec.patch.values().filter(|patch| free(&patch.on));
    let patches = patches.map(|patch| {
        let foils_kg_m2 = 2.0 * patch.foils.each_m() * patch.foils.mass_per_volume_kg_m3();
        (patch.density_kg_m3 * patch.thickness_m + foils_kg_m2) * patch.length_m * patch.width_m
    });
    let layers = spec.layer.values().filter(|layer| free(&layer.on));
    let layers = layers
        .map(|layer| layer.density_kg_m3 * layer.length_m * layer.width_m * layer.thickness_m);
    masses.chain(beams).chain(patches).chain(layers).sum()
}

/// Returns the free mass that a point belongs to or is supported by.
pub(super) fn free_below<'s>(spec: &'s Spec, point: &'s str) -> Option<&'s str> {
    let mut body = point.split('.').next().unwrap_or_default();
    for _ in 0..=spec.mass.len() + spec.beam.len() {
        let below = match (spec.mass.get(body), spec.beam.get(body)) {
            (Some(mass), _) if mass.on == NO_SUPPORT => return Some(body),
            (Some(mass), _) => &mass.on,
            (None, Some(beam)) => &beam.root,
            (None, None) => return None,
        };
        body = below.split('.').next().unwrap_or_default();
    }
    None
}

/// Rounds a depth to three digits for a message.
fn rounded(length_m: f64) -> f64 {
    format!("{length_m:.2e}").parse().unwrap_or(length_m)
}
