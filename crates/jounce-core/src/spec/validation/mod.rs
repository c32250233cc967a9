//! Rules between keys: references, geometry, lengths of lists, counts.
//!
//! Every rule reads a typed spec with holes (NaN, an empty text, an empty list) where values are
//! missing or wrong. A hole violates no rule, because its own fault is reported already.

mod circuit;
mod drives;
mod foils;
mod geometry;
mod layers;
mod modes;
mod overlap;
mod pores;
mod reference;
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
        if self.found.len() < Faults::MAX_REPORTED {
            let key = key();
            let message = super::nearest::sentence(&key, &text());
            self.found.push((key, message));
        }
    }

    fn is_full(&self) -> bool {
        self.found.len() >= Faults::MAX_REPORTED
    }
}

/// Returns every rule that a spec violates: dotted key and message.
pub(super) fn broken(spec: &Spec) -> Vec<(String, String)> {
    let mut broken = ValidationFaults { found: Vec::new() };
    reference::check(spec, &mut broken);
    support::check(spec, &mut broken);
    circuit::check(spec, &mut broken);
    geometry::check(spec, &mut broken);
    layers::check(spec, &mut broken);
    pores::check(spec, &mut broken);
    foils::check(spec, &mut broken);
    modes::check(spec, &mut broken);
    drives::check(spec, &mut broken);
    overlap::check(spec, &mut broken);
    broken.found
}

/// Returns the first rule that a spec violates.
pub(super) fn first(spec: &Spec) -> Option<(String, String)> {
    broken(spec).into_iter().next()
}
