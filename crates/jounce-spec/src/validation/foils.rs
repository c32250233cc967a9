//! Foils apply only to an active layer whose constants exclude them.

use super::ValidationFaults;
use crate::Spec;
use crate::model::FIBRE_COMPOSITE_PREFIX;
use crate::nearest::clip;

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    for (name, patch) in &spec.patch {
        let foils = &patch.foils;
        if foils.thickness_m.is_none() {
            let inputs = [
                ("foil_youngs_modulus", foils.youngs_modulus_pa),
                ("foil_density", foils.density_kg_m3),
                ("foil_poisson_ratio", foils.poisson_ratio),
            ];
            for (key, _) in inputs.into_iter().filter(|(_, value)| value.is_some()) {
                faults.push(
                    || format!("patch.{name}.{key}"),
                    || "has no effect without `foil_thickness`; give both, or omit both".to_owned(),
                );
            }
        } else if patch.material.starts_with(FIBRE_COMPOSITE_PREFIX) {
            let text = || {
                format!(
                    "does not apply to material \"{}\", whose library constants include the foils; give the constants of the active layer instead of `material`, or omit the foils",
                    clip(&patch.material)
                )
            };
            faults.push(|| format!("patch.{name}.foil_thickness"), text);
        }
    }
}
