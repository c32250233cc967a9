//! Points and patches lie on their beams, patches beside each other.

use std::collections::BTreeMap;

use super::Broken;
use crate::spec::{Patch, Quantity, Spec};

/// Lengths that differ by less than this part of the beam are equal: sums of decimal lengths are not exact.
const SLACK: f64 = 1e-9;

pub(super) fn check(spec: &Spec, broken: &mut Broken) {
    for (name, beam) in &spec.beam {
        for (point, &x_m) in &beam.point {
            if x_m > beam.length_m * (1.0 + SLACK) {
                let text = || format!("is {} from the root, but the beam ends at {}", metres(x_m), metres(beam.length_m));
                broken.push(|| format!("beam.{name}.point.{point}"), text);
            }
        }
    }
    let mut on_beam: BTreeMap<&str, Vec<(&str, &Patch)>> = BTreeMap::new();
    for (name, patch) in &spec.patch {
        let Some(beam) = spec.beam.get(&patch.on) else { continue };
        let end_m = patch.start_m + patch.length_m;
        if end_m > beam.length_m * (1.0 + SLACK) {
            let text = || format!("the patch ends {} from the root, but its beam ends at {}", metres(end_m), metres(beam.length_m));
            broken.push(|| format!("patch.{name}.length"), text);
        }
        if end_m.is_finite() {
            on_beam.entry(&patch.on).or_default().push((name, patch));
        }
    }
    for (beam, mut patches) in on_beam {
        patches.sort_by(|a, b| a.1.start_m.total_cmp(&b.1.start_m));
        let slack_m = SLACK * spec.beam[beam].length_m;
        // The patch that reaches furthest so far, not the one before: a long patch may cover several.
        let mut furthest = 0;
        for index in 1..patches.len() {
            let (before, (name, patch)) = (patches[furthest], patches[index]);
            let reach_m = before.1.start_m + before.1.length_m;
            if patch.start_m < reach_m - slack_m {
                let text = || {
                    format!(
                        "the patch starts at {}, but patch \"{}\" on the same beam reaches to {}",
                        metres(patch.start_m),
                        before.0,
                        metres(reach_m)
                    )
                };
                broken.push(|| format!("patch.{name}.start"), text);
            }
            if patch.start_m + patch.length_m > reach_m {
                furthest = index;
            }
        }
    }
}

/// A length for a message: sums are rounded to what decimals were meant.
fn metres(length_m: f64) -> String {
    let rounded = format!("{length_m:.12e}").parse().unwrap_or(length_m);
    Quantity::Length.write(rounded)
}
