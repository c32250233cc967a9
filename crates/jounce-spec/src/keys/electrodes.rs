//! `electrodes` of a patch

use crate::Electrodes;

pub(super) const WORDS: &[&str] = &["circuit", "open"];
pub(super) const DOC: &str =
    "connection of the electrodes: to the circuit that names the patch, or open circuit";

pub(super) fn word(electrodes: Electrodes) -> &'static str {
    match electrodes {
        Electrodes::Circuit => "circuit",
        Electrodes::Open => "open",
    }
}

pub(super) fn of(word: &str) -> Electrodes {
    if word == "open" {
        Electrodes::Open
    } else {
        Electrodes::Circuit
    }
}
