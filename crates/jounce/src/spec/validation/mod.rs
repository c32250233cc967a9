//! Rules between keys: references, geometry, lengths of lists, counts.
//!
//! Every rule looks at a typed spec that may have holes where values are missing or wrong: a hole (NaN, an empty text, an empty
//! list) breaks no rule, because its own fault is told already.

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

/// The key of the fault that there is nothing to simulate.
pub(super) const NO_STRUCTURE: &str = "spec";

/// Collects what is broken: dotted key and what is wrong with it.
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

/// Every rule that a spec breaks: dotted key and message.
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

/// The first rule that a spec breaks.
pub(super) fn first(spec: &Spec) -> Option<(String, String)> {
    broken(spec).into_iter().next()
}
