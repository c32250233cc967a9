//! Rules between keys: references, geometry, lengths of lists, counts.
//!
//! Every rule reads a typed spec with holes (NaN, an empty text, an empty list) where values are
//! missing or wrong. A hole violates no rule, because its own fault is reported already.

mod circuit;
mod contact_bodies;
mod drives;
mod foils;
pub(crate) mod force_table;
mod geometry;
mod layers;
mod modes;
mod overlap;
mod plates;
mod pores;
mod reference;
mod regulators;
mod source;
mod support;

use super::Spec;
use super::fault::Faults;

/// Key of the fault that the spec has no structure.
pub(super) const NO_STRUCTURE: &str = "spec";

/// Collects violations: dotted key and message.
pub(super) struct ValidationFaults {
    found: Vec<(String, String)>,
}

impl ValidationFaults {
    fn push(&mut self, key: impl FnOnce() -> String, text: impl FnOnce() -> String) {
        if !self.is_full() {
            self.add(key(), text());
        }
    }

    fn add(&mut self, key: String, text: String) {
        let message = super::nearest::sentence(&key, &text);
        self.found.push((key, message));
    }

    fn is_full(&self) -> bool {
        self.found.len() >= Faults::MAX_FOUND
    }
}

/// Returns every rule that a spec violates: dotted key and message.
pub(super) fn broken(spec: &Spec) -> Vec<(String, String)> {
    let mut faults = ValidationFaults { found: Vec::new() };
    reference::check(spec, &mut faults);
    support::check(spec, &mut faults);
    circuit::check(spec, &mut faults);
    regulators::check(spec, &mut faults);
    geometry::check(spec, &mut faults);
    layers::check(spec, &mut faults);
    plates::check(spec, &mut faults);
    pores::check(spec, &mut faults);
    foils::check(spec, &mut faults);
    modes::check(spec, &mut faults);
    drives::check(spec, &mut faults);
    contact_bodies::check(spec, &mut faults);
    force_table::check(spec, &mut faults);
    overlap::check(spec, &mut faults);
    source::check(spec, &mut faults);
    faults.found
}

/// Returns the first rule that a spec violates.
pub(super) fn first(spec: &Spec) -> Option<(String, String)> {
    broken(spec).into_iter().next()
}
