//! Plates: supports, points, and what lies on them.

use std::collections::BTreeSet;

use super::ValidationFaults;
use super::geometry::{LENGTH_ROUNDOFF, metres};
use super::reference::unknown;
use crate::material;
use crate::nearest::clip;
use crate::{Face, GROUND, Layer, Patch, Plate, PlateArea, Section, Spec};

/// A layer or a patch of a plate.
struct Cover {
    key: String,
    face: Face,
    area: PlateArea,
    is_layer: bool,
}

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    for (name, plate) in &spec.plate {
        check_support(spec, name, plate, faults);
        check_points(name, plate, faults);
        check_covers(spec, name, plate, faults);
    }
    check_beam_covers(spec, faults);
    check_masses(spec, faults);
}

fn check_support(spec: &Spec, name: &str, plate: &Plate, faults: &mut ValidationFaults) {
    if !plate.on.is_empty() && !spec.is_base(&plate.on) {
        let text = || {
            let bases: Vec<&str> = [GROUND].into_iter().chain(spec.bases()).collect();
            let unknown = unknown("base", &plate.on, "bases", &bases);
            format!("{unknown}; a plate stands on a base only, not on a mass or a point")
        };
        faults.push(|| format!("plate.{name}.on"), text);
    }
    let of_material = material::named(&plate.material).map(|known| known.poisson_ratio);
    if plate.poisson_ratio.is_nan() && of_material == Some(None) {
        check_poisson_ratio(
            &format!("plate.{name}"),
            plate.youngs_modulus_pa,
            None,
            faults,
        );
    }
    if !plate.is_supported() {
        let text = || {
            "the plate could move as a rigid body; set one edge (left, right, front, back) to \"clamped\" or two to \"simply-supported\"".to_owned()
        };
        faults.push(|| format!("plate.{name}"), text);
    }
}

fn check_points(name: &str, plate: &Plate, faults: &mut ValidationFaults) {
    for (point, place) in &plate.point {
        let sides = [
            ("x", place.x_m, plate.length_m, "left", "length"),
            ("y", place.y_m, plate.width_m, "front", "width"),
        ];
        for (axis, at_m, side_m, edge, side) in sides {
            if at_m > side_m * (1.0 + LENGTH_ROUNDOFF) {
                let text = || {
                    format!(
                        "is {} from the {edge} edge; it must not exceed the plate {side} {}",
                        metres(at_m),
                        metres(side_m)
                    )
                };
                faults.push(|| format!("plate.{name}.point.{point}.{axis}"), text);
            }
        }
    }
}

fn check_covers(spec: &Spec, name: &str, plate: &Plate, faults: &mut ValidationFaults) {
    let mut covers: Vec<Cover> = Vec::new();
    for (key, layer) in spec.layer.iter().filter(|(_, layer)| layer.on == name) {
        let cover = Cover {
            key: format!("layer.{key}"),
            face: layer.face,
            area: plate.area(
                layer.start_m,
                layer.length_m,
                layer.width_m,
                &layer.on_plate,
            ),
            is_layer: true,
        };
        check_layer(&cover.key, layer, faults);
        covers.push(cover);
    }
    for (key, patch) in spec.patch.iter().filter(|(_, patch)| patch.on == name) {
        let cover = Cover {
            key: format!("patch.{key}"),
            face: patch.face,
            area: plate.area(
                patch.start_m,
                patch.length_m,
                patch.width_m,
                &patch.on_plate,
            ),
            is_layer: false,
        };
        check_patch(&cover.key, patch, faults);
        covers.push(cover);
    }
    for (index, cover) in covers.iter().enumerate() {
        check_area(cover, plate, faults);
        for other in covers[..index]
            .iter()
            .filter(|other| other.face == cover.face)
        {
            check_pair(other, cover, plate, faults);
        }
    }
}

fn check_layer(key: &str, layer: &Layer, faults: &mut ValidationFaults) {
    check_section(key, layer.section, faults);
    check_poisson_ratio(key, layer.youngs_modulus_pa, layer.poisson_ratio(), faults);
}

fn check_patch(key: &str, patch: &Patch, faults: &mut ValidationFaults) {
    check_section(key, patch.section, faults);
    // A missing material, modulus or porous composite has its own fault.
    if patch.youngs_modulus_pa.is_nan() || patch.pores.porosity.is_some() {
        return;
    }
    let constants = [
        ("poisson_ratio", patch.poisson_ratio()),
        ("transverse_youngs_modulus", patch.transverse_modulus_pa()),
        ("shear_modulus", patch.shear_modulus_pa()),
        ("d32", patch.transverse_coefficient_m_per_v()),
    ];
    let is_ceramic = !patch.is_fibre_composite();
    // Of a ceramic, `d32` follows from `d31`, which has its own fault.
    let missing: Vec<String> = constants
        .iter()
        .filter(|(name, value)| value.is_none() && !(is_ceramic && *name == "d32"))
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    if is_ceramic && patch.across.youngs_modulus_pa.is_none() {
        check_poisson_ratio(key, patch.youngs_modulus_pa, patch.poisson_ratio(), faults);
    } else if !missing.is_empty() {
        let kind = if is_ceramic {
            "a patch with `transverse_youngs_modulus`"
        } else {
            "a fibre composite on a plate"
        };
        let [verb, object] = if missing.len() == 1 {
            ["is", "it"]
        } else {
            ["are", "them"]
        };
        let text = || {
            format!(
                "{} {verb} missing; {kind} has other constants across x than along x, and no library material supplies {object}; take {object} from the data sheet or from a homogenisation of the composite",
                missing.join(", ")
            )
        };
        faults.push(|| key.to_owned(), text);
    }
    check_contraction(key, patch, faults);
}

/// A lamina is stable where `nu12 nu21 < 1`.
fn check_contraction(key: &str, patch: &Patch, faults: &mut ValidationFaults) {
    let lamina = patch.lamina();
    if lamina.contraction_product() >= 1.0 {
        let most = (lamina.youngs_modulus_pa[0] / lamina.youngs_modulus_pa[1]).sqrt();
        let text = || {
            format!(
                "is {}; it must be below {most:.4}, the square root of youngs_modulus / transverse_youngs_modulus, or the layer is unstable",
                lamina.poisson_ratio
            )
        };
        faults.push(|| format!("{key}.poisson_ratio"), text);
    }
}

fn check_section(key: &str, section: Section, faults: &mut ValidationFaults) {
    if section != Section::Laminate {
        let text = || "is a section of beams; on a plate use \"laminate\"".to_owned();
        faults.push(|| format!("{key}.section"), text);
    }
}

/// A missing material or modulus has its own fault.
fn check_poisson_ratio(
    key: &str,
    youngs_modulus_pa: f64,
    poisson_ratio: Option<f64>,
    faults: &mut ValidationFaults,
) {
    if poisson_ratio.is_none() && !youngs_modulus_pa.is_nan() {
        let text = || {
            "`poisson_ratio` is missing; a plate needs it; expected a plain number such as 0.3, or a `material` that has it".to_owned()
        };
        faults.push(|| key.to_owned(), text);
    }
}

fn check_area(cover: &Cover, plate: &Plate, faults: &mut ValidationFaults) {
    let sides = [
        ("length", cover.area.x_m, plate.length_m, "x", "length"),
        ("width", cover.area.y_m, plate.width_m, "y", "width"),
    ];
    for (key, range, side_m, axis, side) in sides {
        let slack_m = LENGTH_ROUNDOFF * side_m;
        if range[0] < -slack_m || range[1] > side_m + slack_m {
            let [from, to] = range.map(metres);
            let text = || {
                format!(
                    "the patch or layer covers {axis} = {from} to {to}; it must lie within the plate {side} {}",
                    metres(side_m)
                )
            };
            faults.push(|| format!("{}.{key}", cover.key), text);
        }
    }
}

/// Layers of one face do not overlap, nor do patches; a patch lies on one layer or next to it.
fn check_pair(first: &Cover, second: &Cover, plate: &Plate, faults: &mut ValidationFaults) {
    let slack_m = LENGTH_ROUNDOFF * plate.length_m.max(plate.width_m);
    if !first.area.meets(&second.area, slack_m) {
        return;
    }
    let same = first.is_layer == second.is_layer;
    if !same && first.area.contains(&second.area, slack_m) {
        return;
    }
    let text = || {
        let [x, y] = [first.area.x_m, first.area.y_m].map(|range| range.map(metres));
        let place = format!(
            "{} covers x = {} to {}, y = {} to {} of the same face",
            first.key, x[0], x[1], y[0], y[1]
        );
        if same {
            format!("{place}; move or shorten one of them")
        } else {
            format!(
                "{place}, under a part of this patch only; extend the layer under the complete patch, or end it next to the patch"
            )
        }
    };
    faults.push(|| format!("{}.start", second.key), text);
}

/// A position across the width has no effect on a beam.
fn check_beam_covers(spec: &Spec, faults: &mut ValidationFaults) {
    let layers = spec.layer.iter();
    let layers = layers.map(|(name, layer)| ("layer", name, &layer.on, layer.on_plate));
    let patches = spec.patch.iter();
    let patches = patches.map(|(name, patch)| ("patch", name, &patch.on, patch.on_plate));
    for (kind, name, on, on_plate) in layers.chain(patches) {
        if on_plate.across_start_m.is_some() && spec.beam.contains_key(on) {
            let text =
                || "has no effect on a beam; omit it, or give `on` the name of a plate".to_owned();
            faults.push(|| format!("{kind}.{name}.across_start"), text);
        }
    }
}

/// A mass on a plate is fixed to it, and carries nothing.
fn check_masses(spec: &Spec, faults: &mut ValidationFaults) {
    let on_plates: BTreeSet<&str> = spec
        .mass
        .iter()
        .filter(|(_, mass)| spec.plate_point(&mass.on).is_some())
        .map(|(name, _)| name.as_str())
        .collect();
    for name in &on_plates {
        if spec.mass[*name].rotary_inertia_kg_m2 > 0.0 {
            let text = || {
                "does not apply on a plate, whose slope under a moment at a point is unbounded; omit it, or add a [layer.NAME] with the mass".to_owned()
            };
            faults.push(|| format!("mass.{name}.rotary_inertia"), text);
        }
        if spec.mass[*name].stiffness_n_m.is_some() {
            let text = || {
                "is a point of a plate, which carries only fixed masses; omit the spring, or put the mass on a beam".to_owned()
            };
            faults.push(|| format!("mass.{name}.on"), text);
        }
    }
    let masses = spec.mass.iter();
    let masses = masses.map(|(name, mass)| (format!("mass.{name}.on"), &mass.on));
    let beams = spec.beam.iter();
    let beams = beams.map(|(name, beam)| (format!("beam.{name}.root"), &beam.root));
    for (key, support) in masses.chain(beams) {
        if on_plates.contains(support.as_str()) {
            let text = || {
                format!(
                    "is mass \"{}\" on a plate, which carries nothing; put both on points of the plate, or on a beam",
                    clip(support)
                )
            };
            faults.push(|| key, text);
        }
    }
}
