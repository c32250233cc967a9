//! `[circuit.NAME]`

use crate::spec::key::{Key, Kind, Range};
use crate::spec::{Circuit, Quantity};

pub(super) fn blank() -> Circuit {
    Circuit { patch: String::new(), resistance_ohm: f64::NAN }
}

pub(super) static KEYS: &[Key<Circuit>] = &[
    Key::text(
        "patch",
        Kind::Reference { what: "a patch" },
        "the patch that it loads: `\"mfc\"`, or `\"harvester.mfc\"` of a modal structure",
        |c: &Circuit| c.patch.clone(),
        |c, x| x.clone_into(&mut c.patch),
    ),
    Key::quantity(
        "resistance",
        Quantity::Resistance,
        "resistance across the patch",
        |c: &Circuit| c.resistance_ohm,
        |c, x| c.resistance_ohm = x,
    )
    .within(Range::POSITIVE),
];
