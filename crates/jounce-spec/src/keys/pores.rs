//! `[patch.NAME]`: getters and setters of the pores.

use crate::material::porous::PorosityScheme;
use crate::{Patch, PoreShape};

pub(super) const SHAPES: &[&str] = &["spheres", "spheroids", "cylinders"];
pub(super) const SCHEMES: &[&str] = &["mori-tanaka", "self-consistent"];

/// Changes the pores, and with them the effective properties of the patch.
pub(super) fn set(patch: &mut Patch, change: impl FnOnce(&mut Patch)) {
    change(patch);
    if patch.pores.porosity.is_none() {
        return;
    }
    patch.pores.composite = patch.pores.composite_of(&patch.material);
    let Some(composite) = patch.pores.composite else {
        return;
    };
    (patch.youngs_modulus_pa, patch.density_kg_m3) =
        (composite.youngs_modulus_pa, composite.density_kg_m3);
    (patch.d31_m_per_v, patch.permittivity_f_m) = (
        Some(composite.d31_m_per_v),
        Some(composite.permittivity_f_m),
    );
}

pub(super) fn shape_word(shape: PoreShape) -> &'static str {
    match shape {
        PoreShape::Spheres => "spheres",
        PoreShape::Spheroids => "spheroids",
        PoreShape::Cylinders => "cylinders",
    }
}

pub(super) fn shape_of(word: &str) -> PoreShape {
    match word {
        "spheroids" => PoreShape::Spheroids,
        "cylinders" => PoreShape::Cylinders,
        _ => PoreShape::Spheres,
    }
}

pub(super) fn scheme_word(scheme: PorosityScheme) -> &'static str {
    match scheme {
        PorosityScheme::MoriTanaka => "mori-tanaka",
        PorosityScheme::SelfConsistent => "self-consistent",
    }
}

pub(super) fn scheme_of(word: &str) -> PorosityScheme {
    if word == "self-consistent" {
        PorosityScheme::SelfConsistent
    } else {
        PorosityScheme::MoriTanaka
    }
}
