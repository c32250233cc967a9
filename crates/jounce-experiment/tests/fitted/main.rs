//! Fits that must recover the keys from which the data were computed.

mod cantilever;
mod coverage;
mod dampings;
mod histories;
mod jumps;
mod powers;
mod responses;

use jounce_control::Control;
use jounce_experiment::fit::{Deviation, Features, FitResult, fit};
use jounce_signal::RandomStream;
use jounce_spec::{Spec, SpecFile};
use std::path::Path;

/// A small harvester with a patch and a load.
pub const HARVESTER: &str = include_str!("harvester.toml");

/// Spec file with keys changed.
pub fn spec(text: &str, set: &[(&str, &str)]) -> (SpecFile, Spec) {
    let mut file = SpecFile::from_text(text);
    set.iter().for_each(|(key, value)| {
        file.set(key, value)
            .unwrap_or_else(|fault| panic!("{fault}"))
    });
    let spec = file.spec().unwrap_or_else(|faults| panic!("{faults}"));
    (file, spec)
}

/// Fits the harvester to features, and compares every free key with its true value. The error must
/// be within four stated deviations and, relative, within `max_error`.
pub fn fit_and_compare(
    text: &str,
    features: &Features,
    truth: &[f64],
    max_error: f64,
) -> FitResult {
    let (file, spec) = spec(text, &[]);
    let (result, _) = fit(&file, &spec, features, Path::new("."), &Control::default())
        .unwrap_or_else(|fault| panic!("{fault}"));
    for (key, truth) in result.keys.iter().zip(truth) {
        let error = key.after / truth - 1.0;
        eprintln!(
            "{}: {:.2e} off before, {error:.2e} after, {:.2} of its deviations; {} evaluations",
            key.key,
            key.before / truth - 1.0,
            error / key.deviation,
            result.evaluations
        );
        assert!(
            error.abs() < max_error && error.abs() < 4.0 * key.deviation,
            "{key:?} {truth}"
        );
        assert!(key.deviation < 0.5 * key.prior_deviation, "{key:?}");
    }
    result
}

/// Adds noise of a relative deviation to numbers.
pub fn with_noise(values: &[f64], deviation: f64, seed: u64) -> Vec<f64> {
    let mut stream = RandomStream::new(seed, 0);
    values
        .iter()
        .map(|value| value * (deviation * stream.normal_pair()[0]).exp())
        .collect()
}

/// Free keys.
pub fn free_keys(keys: &[(&str, f64)]) -> Vec<(String, f64)> {
    keys.iter()
        .map(|(key, deviation)| ((*key).to_owned(), *deviation))
        .collect()
}

/// A known deviation.
pub const fn relative_deviation(deviation: f64) -> Deviation {
    Deviation::Given(deviation)
}
