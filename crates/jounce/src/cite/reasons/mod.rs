//! Reasons of a spec to cite publications.

mod drives;
mod materials;
mod methods;
mod stops;
mod structure;

use jounce_spec::Spec;
use jounce_spec::bibliography::{Publication, publication};

/// Reasons, by publication, in the order in which they were first added.
#[derive(Debug, Default)]
pub(super) struct Reasons(Vec<(&'static Publication, Vec<String>)>);

impl Reasons {
    /// Adds a reason to cite the publication with a key. An unknown key adds nothing; a test
    /// excludes it for all keys of this module.
    fn add(&mut self, key: &str, reason: impl Into<String>) {
        let Some(publication) = publication(key) else {
            return;
        };
        let reason = reason.into();
        match self.0.iter_mut().find(|(known, _)| known.key == key) {
            Some((_, reasons)) if reasons.contains(&reason) => {}
            Some((_, reasons)) => reasons.push(reason),
            None => self.0.push((publication, vec![reason])),
        }
    }
}

/// Returns the publications that a spec uses, each with its reasons.
pub(super) fn of_publications(spec: &Spec) -> Vec<(&'static Publication, Vec<String>)> {
    let mut reasons = Reasons::default();
    for key in &spec.source.publications {
        reasons.add(key, "source of this harvester");
    }
    structure::add(spec, &mut reasons);
    materials::add(spec, &mut reasons);
    stops::add(spec, &mut reasons);
    drives::add(spec, &mut reasons);
    methods::add(spec, &mut reasons);
    reasons.0
}

/// Returns the reasons to cite the program.
pub(super) fn of_program(spec: &Spec) -> Vec<String> {
    let mut reasons = vec!["all results".to_owned()];
    if !spec.stop.is_empty() {
        reasons.push("proof of each step that no contact is missed".to_owned());
    }
    reasons
}
