//! `[beam.NAME]`

use std::collections::BTreeMap;

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::material;
use crate::{Beam, Quantity};

impl Keyed for Beam {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            material: String::new(),
            length_m: f64::NAN,
            width_m: f64::NAN,
            thickness_m: f64::NAN,
            youngs_modulus_pa: f64::NAN,
            density_kg_m3: f64::NAN,
            root: "ground".to_owned(),
            root_stiffness_n_m_rad: None,
            point: BTreeMap::new(),
        }
    }
}

static KEYS: &[Key<Beam>] = &[
    Key::text(
        "material",
        Kind::Choice(material::STRUCTURAL),
        "library material (see `jounce materials`): default modulus and density",
        |b: &Beam| b.material.clone(),
        |b, x| {
            x.clone_into(&mut b.material);
            if let Some(known) = material::named(x) {
                (b.youngs_modulus_pa, b.density_kg_m3) = (known.youngs_modulus_pa, known.density_kg_m3);
            }
        },
    )
    .optional(),
    Key::quantity("length", Quantity::Length, "distance from the clamped root to the free end", |b: &Beam| b.length_m, |b, x| b.length_m = x)
        .within(Range::POSITIVE),
    Key::quantity("width", Quantity::Length, "width of the rectangular section", |b: &Beam| b.width_m, |b, x| b.width_m = x)
        .within(Range::POSITIVE),
    Key::quantity("thickness", Quantity::Length, "thickness in the bending direction", |b: &Beam| b.thickness_m, |b, x| b.thickness_m = x)
        .within(Range::POSITIVE),
    Key::quantity("youngs_modulus", Quantity::Pressure, "Young's modulus", |b: &Beam| b.youngs_modulus_pa, |b, x| b.youngs_modulus_pa = x)
        .within(Range::POSITIVE)
        .unless("material"),
    Key::quantity("density", Quantity::Density, "density", |b: &Beam| b.density_kg_m3, |b, x| b.density_kg_m3 = x)
        .within(Range::POSITIVE)
        .unless("material"),
    Key::text(
        "root",
        Kind::Reference { what: "a mass or a point of another beam, or \"ground\" or another base" },
        "support of the clamped root: `\"ground\"` or another base, a mass, or a point of another beam such as `\"arm.end\"`",
        |b: &Beam| b.root.clone(),
        |b, x| x.clone_into(&mut b.root),
    )
    .optional(),
    Key::with_slot(
        "root_stiffness",
        Kind::Quantity(Quantity::RotaryStiffness),
        "rotary stiffness of the clamp at the root; if omitted, the clamp is rigid",
        Slot::Optional { get: |b: &Beam| b.root_stiffness_n_m_rad, set: |b, x| b.root_stiffness_n_m_rad = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::with_slot(
        "point",
        Kind::NamedQuantities(Quantity::Length),
        "distance of a named point from the root; `NAME.root` and `NAME.end` always exist",
        Slot::NamedQuantities { get: |b: &Beam| &b.point, open: |b| &mut b.point },
    )
    .within(Range::NOT_NEGATIVE)
    .optional(),
];
