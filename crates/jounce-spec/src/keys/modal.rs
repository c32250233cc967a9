//! `[modal.NAME]`

use std::collections::BTreeMap;

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::{Electrodes, Modal, ModalPatch, Quantity};

use super::{FREQUENCY_LIMITS_HZ, electrodes};

impl Keyed for Modal {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            frequency_hz: Vec::new(),
            damping_ratio: Vec::new(),
            participation_sqrt_kg: Vec::new(),
            point: BTreeMap::new(),
            patch: BTreeMap::new(),
        }
    }
}

impl Keyed for ModalPatch {
    const KEYS: &'static [Key<Self>] = PATCH_KEYS;

    fn blank() -> Self {
        Self {
            coupling_n_per_v: Vec::new(),
            capacitance_f: f64::NAN,
            leakage_ohm: None,
            electrodes: Electrodes::default(),
        }
    }
}

static KEYS: &[Key<Modal>] = &[
    Key::with_slot(
        "frequency_hz",
        Kind::Numbers,
        "undamped short-circuit frequencies in Hz, ascending; 0 for a rigid-body mode",
        Slot::Numbers { get: |m: &Modal| &m.frequency_hz, open: |m| &mut m.frequency_hz },
    )
    .within(Range::from(0.0, FREQUENCY_LIMITS_HZ.1)),
    Key::with_slot(
        "damping_ratio",
        Kind::Numbers,
        "damping ratios, one per mode",
        Slot::Numbers { get: |m: &Modal| &m.damping_ratio, open: |m| &mut m.damping_ratio },
    )
    .within(Range::from(0.0, 10.0)),
    Key::with_slot(
        "participation_sqrt_kg",
        Kind::Numbers,
        "base participation: mass times mass-normalised shape, summed over the structure, in kg^1/2, one per mode; required if the base accelerates",
        Slot::Numbers { get: |m: &Modal| &m.participation_sqrt_kg, open: |m| &mut m.participation_sqrt_kg },
    )
    .optional(),
    Key::with_slot(
        "point",
        Kind::NamedNumbers,
        "mass-normalised shape at each named point in kg^-1/2, one number per mode",
        Slot::NamedNumbers { get: |m: &Modal| &m.point, open: |m| &mut m.point },
    )
    .optional(),
    Key::with_slot(
        "patch",
        Kind::Things,
        "piezoelectric patches of the structure, `[modal.NAME.patch.PATCH]`",
        Slot::Things { get: |m: &Modal| &m.patch, open: |m| &mut m.patch },
    )
    .optional(),
];

static PATCH_KEYS: &[Key<ModalPatch>] = &[
    Key::with_slot(
        "coupling_n_per_v",
        Kind::Numbers,
        "modal coupling in N/V per unit modal coordinate, one number per mode",
        Slot::Numbers {
            get: |p: &ModalPatch| &p.coupling_n_per_v,
            open: |p| &mut p.coupling_n_per_v,
        },
    ),
    Key::quantity(
        "capacitance",
        Quantity::Capacitance,
        "clamped capacitance",
        |p: &ModalPatch| p.capacitance_f,
        |p, x| p.capacitance_f = x,
    )
    .within(Range::POSITIVE),
    Key::text(
        "electrodes",
        Kind::Choice(electrodes::WORDS),
        electrodes::DOC,
        |p: &ModalPatch| electrodes::word(p.electrodes).to_owned(),
        |p, x| p.electrodes = electrodes::of(x),
    )
    .optional(),
    Key::with_slot(
        "leakage_resistance",
        Kind::Quantity(Quantity::Resistance),
        "leakage resistance across the clamped capacitance",
        Slot::Optional {
            get: |p: &ModalPatch| p.leakage_ohm,
            set: |p, x| p.leakage_ohm = Some(x),
        },
    )
    .within(Range::POSITIVE)
    .optional(),
];
