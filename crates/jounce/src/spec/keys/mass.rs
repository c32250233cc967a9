//! `[mass.NAME]`
//!
//! The spring is kept as its stiffness: `k = m (2 pi f)^2`, m in kg, f in Hz, k in N/m.

use std::f64::consts::TAU;

use crate::spec::key::{Key, Range, Slot};
use crate::spec::{Mass, Quantity};

use super::FREQUENCY_LIMITS_HZ;
use crate::spec::key::Kind;

const SPRING: &[&str] = &["frequency", "stiffness"];

pub(super) fn blank() -> Mass {
    Mass { mass_kg: f64::NAN, stiffness_n_m: f64::NAN, damping_ratio: f64::NAN }
}

pub(super) static KEYS: &[Key<Mass>] = &[
    Key::quantity("mass", Quantity::Mass, "its mass, without what it carries", |m: &Mass| m.mass_kg, |m, x| m.mass_kg = x)
        .within(Range::POSITIVE),
    Key::with_slot(
        "frequency",
        Kind::Quantity(Quantity::Frequency),
        "natural frequency of the mass alone on its spring",
        Slot::Derived {
            get: |m: &Mass| (m.stiffness_n_m / m.mass_kg).sqrt() / TAU,
            set: |m, frequency_hz| m.stiffness_n_m = m.mass_kg * (TAU * frequency_hz).powi(2),
        },
    )
    .within(Range::from(FREQUENCY_LIMITS_HZ.0, FREQUENCY_LIMITS_HZ.1))
    .one_of(SPRING),
    Key::quantity("stiffness", Quantity::Stiffness, "stiffness of its spring", |m: &Mass| m.stiffness_n_m, |m, x| m.stiffness_n_m = x)
        .within(Range::POSITIVE)
        .one_of(SPRING),
    Key::number(
        "damping_ratio",
        "damping ratio of the coupled mode in which this mass moves most",
        |m: &Mass| m.damping_ratio,
        |m, x| m.damping_ratio = x,
    )
    .within(Range { low: 0.0, open: false, high: 10.0 }),
];
