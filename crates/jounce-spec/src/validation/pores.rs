//! Pores require a library material with a full set of constants, and exclude constants given for
//! the patch.

use super::ValidationFaults;
use crate::material;
use crate::nearest::clip;
use crate::{Patch, PatchPores, PoreShape, Spec};

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    for (name, patch) in &spec.patch {
        match patch.pores.porosity {
            // Reported already: spheroids without their aspect ratio.
            Some(_)
                if patch.pores.shape == PoreShape::Spheroids
                    && patch.pores.aspect_ratio.is_none() => {}
            Some(porosity) if (0.0..1.0).contains(&porosity) => {
                check_composite(name, patch, porosity, faults)
            }
            // Reported already: a value outside its range.
            Some(_) => {}
            None if patch.pores != PatchPores::default() => {
                let text = || {
                    "is missing; the shape of the pores and the scheme have no effect without it"
                        .to_owned()
                };
                faults.push(|| format!("patch.{name}.porosity"), text);
            }
            None => {}
        }
    }
}

fn check_composite(name: &str, patch: &Patch, porosity: f64, faults: &mut ValidationFaults) {
    let key = || format!("patch.{name}.porosity");
    if material::full_constants(&patch.material).is_none() {
        let known = material::LIBRARY
            .iter()
            .map(|material| material.name)
            .filter(|name| material::full_constants(name).is_some());
        let known = known
            .map(|name| format!("\"{name}\""))
            .collect::<Vec<_>>()
            .join(", ");
        let text = || {
            format!(
                "is given, but it requires all constants of the dense material; the library has them for {known}, not for \"{}\"",
                clip(&patch.material)
            )
        };
        return faults.push(key, text);
    }
    let Some(composite) = patch.pores.composite else {
        let text = || {
            format!(
                "is {porosity}, at which the scheme predicts no stiffness; lower it, or set porosity_scheme = \"mori-tanaka\""
            )
        };
        return faults.push(key, text);
    };
    let inputs = [
        (
            "youngs_modulus",
            patch.youngs_modulus_pa != composite.youngs_modulus_pa,
        ),
        ("density", patch.density_kg_m3 != composite.density_kg_m3),
        (
            "d31",
            patch
                .d31_m_per_v
                .is_some_and(|d31| d31 != composite.d31_m_per_v),
        ),
        ("d33", patch.d33_m_per_v.is_some()),
        ("d32", patch.across.d32_m_per_v.is_some()),
        ("poisson_ratio", patch.on_plate.poisson_ratio.is_some()),
        (
            "transverse_youngs_modulus",
            patch.across.youngs_modulus_pa.is_some(),
        ),
        ("shear_modulus", patch.across.shear_modulus_pa.is_some()),
        ("capacitance", patch.capacitance_f.is_some()),
        (
            "permittivity",
            patch
                .permittivity_f_m
                .is_some_and(|permittivity| permittivity != composite.permittivity_f_m),
        ),
    ];
    for (constant, _) in inputs.into_iter().filter(|(_, differs)| *differs) {
        let text = || {
            "does not apply with `porosity`, which sets all constants of the patch; omit one of the two".to_owned()
        };
        faults.push(|| format!("patch.{name}.{constant}"), text);
    }
}
