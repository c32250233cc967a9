//! `[circuit.NAME]`

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::{Circuit, Interface, Quantity, Wiring};

const PATCHES: &[&str] = &["patch", "patches"];
const STORES: &[&str] = &["storage", "battery"];
const LOADS: &[&str] = &["resistance", "regulator"];
const INTERFACES: &[&str] = &["resistor", "bridge", "parallel-sshi", "series-sshi", "sece"];
const RECTIFIED: &[&str] = &["bridge", "parallel-sshi", "series-sshi", "sece"];
const WIRING: &[&str] = &["parallel", "series"];

impl Keyed for Circuit {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Circuit::resistor(String::new(), f64::NAN)
    }
}

static KEYS: &[Key<Circuit>] = &[
    Key::text(
        "patch",
        Kind::Reference { what: "a patch" },
        "patch that the circuit loads: `\"mfc\"`, or `\"harvester.mfc\"` in a modal structure",
        |c: &Circuit| c.patch.clone(),
        |c, x| x.clone_into(&mut c.patch),
    )
    .one_of(PATCHES),
    Key::with_slot(
        "patches",
        Kind::References { what: "patches" },
        "patches that share the circuit; `\"-NAME\"` reverses the polarity of a patch, as for the second face of a bimorph",
        Slot::Texts { get: |c: &Circuit| &c.patches, open: |c| &mut c.patches },
    )
    .one_of(PATCHES),
    Key::text(
        "wiring",
        Kind::Choice(WIRING),
        "connection of several patches",
        |c: &Circuit| word(c.wiring),
        |c, x| c.wiring = wiring(x),
    )
    .optional(),
    Key::text(
        "interface",
        Kind::Choice(INTERFACES),
        "circuit between the patches and the load, or the load itself",
        |c: &Circuit| INTERFACES[c.interface as usize].to_owned(),
        |c, x| c.interface = interface(x),
    )
    .optional(),
    Key::with_slot(
        "storage",
        Kind::Quantity(Quantity::Capacitance),
        "smoothing capacitor after the diodes, with the load across it",
        Slot::Optional { get: |c: &Circuit| c.storage_f, set: |c, x| c.storage_f = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", RECTIFIED)
    .one_of(STORES),
    Key::with_slot(
        "battery",
        Kind::Quantity(Quantity::Voltage),
        "voltage of a battery that replaces the capacitor and its load",
        Slot::Optional {
            get: |c: &Circuit| c.battery_v,
            set: |c, x| (c.battery_v, c.resistance_ohm) = (Some(x), f64::INFINITY),
        },
    )
    .within(Range::POSITIVE)
    .when("interface", RECTIFIED)
    .one_of(STORES),
    Key::quantity(
        "diode_drop",
        Quantity::Voltage,
        "forward voltage drop of each of the two diodes that conduct",
        |c: &Circuit| c.diode_drop_v,
        |c, x| c.diode_drop_v = x,
    )
    .within(Range::NOT_NEGATIVE)
    .when("interface", &["bridge", "parallel-sshi", "series-sshi"])
    .optional(),
    Key::quantity(
        "diode_resistance",
        Quantity::Resistance,
        "on-resistance of each diode",
        |c: &Circuit| c.diode_resistance_ohm,
        |c, x| c.diode_resistance_ohm = x,
    )
    .within(Range::POSITIVE)
    .when("interface", &["bridge", "parallel-sshi"])
    .optional(),
    Key::with_slot(
        "leakage_resistance",
        Kind::Quantity(Quantity::Resistance),
        "leakage resistance across the storage capacitor",
        Slot::Optional { get: |c: &Circuit| c.leakage_ohm, set: |c, x| c.leakage_ohm = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", RECTIFIED)
    .optional(),
    Key::with_slot(
        "quality_factor",
        Kind::Number,
        "quality factor Q of the inductor with its switch: an inversion multiplies the voltage by -exp(-pi / (2 Q))",
        Slot::Optional { get: |c: &Circuit| c.quality_factor, set: |c, x| c.quality_factor = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", &["parallel-sshi", "series-sshi"]),
    Key::number("efficiency", "efficiency: the part of the extracted energy that reaches the load", |c: &Circuit| c.efficiency, |c, x| c.efficiency = x)
        .within(Range { low: 0.0, open: true, high: 1.0 })
        .when("interface", &["sece"])
        .optional(),
    resistance().when("interface", &["resistor"]),
    resistance().when("interface", RECTIFIED).one_of(LOADS).unless("battery"),
    Key::text(
        "regulator",
        Kind::Reference { what: "a regulator" },
        "regulator that supplies a device from the storage capacitor, in place of the load resistance",
        |c: &Circuit| c.regulator.clone(),
        |c, x| {
            x.clone_into(&mut c.regulator);
            c.resistance_ohm = f64::INFINITY;
        },
    )
    .when("interface", RECTIFIED)
    .one_of(LOADS)
    .unless("battery"),
    Key::text(
        "device",
        Kind::Reference { what: "a device" },
        "device that the regulator supplies",
        |c: &Circuit| c.device.clone(),
        |c, x| x.clone_into(&mut c.device),
    )
    .when("interface", RECTIFIED)
    .optional(),
    Key::with_slot(
        "inductance",
        Kind::Quantity(Quantity::Inductance),
        "inductance of an inductor in addition to the resistor",
        Slot::Optional { get: |c: &Circuit| c.inductance_h, set: |c, x| c.inductance_h = Some(x) },
    )
    .within(Range::POSITIVE)
    .when("interface", &["resistor"])
    .optional(),
    Key::text(
        "inductor",
        Kind::Choice(WIRING),
        "connection of the inductor relative to the resistor",
        |c: &Circuit| word(c.inductor),
        |c, x| c.inductor = wiring(x),
    )
    .optional(),
];

const fn resistance() -> Key<Circuit> {
    Key::quantity(
        "resistance",
        Quantity::Resistance,
        "load resistance",
        |c: &Circuit| c.resistance_ohm,
        |c, x| c.resistance_ohm = x,
    )
    .within(Range::POSITIVE)
}

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
