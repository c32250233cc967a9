//! Options that continued curves share: range of a key, tolerance, seeds, longest period, levels.

use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::{check_tolerance, range_error};
use jounce_analysis::{BranchSearch, QuantityLevel};
use jounce_model::plant::Plant;
use jounce_spec::{KeyRange, NumericKey};

/// Reads `KEY=FROM:TO` of an option: the key, and the ends of its range, SI.
pub(crate) fn range(
    harvester: &Harvester,
    option: &'static str,
    text: &str,
) -> Result<(NumericKey, (f64, f64)), Error> {
    let invalid = |expected: &str| {
        let value = if text.is_empty() { "empty" } else { text };
        Error::option(option, value, expected)
    };
    let form = "write KEY=FROM:TO, as in drive.shaker.frequency=4Hz:20Hz";
    let (name, ends) = text.split_once('=').ok_or_else(|| invalid(form))?;
    let (from, to) = ends.split_once(':').ok_or_else(|| invalid(form))?;
    if let Some((to, _)) = to.split_once(':') {
        let form = format!(
            "continuation covers the range without steps: omit the third value, as in {name}={from}:{to}"
        );
        return Err(invalid(&form));
    }
    let key = harvester.file().numeric_key(name.trim());
    let key = key.map_err(|faults| range_error(option, text, faults))?;
    check_continuous(&key, option, text)?;
    let ends = KeyRange::ends(&key, from, to);
    let (low, high) = ends.map_err(|fault| range_error(option, text, fault))?;
    match low < high {
        true => Ok((key, (low, high))),
        false => Err(invalid("the first value must be below the second")),
    }
}

/// Refuses a key with a whole number where branches are continued over its values.
pub(crate) fn check_continuous(
    key: &NumericKey,
    option: &'static str,
    text: &str,
) -> Result<(), Error> {
    if !key.is_count() {
        return Ok(());
    }
    let expected = format!(
        "{} is a whole number and cannot vary continuously; give a key with a real number; a sweep takes whole numbers too",
        key.path()
    );
    Err(Error::option(option, text, expected))
}

/// Checks the options of the search for the first orbits.
pub(crate) fn check_search(tolerance: f64, seeds: usize, longest_period: u32) -> Result<(), Error> {
    check_tolerance(tolerance)?;
    if seeds > BranchSearch::MAX_SEEDS {
        let expected = format!("it must be at most {}", BranchSearch::MAX_SEEDS);
        return Err(Error::option("seeds", seeds, expected));
    }
    if longest_period == 0 {
        let expected = "it must be at least 1";
        return Err(Error::option("longest_period", longest_period, expected));
    }
    Ok(())
}

/// Reads levels of quantities of an orbit.
pub(crate) fn levels(texts: &[String], plant: &Plant) -> Result<Vec<QuantityLevel>, Error> {
    let read = |text: &String| {
        QuantityLevel::parse(text, plant).map_err(|reason| {
            let expected = reason.strip_prefix(&format!("{text}: "));
            Error::option("level", text, expected.unwrap_or(&reason))
        })
    };
    texts.iter().map(read).collect()
}
