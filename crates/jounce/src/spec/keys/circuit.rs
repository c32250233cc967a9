//! `[circuit.NAME]`

use crate::spec::key::{Key, Kind, Range, Slot};
use crate::spec::{Circuit, Quantity, Wiring};

const PATCHES: &[&str] = &["patch", "patches"];
const WIRING: &[&str] = &["parallel", "series"];

pub(super) fn blank() -> Circuit {
    Circuit {
        patch: String::new(),
        patches: Vec::new(),
        wiring: Wiring::default(),
        resistance_ohm: f64::NAN,
        inductance_h: None,
        inductor: Wiring::default(),
    }
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
    Key::quantity(
        "resistance",
        Quantity::Resistance,
        "resistance of the load",
        |c: &Circuit| c.resistance_ohm,
        |c, x| c.resistance_ohm = x,
    )
    .within(Range::POSITIVE),
    Key::with_slot(
        "inductance",
        Kind::Quantity(Quantity::Inductance),
        "inductance of an inductor beside the resistor",
        Slot::Optional { get: |c: &Circuit| c.inductance_h, set: |c, x| c.inductance_h = Some(x) },
    )
    .within(Range::POSITIVE)
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

fn word(wiring: Wiring) -> String {
    WIRING[usize::from(wiring == Wiring::Series)].to_owned()
}

fn wiring(word: &str) -> Wiring {
    if word == "series" { Wiring::Series } else { Wiring::Parallel }
}
