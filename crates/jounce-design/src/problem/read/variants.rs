//! Specs of all combinations of choices.

use super::free::span_of;
use crate::problem::{Choice, ChoiceIndex, Condition, FreeKey, FreeValues};
use jounce_analysis::study::FaultCollector;
use jounce_spec::{Spec, SpecFile};
use toml_edit::Table;

/// Largest number of combinations of choices.
const MAX_VARIANTS: usize = 1000;

/// Returns the spec of each combination of choices. A range of a choice has its smaller end.
pub(super) fn variants(
    reader: &mut FaultCollector,
    root: &Table,
    free: &[FreeKey],
    file: &SpecFile,
) -> Vec<SpecFile> {
    let mut variants = vec![file.clone()];
    for (index, key) in free.iter().enumerate() {
        let FreeValues::Choice(choices) = &key.values else {
            continue;
        };
        let span = span_of(root, &key.path);
        if variants.len() * choices.len() > MAX_VARIANTS {
            let message = format!("free: the choices have more than {MAX_VARIANTS} combinations");
            reader.fault(&key.path, span, message);
            return variants;
        }
        let mut combined = Vec::with_capacity(variants.len() * choices.len());
        let mut messages = Vec::new();
        for (number, choice) in choices.iter().enumerate() {
            let with = ChoiceIndex {
                free: index,
                choice: number,
            };
            let settings = settings(free, choice, with);
            for variant in &variants {
                let (variant, faults) = changed(variant, &settings);
                let text = choice.text(&key.path);
                let faults = faults.into_iter();
                messages.extend(faults.map(|fault| format!("free.{}, {text}: {fault}", key.path)));
                combined.push(variant);
            }
        }
        messages.dedup();
        for message in messages {
            reader.fault(&key.path, span.clone(), message);
        }
        variants = combined;
    }
    variants
}

/// Returns the values of a choice, with the smaller ends of its ranges.
fn settings(free: &[FreeKey], choice: &Choice, with: ChoiceIndex) -> Vec<(String, String)> {
    let mut all = choice.values.clone();
    for key in free.iter().filter(|key| key.with == Some(with)) {
        if let FreeValues::Range(range) = &key.values {
            all.push((key.path.clone(), range.low_text()));
        }
    }
    all
}

/// Returns a spec with other values, and its faults.
fn changed(file: &SpecFile, settings: &[(String, String)]) -> (SpecFile, Vec<String>) {
    let mut changed = file.clone();
    for (path, value) in settings {
        if let Err(fault) = changed.set(path, value) {
            return (changed, vec![fault.message]);
        }
    }
    let faults = changed.spec().err();
    let faults = faults.map_or_else(Vec::new, |faults| {
        let all = faults.as_slice().iter();
        all.map(|fault| fault.message.clone()).collect()
    });
    (changed, faults)
}

/// Checks that the spec of a combination of choices has all ranges and the keys of all conditions.
pub(super) fn check_keys(
    reader: &mut FaultCollector,
    root: &Table,
    free: &[FreeKey],
    conditions: &[&Condition],
    (spec, choices): (&Spec, &str),
) {
    for key in free.iter().filter(|key| key.with.is_none()) {
        if let FreeValues::Range(range) = &key.values
            && range.key.get(spec).is_err()
        {
            let message = format!(
                "free.{0}: there is no such key with {choices}; write its range into the choices that have the key, as in [{{ ..., {1} = \"FROM:TO\" }}, ...]",
                key.path,
                key.path.rsplit('.').next().unwrap_or_default()
            );
            reader.fault(&key.path, span_of(root, &key.path), message);
        }
    }
    let of_conditions = conditions.iter().flat_map(|condition| &condition.values);
    for (key, _) in of_conditions.filter(|(key, _)| key.get(spec).is_err()) {
        let message = format!("conditions: there is no {} with {choices}", key.path());
        reader.fault("conditions", None, message);
    }
}
