//! `[patch.NAME]`

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::material;
use crate::{
    AcrossFibres, Electrodes, Face, OnPlate, Patch, PatchFoils, PatchPores, Quantity, Section,
};

use super::plate::POISSON;
use super::{electrodes, pores};

const COEFFICIENT: &[&str] = &["d31", "d33"];
const CAPACITANCE: &[&str] = &["capacitance", "permittivity"];

/// Largest strain limit; no piezoelectric material bears a hundredth of it. A larger one is a number
/// whose unit is missing.
const MAX_STRAIN_LIMIT: f64 = 0.1;

/// Largest magnitude of `d31` and `d33`, m/V: thirty times that of the strongest single crystals.
const MAX_COEFFICIENT: f64 = 1e-7;

/// Largest capacitance, F: a patch of a square metre of thin film has a hundredth of it.
const MAX_CAPACITANCE: f64 = 1.0;

impl Keyed for Patch {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            on: String::new(),
            face: Face::default(),
            material: String::new(),
            start_m: f64::NAN,
            length_m: f64::NAN,
            width_m: f64::NAN,
            thickness_m: f64::NAN,
            youngs_modulus_pa: f64::NAN,
            density_kg_m3: 0.0,
            d31_m_per_v: None,
            d33_m_per_v: None,
            electrode_spacing_m: None,
            capacitance_f: None,
            permittivity_f_m: None,
            strain_limit: None,
            leakage_ohm: None,
            electrodes: Electrodes::default(),
            section: Section::default(),
            pores: PatchPores::default(),
            foils: PatchFoils::default(),
            on_plate: OnPlate::default(),
            across: AcrossFibres::default(),
        }
    }
}

/// Takes the missing values from the library.
fn fill(patch: &mut Patch, name: &str) {
    name.clone_into(&mut patch.material);
    let Some(known) = material::named(name) else {
        return;
    };
    (
        patch.youngs_modulus_pa,
        patch.density_kg_m3,
        patch.strain_limit,
    ) = (
        known.youngs_modulus_pa,
        known.density_kg_m3,
        known.strain_limit,
    );
    if let Some(active) = known.active {
        patch.permittivity_f_m = Some(active.permittivity_f_m);
        match active.electrode_spacing_m {
            Some(spacing_m) => {
                (patch.d33_m_per_v, patch.electrode_spacing_m) =
                    (Some(active.charge_coefficient_m_per_v), Some(spacing_m))
            }
            None => patch.d31_m_per_v = Some(active.charge_coefficient_m_per_v),
        }
    }
}

static KEYS: &[Key<Patch>] = &[
    Key::text(
        "on",
        Kind::Reference { what: "a beam or a plate" },
        "beam or plate that carries the patch",
        |p: &Patch| p.on.clone(),
        |p, x| x.clone_into(&mut p.on),
    ),
    Key::text(
        "face",
        Kind::Choice(&["top", "bottom"]),
        "face of the beam or plate; two patches at the same position on the two faces form a bimorph",
        |p: &Patch| if p.face == Face::Top { "top" } else { "bottom" }.to_owned(),
        |p, x| p.face = if x == "top" { Face::Top } else { Face::Bottom },
    )
    .optional(),
    Key::text(
        "material",
        Kind::Choice(material::PIEZOELECTRIC),
        "library material (see `jounce materials`): default modulus, density, coefficient, permittivity and strain limit",
        |p: &Patch| p.material.clone(),
        fill,
    )
    .optional(),
    Key::text(
        "pore_shape",
        Kind::Choice(pores::SHAPES),
        "shape of the pores, which are aligned with the poling direction; with `porosity`",
        |p: &Patch| pores::shape_word(p.pores.shape).to_owned(),
        |p, x| pores::set(p, |p| p.pores.shape = pores::shape_of(x)),
    )
    .optional(),
    Key::with_slot(
        "pore_aspect_ratio",
        Kind::Number,
        "aspect ratio of the pores: length along the poling direction over width",
        Slot::Optional { get: |p: &Patch| p.pores.aspect_ratio, set: |p, x| pores::set(p, |p| p.pores.aspect_ratio = Some(x)) },
    )
    .within(Range { low: 1e-3, open: false, high: 1e3 })
    .when("pore_shape", &["spheroids"]),
    Key::text(
        "porosity_scheme",
        Kind::Choice(pores::SCHEMES),
        "homogenisation scheme: each pore in the mean field of the matrix, or each in the effective composite",
        |p: &Patch| pores::scheme_word(p.pores.scheme).to_owned(),
        |p, x| pores::set(p, |p| p.pores.scheme = pores::scheme_of(x)),
    )
    .optional(),
    Key::with_slot(
        "porosity",
        Kind::Number,
        "volume fraction of pores: modulus, density, coefficient and permittivity follow from it",
        Slot::Optional { get: |p: &Patch| p.pores.porosity, set: |p, x| pores::set(p, |p| p.pores.porosity = Some(x)) },
    )
    .within(Range { low: 0.0, open: false, high: 0.95 })
    .optional(),
    Key::text(
        "section",
        Kind::Choice(&["laminate", "thin-skin"]),
        "section model: full section about the shifted neutral axis with the mass of the patch, or a massless thin skin",
        |p: &Patch| section_word(p.section).to_owned(),
        |p, x| p.section = if x == "thin-skin" { Section::ThinSkin } else { Section::Laminate },
    )
    .optional(),
    Key::quantity("start", Quantity::Length, "distance from the root of the beam, or the left edge of the plate, to the patch", |p: &Patch| p.start_m, |p, x| p.start_m = x)
        .within(Range::NOT_NEGATIVE),
    Key::quantity("length", Quantity::Length, "length along the beam, or along x of the plate", |p: &Patch| p.length_m, |p, x| p.length_m = x)
        .within(Range::POSITIVE),
    Key::quantity("width", Quantity::Length, "active width", |p: &Patch| p.width_m, |p, x| p.width_m = x).within(Range::POSITIVE),
    Key::quantity(
        "thickness",
        Quantity::Length,
        "thickness; with `foil_thickness` that of the active layer alone",
        |p: &Patch| p.thickness_m,
        |p, x| p.thickness_m = x,
    )
    .within(Range::POSITIVE),
    Key::with_slot(
        "foil_thickness",
        Kind::Quantity(Quantity::Length),
        "thickness of each of the two foils that enclose the active layer of a Macro Fiber Composite",
        Slot::Optional { get: |p: &Patch| p.foils.thickness_m, set: |p, x| p.foils.thickness_m = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::with_slot(
        "foil_youngs_modulus",
        Kind::Quantity(Quantity::Pressure),
        "Young's modulus of the foils with their electrodes; 2.5 GPa (Kapton) if omitted",
        Slot::Optional { get: |p: &Patch| p.foils.youngs_modulus_pa, set: |p, x| p.foils.youngs_modulus_pa = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::with_slot(
        "foil_density",
        Kind::Quantity(Quantity::Density),
        "density of the foils; 1420 kg/m^3 (Kapton) if omitted",
        Slot::Optional { get: |p: &Patch| p.foils.density_kg_m3, set: |p, x| p.foils.density_kg_m3 = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::with_slot(
        "foil_poisson_ratio",
        Kind::Number,
        "Poisson's ratio of the foils on a plate; 0.34 (Kapton) if omitted; not used on a beam",
        Slot::Optional { get: |p: &Patch| p.foils.poisson_ratio, set: |p, x| p.foils.poisson_ratio = Some(x) },
    )
    .within(POISSON)
    .optional(),
    Key::quantity(
        "youngs_modulus",
        Quantity::Pressure,
        "Young's modulus at short circuit; of a fibre composite along the fibres, which lie along the beam or along x of the plate",
        |p: &Patch| p.youngs_modulus_pa,
        |p, x| p.youngs_modulus_pa = x,
    )
    .within(Range::POSITIVE)
    .unless("material"),
    Key::quantity("density", Quantity::Density, "density", |p: &Patch| p.density_kg_m3, |p, x| p.density_kg_m3 = x)
        .within(Range::POSITIVE)
        .when("section", &["laminate"])
        .unless("material"),
    Key::quantity("density", Quantity::Density, "not used by `thin-skin`", |p: &Patch| p.density_kg_m3, |p, x| p.density_kg_m3 = x)
        .within(Range::NOT_NEGATIVE)
        .when("section", &["thin-skin"])
        .optional(),
    Key::with_slot(
        "d31",
        Kind::Quantity(Quantity::ChargePerForce),
        "piezoelectric charge coefficient with its sign, for a field through the thickness",
        Slot::Optional {
            get: |p: &Patch| p.d31_m_per_v,
            set: |p, x| (p.d31_m_per_v, p.d33_m_per_v, p.electrode_spacing_m) = (Some(x), None, None),
        },
    )
    .within(Range::from(-MAX_COEFFICIENT, MAX_COEFFICIENT))
    .one_of(COEFFICIENT)
    .unless("material"),
    Key::with_slot(
        "d33",
        Kind::Quantity(Quantity::ChargePerForce),
        "piezoelectric charge coefficient with its sign, for a field along the beam or along x of the plate (interdigitated electrodes)",
        Slot::Optional { get: |p: &Patch| p.d33_m_per_v, set: |p, x| (p.d33_m_per_v, p.d31_m_per_v) = (Some(x), None) },
    )
    .within(Range::from(-MAX_COEFFICIENT, MAX_COEFFICIENT))
    .one_of(COEFFICIENT)
    .unless("material"),
    Key::with_slot(
        "electrode_spacing",
        Kind::Quantity(Quantity::Length),
        "distance between electrodes along the beam or along x of the plate; with `d33`",
        Slot::Optional { get: |p: &Patch| p.electrode_spacing_m, set: |p, x| p.electrode_spacing_m = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::with_slot(
        "d32",
        Kind::Quantity(Quantity::ChargePerForce),
        "strain along y of the plate per field, with its sign; required for a fibre composite on a plate; `d31` if omitted for a ceramic; not used on a beam",
        Slot::Optional { get: |p: &Patch| p.across.d32_m_per_v, set: |p, x| p.across.d32_m_per_v = Some(x) },
    )
    .optional(),
    Key::with_slot(
        "capacitance",
        Kind::Quantity(Quantity::Capacitance),
        "clamped capacitance",
        Slot::Optional { get: |p: &Patch| p.capacitance_f, set: |p, x| (p.capacitance_f, p.permittivity_f_m) = (Some(x), None) },
    )
    .within(Range::above(0.0, MAX_CAPACITANCE))
    .one_of(CAPACITANCE)
    .unless("material"),
    Key::with_slot(
        "permittivity",
        Kind::Quantity(Quantity::Permittivity),
        "permittivity at constant strain: the capacitance is `permittivity * width * length / thickness`",
        Slot::Optional { get: |p: &Patch| p.permittivity_f_m, set: |p, x| (p.permittivity_f_m, p.capacitance_f) = (Some(x), None) },
    )
    .within(Range::POSITIVE)
    .one_of(CAPACITANCE)
    .unless("material"),
    Key::text(
        "electrodes",
        Kind::Choice(electrodes::WORDS),
        electrodes::DOC,
        |p: &Patch| electrodes::word(p.electrodes).to_owned(),
        |p, x| p.electrodes = electrodes::of(x),
    )
    .optional(),
    Key::with_slot(
        "leakage_resistance",
        Kind::Quantity(Quantity::Resistance),
        "leakage resistance across the clamped capacitance",
        Slot::Optional { get: |p: &Patch| p.leakage_ohm, set: |p, x| p.leakage_ohm = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::with_slot(
        "strain_limit",
        Kind::NumberOr(Quantity::Strain),
        "strain limit; runs and orbits warn if the strain exceeds it: along the beam or the fibres, or for a ceramic on a plate the larger principal strain",
        Slot::Optional { get: |p: &Patch| p.strain_limit, set: |p, x| p.strain_limit = Some(x) },
    )
    .within(Range::above(0.0, MAX_STRAIN_LIMIT))
    .optional(),
    Key::with_slot(
        "across_start",
        Kind::Quantity(Quantity::Length),
        "distance from the front edge of the plate to the patch; centred on the width if omitted",
        Slot::Optional { get: |p: &Patch| p.on_plate.across_start_m, set: |p, x| p.on_plate.across_start_m = Some(x) },
    )
    .within(Range::NOT_NEGATIVE)
    .optional(),
    Key::with_slot(
        "poisson_ratio",
        Kind::Number,
        "Poisson's ratio in the plane of the plate at short circuit, for a fibre composite under a stress along the fibres; that of the material if omitted; not used on a beam",
        Slot::Optional { get: |p: &Patch| p.on_plate.poisson_ratio, set: |p, x| p.on_plate.poisson_ratio = Some(x) },
    )
    .within(POISSON)
    .optional(),
    Key::with_slot(
        "transverse_youngs_modulus",
        Kind::Quantity(Quantity::Pressure),
        "Young's modulus along y of the plate at short circuit; that of the material if omitted, `youngs_modulus` for a ceramic; not used on a beam",
        Slot::Optional { get: |p: &Patch| p.across.youngs_modulus_pa, set: |p, x| p.across.youngs_modulus_pa = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::with_slot(
        "shear_modulus",
        Kind::Quantity(Quantity::Pressure),
        "shear modulus in the plane of the plate; that of the material if omitted, of an isotropic ceramic `youngs_modulus / (2 + 2 poisson_ratio)`; not used on a beam",
        Slot::Optional { get: |p: &Patch| p.across.shear_modulus_pa, set: |p, x| p.across.shear_modulus_pa = Some(x) },
    )
    .within(Range::POSITIVE)
    .optional(),
];

pub(super) fn section_word(section: Section) -> &'static str {
    match section {
        Section::ThinSkin => "thin-skin",
        Section::Laminate => "laminate",
    }
}
