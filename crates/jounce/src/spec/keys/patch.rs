//! `[patch.NAME]`

use crate::spec::key::{Key, Kind, Range};
use crate::spec::{Patch, Quantity, Section};

pub(super) fn blank() -> Patch {
    Patch {
        on: String::new(),
        start_m: f64::NAN,
        length_m: f64::NAN,
        width_m: f64::NAN,
        thickness_m: f64::NAN,
        youngs_modulus_pa: f64::NAN,
        density_kg_m3: 0.0,
        d31_m_per_v: f64::NAN,
        capacitance_f: f64::NAN,
        section: Section::default(),
    }
}

pub(super) static KEYS: &[Key<Patch>] = &[
    Key::text(
        "on",
        Kind::Reference { what: "a beam" },
        "the beam that carries it",
        |p: &Patch| p.on.clone(),
        |p, x| x.clone_into(&mut p.on),
    ),
    Key::text(
        "section",
        Kind::Choice(&["laminate", "thin-skin"]),
        "how it changes the section: full section about the shifted neutral axis with its mass, or a massless thin skin",
        |p: &Patch| section_word(p.section).to_owned(),
        |p, x| p.section = if x == "thin-skin" { Section::ThinSkin } else { Section::Laminate },
    )
    .optional(),
    Key::quantity("start", Quantity::Length, "from the root of the beam to the patch", |p: &Patch| p.start_m, |p, x| p.start_m = x)
        .within(Range::NOT_NEGATIVE),
    Key::quantity("length", Quantity::Length, "length along the beam", |p: &Patch| p.length_m, |p, x| p.length_m = x)
        .within(Range::POSITIVE),
    Key::quantity("width", Quantity::Length, "active width", |p: &Patch| p.width_m, |p, x| p.width_m = x).within(Range::POSITIVE),
    Key::quantity("thickness", Quantity::Length, "thickness", |p: &Patch| p.thickness_m, |p, x| p.thickness_m = x).within(Range::POSITIVE),
    Key::quantity(
        "youngs_modulus",
        Quantity::Pressure,
        "Young's modulus at short circuit",
        |p: &Patch| p.youngs_modulus_pa,
        |p, x| p.youngs_modulus_pa = x,
    )
    .within(Range::POSITIVE),
    Key::quantity("density", Quantity::Density, "mass per volume", |p: &Patch| p.density_kg_m3, |p, x| p.density_kg_m3 = x)
        .within(Range::POSITIVE)
        .when("section", &["laminate"]),
    Key::quantity("density", Quantity::Density, "not used by this section", |p: &Patch| p.density_kg_m3, |p, x| p.density_kg_m3 = x)
        .within(Range::NOT_NEGATIVE)
        .when("section", &["thin-skin"])
        .optional(),
    Key::quantity(
        "d31",
        Quantity::ChargePerForce,
        "piezoelectric charge coefficient, with its sign",
        |p: &Patch| p.d31_m_per_v,
        |p, x| p.d31_m_per_v = x,
    ),
    Key::quantity("capacitance", Quantity::Capacitance, "clamped capacitance", |p: &Patch| p.capacitance_f, |p, x| p.capacitance_f = x)
        .within(Range::POSITIVE),
];

fn section_word(section: Section) -> &'static str {
    match section {
        Section::ThinSkin => "thin-skin",
        Section::Laminate => "laminate",
    }
}
