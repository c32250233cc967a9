//! Points and patches lie on their beams; patches on one face do not overlap.

use std::collections::BTreeMap;

use super::ValidationFaults;
use crate::{Face, Patch, Quantity, Spec};

/// Relative difference, in beam lengths, below which two lengths are equal; sums of decimals are
/// not exact.
pub(super) const LENGTH_ROUNDOFF: f64 = 1e-9;

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    for (name, beam) in &spec.beam {
        for (point, &x_m) in &beam.point {
            if x_m > beam.length_m * (1.0 + LENGTH_ROUNDOFF) {
                let text = || {
                    format!(
                        "is {} from the root; it must not exceed the beam length {}",
                        metres(x_m),
                        metres(beam.length_m)
                    )
                };
                faults.push(|| format!("beam.{name}.point.{point}"), text);
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
                    "the patch ends {} from the root; it must not exceed the beam length {}",
                    metres(end_m(patch)),
                    metres(beam.length_m)
                )
            };
            faults.push(|| format!("patch.{name}.length"), text);
        }
        if patch.width_m > beam.width_m * (1.0 + LENGTH_ROUNDOFF) {
            let text = || {
                format!(
                    "the patch is {} wide; it must not exceed the beam width {}",
                    metres(patch.width_m),
                    metres(beam.width_m)
                )
            };
            faults.push(|| format!("patch.{name}.width"), text);
        }
        if patch.d33_m_per_v.is_some() != patch.electrode_spacing_m.is_some() {
            let text = || {
                "`d33` and `electrode_spacing` require each other; give both, or `d31` alone"
                    .to_owned()
            };
            faults.push(|| format!("patch.{name}"), text);
        }
        if end_m(patch).is_finite() {
            on_face
                .entry((patch.on.as_str(), patch.face == Face::Top))
                .or_default()
                .push((name, patch));
        }
    }
    check_facing(&on_face, faults);
    for ((beam, _), patches) in on_face {
        check_overlap(patches, LENGTH_ROUNDOFF * spec.beam[beam].length_m, faults);
    }
}

/// Two patches at the same position on the two faces have the same section model.
fn check_facing(
    on_face: &BTreeMap<(&str, bool), Vec<(&str, &Patch)>>,
    faults: &mut ValidationFaults,
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
                faults.push(|| format!("patch.{name}.section"), text);
            }
        }
    }
}

fn check_overlap(mut patches: Vec<(&str, &Patch)>, slack_m: f64, faults: &mut ValidationFaults) {
    patches.sort_by(|a, b| a.1.start_m.total_cmp(&b.1.start_m));
    // The patch that ends furthest from the root so far, which need not be the previous one.
    let mut furthest = 0;
    for index in 1..patches.len() {
        let ((other, before), (name, patch)) = (patches[furthest], patches[index]);
        if patch.start_m < end_m(before) - slack_m {
            let [start, reach] = [patch.start_m, end_m(before)].map(metres);
            let text = || {
                format!(
                    "the patch starts at {start}, but patch \"{other}\" on the same face ends at {reach}; move or shorten one of them"
                )
            };
            faults.push(|| format!("patch.{name}.start"), text);
        }
        if end_m(patch) > end_m(before) {
            furthest = index;
        }
    }
}

fn end_m(patch: &Patch) -> f64 {
    patch.start_m + patch.length_m
}

/// Returns a length for a message, rounded to the intended decimals.
pub(super) fn metres(length_m: f64) -> String {
    let rounded = format!("{length_m:.12e}").parse().unwrap_or(length_m);
    Quantity::Length.write(rounded)
}
