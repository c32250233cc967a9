//! Layers lie on their beams, do not overlap each other, and extend under complete patches.

use super::ValidationFaults;
use super::geometry::{LENGTH_ROUNDOFF, metres};
use crate::{Face, Layer, Section, Spec};

/// A layer or a patch on a face.
struct FaceCover<'s> {
    key: String,
    face: Face,
    start_m: f64,
    end_m: f64,
    section: Section,
    on: &'s str,
}

impl<'s> FaceCover<'s> {
    fn of_layer(name: &str, layer: &'s Layer) -> Self {
        let end_m = layer.start_m + layer.length_m;
        Self {
            key: format!("layer.{name}"),
            face: layer.face,
            start_m: layer.start_m,
            end_m,
            section: layer.section,
            on: &layer.on,
        }
    }

    fn meets(&self, other: &Self, slack_m: f64) -> bool {
        self.on == other.on
            && self.start_m < other.end_m - slack_m
            && other.start_m < self.end_m - slack_m
    }
}

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    let layers: Vec<FaceCover> = spec
        .layer
        .iter()
        .filter(|(_, layer)| !spec.plate.contains_key(&layer.on))
        .map(|(name, layer)| FaceCover::of_layer(name, layer))
        .collect();
    let patches = spec.patch.iter().map(|(name, patch)| FaceCover {
        key: format!("patch.{name}"),
        face: patch.face,
        start_m: patch.start_m,
        end_m: patch.start_m + patch.length_m,
        section: patch.section,
        on: &patch.on,
    });
    let patches: Vec<FaceCover> = patches.collect();
    let on_beams = spec
        .layer
        .iter()
        .filter(|(_, layer)| !spec.plate.contains_key(&layer.on));
    for ((name, layer), cover) in on_beams.zip(&layers) {
        let Some(beam) = spec.beam.get(&layer.on) else {
            continue;
        };
        if cover.end_m > beam.length_m * (1.0 + LENGTH_ROUNDOFF) {
            let text = || {
                format!(
                    "the layer ends {} from the root; it must not exceed the beam length {}",
                    metres(cover.end_m),
                    metres(beam.length_m)
                )
            };
            faults.push(|| format!("layer.{name}.length"), text);
        }
        if layer.width_m > beam.width_m * (1.0 + LENGTH_ROUNDOFF) {
            let text = || {
                format!(
                    "the layer is {} wide; it must not exceed the beam width {}",
                    metres(layer.width_m),
                    metres(beam.width_m)
                )
            };
            faults.push(|| format!("layer.{name}.width"), text);
        }
    }
    for (index, layer) in layers.iter().enumerate() {
        let slack_m = LENGTH_ROUNDOFF * spec.beam.get(layer.on).map_or(0.0, |beam| beam.length_m);
        for other in layers[..index]
            .iter()
            .chain(&patches)
            .filter(|other| layer.meets(other, slack_m))
        {
            check_pair(layer, other, slack_m, faults);
        }
    }
}

/// Checks a layer against an element that covers part of the same length.
fn check_pair(layer: &FaceCover, other: &FaceCover, slack_m: f64, faults: &mut ValidationFaults) {
    if layer.section != other.section {
        let text = || {
            format!(
                "differs from that of {}, which covers the same part of the beam; give both the same section",
                other.key
            )
        };
        faults.push(|| format!("{}.section", layer.key), text);
    }
    if layer.face != other.face {
        return;
    }
    let [start, end] = [other.start_m, other.end_m].map(metres);
    if other.key.starts_with("layer.") {
        let text = || {
            format!(
                "{} covers {start} to {end} of the same face; end one layer where the other starts",
                other.key
            )
        };
        faults.push(|| format!("{}.start", layer.key), text);
    } else if other.start_m < layer.start_m - slack_m || other.end_m > layer.end_m + slack_m {
        let text = || {
            format!(
                "{} covers {start} to {end} of the same face, only partly on this layer; extend the layer under the complete patch, or end it next to the patch",
                other.key
            )
        };
        faults.push(|| format!("{}.length", layer.key), text);
    }
}
