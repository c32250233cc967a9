//! `[layer.NAME]`

use super::patch::section_word;
use super::plate::POISSON;
use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::material;
use crate::{Face, Layer, OnPlate, Quantity, Section};

impl Keyed for Layer {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            on: String::new(),
            face: Face::default(),
            material: String::new(),
            start_m: 0.0,
            length_m: f64::NAN,
            width_m: f64::NAN,
            thickness_m: f64::NAN,
            youngs_modulus_pa: f64::NAN,
            density_kg_m3: 0.0,
            section: Section::default(),
            on_plate: OnPlate::default(),
        }
    }
}

static KEYS: &[Key<Layer>] = &[
    Key::text(
        "on",
        Kind::Reference { what: "a beam or a plate" },
        "beam or plate that carries the layer",
        |l: &Layer| l.on.clone(),
        |l, x| x.clone_into(&mut l.on),
    ),
    Key::text(
        "face",
        Kind::Choice(&["top", "bottom"]),
        "face of the beam or plate; a patch on the same face lies on top of the layer and must lie within it",
        |l: &Layer| if l.face == Face::Top { "top" } else { "bottom" }.to_owned(),
        |l, x| l.face = if x == "top" { Face::Top } else { Face::Bottom },
    )
    .optional(),
    Key::text(
        "material",
        Kind::Choice(material::STRUCTURAL),
        "library material (see `jounce materials`): default modulus and density",
        |l: &Layer| l.material.clone(),
        |l, x| {
            x.clone_into(&mut l.material);
            if let Some(known) = material::named(x) {
                (l.youngs_modulus_pa, l.density_kg_m3) = (known.youngs_modulus_pa, known.density_kg_m3);
            }
        },
    )
    .optional(),
    Key::text(
        "section",
        Kind::Choice(&["laminate", "thin-skin"]),
        "section model, as for a patch; patches and layers that overlap must have the same model",
        |l: &Layer| section_word(l.section).to_owned(),
        |l, x| l.section = if x == "thin-skin" { Section::ThinSkin } else { Section::Laminate },
    )
    .optional(),
    Key::quantity("start", Quantity::Length, "distance from the root of the beam, or the left edge of the plate, to the layer", |l: &Layer| l.start_m, |l, x| l.start_m = x)
        .within(Range::NOT_NEGATIVE)
        .optional(),
    Key::quantity("length", Quantity::Length, "length along the beam, or along x of the plate", |l: &Layer| l.length_m, |l, x| l.length_m = x)
        .within(Range::POSITIVE),
    Key::quantity("width", Quantity::Length, "width", |l: &Layer| l.width_m, |l, x| l.width_m = x).within(Range::POSITIVE),
    Key::quantity("thickness", Quantity::Length, "thickness", |l: &Layer| l.thickness_m, |l, x| l.thickness_m = x).within(Range::POSITIVE),
    Key::quantity("youngs_modulus", Quantity::Pressure, "Young's modulus", |l: &Layer| l.youngs_modulus_pa, |l, x| l.youngs_modulus_pa = x)
        .within(Range::POSITIVE)
        .unless("material"),
    Key::quantity("density", Quantity::Density, "density", |l: &Layer| l.density_kg_m3, |l, x| l.density_kg_m3 = x)
        .within(Range::POSITIVE)
        .when("section", &["laminate"])
        .unless("material"),
    Key::quantity("density", Quantity::Density, "not used by `thin-skin`", |l: &Layer| l.density_kg_m3, |l, x| l.density_kg_m3 = x)
        .within(Range::NOT_NEGATIVE)
        .when("section", &["thin-skin"])
        .optional(),
    Key::with_slot(
        "across_start",
        Kind::Quantity(Quantity::Length),
        "distance from the front edge of the plate to the layer; centred on the width if omitted",
        Slot::Optional { get: |l: &Layer| l.on_plate.across_start_m, set: |l, x| l.on_plate.across_start_m = Some(x) },
    )
    .within(Range::NOT_NEGATIVE)
    .optional(),
    Key::with_slot(
        "poisson_ratio",
        Kind::Number,
        "Poisson's ratio in the plane of the plate; that of the material if omitted; not used on a beam",
        Slot::Optional { get: |l: &Layer| l.on_plate.poisson_ratio, set: |l, x| l.on_plate.poisson_ratio = Some(x) },
    )
    .within(POISSON)
    .optional(),
];
