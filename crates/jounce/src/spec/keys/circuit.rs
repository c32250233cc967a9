//! `[circuit.NAME]`

use crate::spec::key::{Key, Kind, Range, Slot};
use crate::spec::{Circuit, Interface, Quantity, Wiring};

const PATCHES: &[&str] = &["patch", "patches"];
const STORES: &[&str] = &["storage", "battery"];
const INTERFACES: &[&str] = &["resistor", "bridge", "parallel-sshi", "series-sshi", "sece"];
const RECTIFIED: &[&str] = &["bridge", "parallel-sshi", "series-sshi", "sece"];
const WIRING: &[&str] = &["parallel", "series"];

pub(super) fn blank() -> Circuit {
    Circuit::resistor(String::new(), f64::NAN)
}

pub(super) static KEYS: &[Key<Circuit>] = &[
    Key::text(
        "patch",
        Kind::Reference { what: "a patch" },
        "the patch that it loads: `\"mfc\"`, or `\"harvester.mfc\"` of a modal structure",
        |c: &Circuit| c.patch.clone(),
        |c, x| x.clone_into(&mut c.patch),
    )
    .one_of(PATCHES),
    Key::with_slot(
        "patches",
        Kind::References { what: "patches" },
        "several patches that share it; `\"-NAME\"` connects a patch the other way round, as the second face of a bimorph needs",
        Slot::Texts { get: |c: &Circuit| &c.patches, open: |c| &mut c.patches },
    )
    .one_of(PATCHES),
    Key::text(
        "wiring",
        Kind::Choice(WIRING),
        "how several patches are connected to each other",
        |c: &Circuit| word(c.wiring),
        |c, x| c.wiring = wiring(x),
    )
    .optional(),
    Key::text(
        "interface",
        Kind::Choice(INTERFACES),
        "what stands between the patches and what takes their energy",
        |c: &Circuit| INTERFACES[c.interface as usize].to_owned(),
        |c, x| c.interface = interface(x),
    )
    .optional(),
    Key::with_slot(
        "storage",
        Kind::Quantity(Quantity::Capacitance),
        "smoothing capacitor behind the diodes, with the load across it",
        Slot::Optional { get: |c: &Circuit| c.storage_f, set: |c, x| c.storage_f = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", RECTIFIED)
    .one_of(STORES),
    Key::with_slot(
        "battery",
        Kind::Quantity(Quantity::Voltage),
        "voltage of a battery that takes the charge instead of a capacitor with a load",
        Slot::Optional { get: |c: &Circuit| c.battery_v, set: |c, x| c.battery_v = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", RECTIFIED)
    .one_of(STORES),
    Key::quantity(
        "diode_drop",
        Quantity::Voltage,
        "forward drop of each of the two diodes of a path",
        |c: &Circuit| c.diode_drop_v,
        |c, x| c.diode_drop_v = x,
    )
    .within(Range::NOT_NEGATIVE)
    .when("interface", &["bridge", "parallel-sshi", "series-sshi"])
    .optional(),
    Key::quantity(
        "diode_resistance",
        Quantity::Resistance,
        "resistance of each of these diodes while it conducts",
        |c: &Circuit| c.diode_resistance_ohm,
        |c, x| c.diode_resistance_ohm = x,
    )
    .within(Range::POSITIVE)
    .when("interface", &["bridge", "parallel-sshi"])
    .optional(),
    Key::with_slot(
        "leakage_resistance",
        Kind::Quantity(Quantity::Resistance),
        "resistance across the storage capacitor through which it leaks",
        Slot::Optional { get: |c: &Circuit| c.leakage_ohm, set: |c, x| c.leakage_ohm = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", RECTIFIED)
    .optional(),
    Key::with_slot(
        "quality_factor",
        Kind::Number,
        "quality factor Q of the inductor with its switch: the voltage turns over to -exp(-pi / (2 Q)) of itself",
        Slot::Optional { get: |c: &Circuit| c.quality_factor, set: |c, x| c.quality_factor = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", &["parallel-sshi", "series-sshi"]),
    Key::number("efficiency", "share of the extracted energy that arrives", |c: &Circuit| c.efficiency, |c, x| c.efficiency = x)
        .within(Range { low: 0.0, open: true, high: 1.0 })
        .when("interface", &["sece"])
        .optional(),
    Key::quantity(
        "resistance",
        Quantity::Resistance,
        "resistance of the load",
        |c: &Circuit| c.resistance_ohm,
        |c, x| c.resistance_ohm = x,
    )
    .within(Range::POSITIVE)
    .unless("battery"),
    Key::with_slot(
        "inductance",
        Kind::Quantity(Quantity::Inductance),
        "inductance of an inductor beside the resistor",
        Slot::Optional { get: |c: &Circuit| c.inductance_h, set: |c, x| c.inductance_h = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", &["resistor"])
    .optional(),
    Key::text(
        "inductor",
        Kind::Choice(WIRING),
        "how the inductor stands to the resistor",
        |c: &Circuit| word(c.inductor),
        |c, x| c.inductor = wiring(x),
    )
    .optional(),
];

fn interface(word: &str) -> Interface {
    match word {
        "bridge" => Interface::Bridge,
        "parallel-sshi" => Interface::ParallelSshi,
        "series-sshi" => Interface::SeriesSshi,
        "sece" => Interface::Sece,
        _ => Interface::Resistor,
    }
}

fn word(wiring: Wiring) -> String {
    WIRING[usize::from(wiring == Wiring::Series)].to_owned()
}

fn wiring(word: &str) -> Wiring {
    if word == "series" {
        Wiring::Series
    } else {
        Wiring::Parallel
    }
}
