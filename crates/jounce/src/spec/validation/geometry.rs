//! Points and patches lie on their beams, patches of one face beside each other.

use std::collections::BTreeMap;

use super::ValidationFaults;
use crate::spec::{Face, Patch, Quantity, Spec};

/// Lengths that differ by less than this part of the beam are equal: sums of decimal lengths are not exact.
pub(super) const LENGTH_ROUNDOFF: f64 = 1e-9;

pub(super) fn check(spec: &Spec, broken: &mut ValidationFaults) {
    for (name, beam) in &spec.beam {
        for (point, &x_m) in &beam.point {
            if x_m > beam.length_m * (1.0 + LENGTH_ROUNDOFF) {
                let text = || {
                    format!(
                        "is {} from the root, but the beam ends at {}",
                        metres(x_m),
                        metres(beam.length_m)
                    )
                };
                broken.push(|| format!("beam.{name}.point.{point}"), text);
            }
        }
    }
    let mut on_face: BTreeMap<(&str, bool), Vec<(&str, &Patch)>> = BTreeMap::new();
    for (name, patch) in &spec.patch {
        let Some(beam) = spec.beam.get(&patch.on) else {
            continue;
        };
        if end_m(patch) > beam.length_m * (1.0 + LENGTH_ROUNDOFF) {
            let text = || {
                format!(
                    "the patch ends {} from the root, but its beam ends at {}",
                    metres(end_m(patch)),
                    metres(beam.length_m)
                )
            };
            broken.push(|| format!("patch.{name}.length"), text);
        }
        if patch.width_m > beam.width_m * (1.0 + LENGTH_ROUNDOFF) {
            let text = || {
                format!(
                    "the patch is {} wide, but its beam is {}",
                    metres(patch.width_m),
                    metres(beam.width_m)
                )
            };
            broken.push(|| format!("patch.{name}.width"), text);
        }
        if patch.d33_m_per_v.is_some() != patch.electrode_spacing_m.is_some() {
            let text = || {
                "`d33` and `electrode_spacing` go together; give both, or `d31` alone".to_owned()
            };
            broken.push(|| format!("patch.{name}"), text);
        }
        if end_m(patch).is_finite() {
            on_face
                .entry((patch.on.as_str(), patch.face == Face::Top))
                .or_default()
                .push((name, patch));
        }
    }
    check_facing(&on_face, broken);
    for ((beam, _), patches) in on_face {
        check_overlap(patches, LENGTH_ROUNDOFF * spec.beam[beam].length_m, broken);
    }
}

/// Two patches on the two faces of one stretch take the same rule of section.
fn check_facing(
    on_face: &BTreeMap<(&str, bool), Vec<(&str, &Patch)>>,
    broken: &mut ValidationFaults,
) {
    for ((beam, _), tops) in on_face.iter().filter(|((_, top), _)| *top) {
        let Some(bottoms) = on_face.get(&(*beam, false)) else {
            continue;
        };
        for (name, patch) in bottoms {
            let facing = |top: &&(&str, &Patch)| {
                top.1.start_m < end_m(patch)
                    && patch.start_m < end_m(top.1)
                    && top.1.section != patch.section
            };
            if let Some((other, _)) = tops.iter().find(facing) {
                let text = || {
                    format!(
                        "differs from that of patch \"{other}\" on the other face; give both the same section"
                    )
                };
                broken.push(|| format!("patch.{name}.section"), text);
            }
        }
    }
}

fn check_overlap(mut patches: Vec<(&str, &Patch)>, slack_m: f64, broken: &mut ValidationFaults) {
    patches.sort_by(|a, b| a.1.start_m.total_cmp(&b.1.start_m));
    // The patch that reaches furthest so far, not the one before: a long patch may cover several.
    let mut furthest = 0;
    for index in 1..patches.len() {
        let ((other, before), (name, patch)) = (patches[furthest], patches[index]);
        if patch.start_m < end_m(before) - slack_m {
            let [start, reach] = [patch.start_m, end_m(before)].map(metres);
            let text = || {
                format!(
                    "the patch starts at {start}, but patch \"{other}\" on the same face reaches to {reach}"
                )
            };
            broken.push(|| format!("patch.{name}.start"), text);
        }
        if end_m(patch) > end_m(before) {
            furthest = index;
        }
    }
}

fn end_m(patch: &Patch) -> f64 {
    patch.start_m + patch.length_m
}

/// A length for a message: sums are rounded to what decimals were meant.
pub(super) fn metres(length_m: f64) -> String {
    let rounded = format!("{length_m:.12e}").parse().unwrap_or(length_m);
    Quantity::Length.write(rounded)
}
