//! `[mass.NAME]`
//!
//! The spring is stored as its stiffness: `k = m (2 pi f)^2`, m in kg, f in Hz, k in N/m.

use std::f64::consts::TAU;

use crate::key::{Key, Keyed, Range, Slot};
use crate::{Mass, Quantity};

use super::FREQUENCY_LIMITS_HZ;
use crate::key::Kind;

const SPRING: &[&str] = &["frequency", "stiffness"];

impl Keyed for Mass {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            on: "ground".to_owned(),
            mass_kg: f64::NAN,
            rotary_inertia_kg_m2: 0.0,
            stiffness_n_m: None,
            damping_ratio: None,
            velocity_m_s: None,
            friction_n_s_m: None,
        }
    }
}

static KEYS: &[Key<Mass>] = &[
    Key::text(
        "on",
        Kind::Reference { what: "a mass or a point of a beam or a plate, or \"ground\", another base or \"nothing\"" },
        "support: `\"ground\"` or another base, a mass, a point of a beam or (without a spring) of a plate, or `\"nothing\"` for a free mass",
        |m: &Mass| m.on.clone(),
        |m, x| x.clone_into(&mut m.on),
    )
    .optional(),
    Key::quantity("mass", Quantity::Mass, "mass, without the parts that it carries", |m: &Mass| m.mass_kg, |m, x| m.mass_kg = x)
        .within(Range::POSITIVE),
    Key::quantity(
        "rotary_inertia",
        Quantity::RotaryInertia,
        "moment of inertia about the point of attachment; for a mass without a spring on a beam",
        |m: &Mass| m.rotary_inertia_kg_m2,
        |m, x| m.rotary_inertia_kg_m2 = x,
    )
    .within(Range::NOT_NEGATIVE)
    .optional(),
    Key::with_slot(
        "frequency",
        Kind::Quantity(Quantity::Frequency),
        "natural frequency of the mass alone on its spring; without a spring the mass is fixed to its support",
        Slot::Derived {
            get: |m: &Mass| (m.stiffness_n_m.unwrap_or(f64::NAN) / m.mass_kg).sqrt() / TAU,
            set: |m, frequency_hz| m.stiffness_n_m = Some(m.mass_kg * (TAU * frequency_hz).powi(2)),
        },
    )
    .within(Range::from(FREQUENCY_LIMITS_HZ.0, FREQUENCY_LIMITS_HZ.1))
    .at_most_one_of(SPRING),
    Key::with_slot(
        "stiffness",
        Kind::Quantity(Quantity::Stiffness),
        "stiffness of the spring; without a spring the mass is fixed to its support",
        Slot::Optional { get: |m: &Mass| m.stiffness_n_m, set: |m, x| m.stiffness_n_m = Some(x) },
    )
    .within(Range::POSITIVE)
    .at_most_one_of(SPRING),
    Key::with_slot(
        "damping_ratio",
        Kind::Number,
        "damping ratio of the coupled mode in which this mass moves most; required with a spring",
        Slot::Optional { get: |m: &Mass| m.damping_ratio, set: |m, x| m.damping_ratio = Some(x) },
    )
    .within(Range { low: 0.0, open: false, high: 10.0 })
    .optional(),
    Key::with_slot(
        "velocity",
        Kind::Quantity(Quantity::Speed),
        "velocity at the start of a run, added to that of `run.start`; for a free mass or a mass on a spring",
        Slot::Optional { get: |m: &Mass| m.velocity_m_s, set: |m, x| m.velocity_m_s = Some(x) },
    )
    .optional(),
    Key::with_slot(
        "friction",
        Kind::Quantity(Quantity::Damping),
        "viscous friction of a free mass on its channel, which moves with the ground: force over velocity",
        Slot::Optional { get: |m: &Mass| m.friction_n_s_m, set: |m, x| m.friction_n_s_m = Some(x) },
    )
    .within(Range::NOT_NEGATIVE)
    .optional(),
];
