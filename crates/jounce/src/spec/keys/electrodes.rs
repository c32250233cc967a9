//! `electrodes` of a patch

use crate::spec::Electrodes;

pub(super) const WORDS: &[&str] = &["circuit", "open"];
pub(super) const DOC: &str = "where its charge goes: into the circuit that names it, or nowhere";

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
