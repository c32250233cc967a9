//! References name existing elements without ambiguity.

use std::cell::LazyCell;

use super::ValidationFaults;
use crate::nearest::{clip, did_you_mean, join_words};
use crate::{GROUND, NO_SUPPORT, Spec};

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    check_names(spec, faults);
    check_carriers(spec, faults);
    // Listed once, and only if there is a fault; a huge file may have many points and many wrong
    // references.
    let points = LazyCell::new(|| points(spec));
    for (name, drive) in spec
        .drive
        .iter()
        .filter(|(_, drive)| drive.base().is_none())
    {
        check_point(
            spec,
            &points,
            &|| format!("drive.{name}.at"),
            &drive.at,
            false,
            faults,
        );
    }
    for (name, stop) in &spec.stop {
        check_point(
            spec,
            &points,
            &|| format!("stop.{name}.at"),
            &stop.at,
            false,
            faults,
        );
        check_point(
            spec,
            &points,
            &|| format!("stop.{name}.frame"),
            &stop.frame,
            true,
            faults,
        );
        if !stop.at.is_empty() && stop.at == stop.frame {
            faults.push(
                || format!("stop.{name}.frame"),
                || {
                    format!(
                        "\"{}\" would strike itself; name another body or \"ground\"",
                        clip(&stop.at)
                    )
                },
            );
        }
    }
}

/// Every patch and every layer is on a beam or a plate.
fn check_carriers(spec: &Spec, faults: &mut ValidationFaults) {
    let patches = spec.patch.iter();
    let layers = spec.layer.iter();
    let on_beams = patches
        .map(|(name, patch)| ("patch", name, &patch.on))
        .chain(layers.map(|(name, layer)| ("layer", name, &layer.on)));
    for (kind, name, on) in on_beams {
        if !on.is_empty() && !spec.beam.contains_key(on) && !spec.plate.contains_key(on) {
            let text = || {
                let carriers = spec.beam.keys().chain(spec.plate.keys());
                let carriers: Vec<&str> = carriers.map(String::as_str).collect();
                unknown("beam or plate", on, "beams and plates", &carriers)
            };
            faults.push(|| format!("{kind}.{name}.on"), text);
        }
    }
}

fn check_names(spec: &Spec, faults: &mut ValidationFaults) {
    for name in spec
        .modal
        .keys()
        .filter(|name| spec.beam.contains_key(*name))
    {
        let text = || {
            format!(
                "a beam has this name too, so \"{}.end\" is ambiguous; rename one of them",
                clip(name)
            )
        };
        faults.push(|| format!("modal.{name}"), text);
    }
    for name in spec
        .plate
        .keys()
        .filter(|name| spec.beam.contains_key(*name) || spec.modal.contains_key(*name))
    {
        let text = || {
            format!(
                "another structure has this name too, so points of \"{}\" are ambiguous; rename one of them",
                clip(name)
            )
        };
        faults.push(|| format!("plate.{name}"), text);
    }
    for reserved in [GROUND, NO_SUPPORT]
        .into_iter()
        .filter(|name| spec.mass.contains_key(*name))
    {
        let text = || {
            format!(
                "the name \"{reserved}\" is reserved{}; choose another",
                if reserved == GROUND {
                    " for the ground"
                } else {
                    ""
                }
            )
        };
        faults.push(|| format!("mass.{reserved}"), text);
    }
    for (name, beam) in &spec.beam {
        for end in ["root", "end"]
            .into_iter()
            .filter(|end| beam.point.contains_key(*end))
        {
            let text = || {
                format!(
                    "\"{}.{end}\" always exists; choose another name",
                    clip(name)
                )
            };
            faults.push(|| format!("beam.{name}.point.{end}"), text);
        }
    }
}

fn check_point<F: FnOnce() -> Vec<String>>(
    spec: &Spec,
    points: &LazyCell<Vec<String>, F>,
    key: &dyn Fn() -> String,
    point: &str,
    ground: bool,
    faults: &mut ValidationFaults,
) {
    if point.is_empty()
        || has_point(spec, point)
        || (ground && spec.is_base(point))
        || faults.is_full()
    {
        return;
    }
    faults.push(key, || {
        let bases = [GROUND].into_iter().chain(spec.bases());
        let mut words: Vec<&str> = bases.filter(|_| ground).collect();
        words.extend(points.iter().map(String::as_str));
        unknown("point or mass", point, "points and masses", &words)
    });
}

fn has_point(spec: &Spec, name: &str) -> bool {
    let Some((body, point)) = name.split_once('.') else {
        return spec.mass.contains_key(name);
    };
    let on_beam = spec
        .beam
        .get(body)
        .is_some_and(|beam| point == "root" || point == "end" || beam.point.contains_key(point));
    on_beam
        || spec.plate_point(name).is_some()
        || spec
            .modal
            .get(body)
            .is_some_and(|modal| modal.point.contains_key(point))
}

fn points(spec: &Spec) -> Vec<String> {
    let on_beams = spec.beam.iter().flat_map(|(body, beam)| {
        let named = beam
            .point
            .keys()
            .map(String::as_str)
            .filter(|point| !["root", "end"].contains(point));
        named
            .chain(["root", "end"])
            .map(move |point| format!("{body}.{point}"))
    });
    let on_modal = spec.modal.iter().flat_map(|(body, modal)| {
        modal
            .point
            .keys()
            .map(move |point| format!("{body}.{point}"))
    });
    let on_plates = spec.plate.iter().flat_map(|(body, plate)| {
        plate
            .point
            .keys()
            .map(move |point| format!("{body}.{point}"))
    });
    on_beams
        .chain(on_plates)
        .chain(on_modal)
        .chain(spec.mass.keys().cloned())
        .collect()
}

pub(super) fn patches(spec: &Spec) -> Vec<String> {
    let modal = spec.modal.iter().flat_map(|(body, modal)| {
        modal
            .patch
            .keys()
            .map(move |patch| format!("{body}.{patch}"))
    });
    spec.patch.keys().cloned().chain(modal).collect()
}

pub(super) fn unknown(noun: &str, name: &str, many: &str, known: &[&str]) -> String {
    let suggestion = did_you_mean(name, known);
    let listed = join_words(known);
    let listed = if listed.is_empty() {
        format!("this spec has no {}", many.replace(" and ", " or "))
    } else {
        format!("{many} here: {listed}")
    };
    format!(
        "there is no {noun} \"{}\"{suggestion}; {listed}",
        clip(name)
    )
}
