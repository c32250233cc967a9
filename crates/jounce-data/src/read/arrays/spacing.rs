//! Sampling rates and steps that a file stores as scalars.

use std::collections::HashMap;
use std::io;

use super::super::raw::Rate;
use super::{Array, Path, Tree};
use crate::recording::{Issue, IssueKind, Over};

/// Names of scalars that give a rate in Hz, a step in s (Hz over frequency), or a first position;
/// in lower case without underscores.
const RATES: [&str; 8] = [
    "fs",
    "samplerate",
    "samplingrate",
    "samplefrequency",
    "samplingfrequency",
    "samplefreq",
    "samplingfreq",
    "fsamp",
];
const STEPS: [&str; 9] = [
    "dt",
    "deltat",
    "timestep",
    "samplestep",
    "sampleinterval",
    "samplinginterval",
    "increment",
    "xincrement",
    "wfincrement",
];
const FREQUENCY_STEPS: [&str; 4] = ["df", "deltaf", "frequencystep", "freqstep"];
const STARTS: [&str; 6] = [
    "startvalue",
    "xstart",
    "t0",
    "starttime",
    "x0",
    "wfstartoffset",
];

/// Uniform grid given by scalars of one struct.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Spacing {
    /// Scope of the scalars.
    pub scope: Vec<String>,
    pub rate: Rate,
    /// First position, if stored.
    pub start: Option<f64>,
    pub over: Over,
}

/// Spacings of all scopes; if scalars of one scope disagree, the first is used and an issue is
/// added.
pub(super) fn spacings(singles: &[Array], tree: &mut Tree) -> io::Result<Vec<Spacing>> {
    let mut found: Vec<Spacing> = Vec::new();
    let mut by_scope: HashMap<Vec<String>, usize> = HashMap::new();
    let starts = starts(singles)?;
    for single in singles {
        let Some(mut spacing) = spacing(single, tree)? else {
            continue;
        };
        match by_scope.get(&spacing.scope).map(|known| &found[*known]) {
            Some(known) if known.over == spacing.over => {
                if spacing.rate.differs_from(known.rate.rate_hz) {
                    let [a, b] = [&known.rate, &spacing.rate];
                    let about = format!(
                        "{} is a rate of {} Hz, {} one of {} Hz; the first is used",
                        a.told, a.rate_hz, b.told, b.rate_hz
                    );
                    tree.findings
                        .push(Issue::new(IssueKind::HeaderDisagrees, 1, None, about));
                }
            }
            _ => {
                spacing.start = starts.get(spacing.scope.as_slice()).copied();
                by_scope.insert(spacing.scope.clone(), found.len());
                found.push(spacing);
            }
        }
    }
    Ok(found)
}

/// Spacing given by one scalar, recognised by its name.
fn spacing(single: &Array, tree: &Tree) -> io::Result<Option<Spacing>> {
    let name = plain(single.path.name());
    let is = |names: &[&str]| names.contains(&name.as_str());
    let (is_rate, is_step, is_frequency_step) = (is(&RATES), is(&STEPS), is(&FREQUENCY_STEPS));
    if single.imaginary.is_some() || !(is_rate || is_step || is_frequency_step) {
        return Ok(None);
    }
    let number = value(single)?;
    let rate_hz = if is_rate { number } else { 1.0 / number };
    let scope = single.path.scope().to_vec();
    let over = if is_frequency_step || is_step && is_in_hertz(tree, &scope) {
        Over::Frequency
    } else {
        Over::Time
    };
    let rate = Rate {
        told: format!("{} = {number}", single.path),
        rate_hz,
    };
    Ok((rate_hz > 0.0 && rate_hz.is_finite()).then_some(Spacing {
        scope,
        rate,
        start: None,
        over,
    }))
}

/// First positions by scope.
fn starts(singles: &[Array]) -> io::Result<HashMap<&[String], f64>> {
    let is_start = |single: &&Array| STARTS.contains(&plain(single.path.name()).as_str());
    singles
        .iter()
        .filter(is_start)
        .map(|single| Ok((single.path.scope(), value(single)?)))
        .collect()
}

/// True where the axis of these numbers is in Hz: `x_values.quantity.label` of Simcenter Testlab.
fn is_in_hertz(tree: &Tree, scope: &[String]) -> bool {
    let quantity = Path(scope.to_vec()).to("quantity");
    let texts = [
        tree.text_at(&quantity.0, "label"),
        tree.text_at(scope, "unit"),
        tree.text_at(scope, "units"),
    ];
    texts
        .into_iter()
        .flatten()
        .filter_map(|texts| texts.first())
        .any(|unit| unit.eq_ignore_ascii_case("hz"))
}

fn value(single: &Array) -> io::Result<f64> {
    Ok(single
        .series
        .first()
        .map(|numbers| numbers.ends())
        .transpose()?
        .flatten()
        .map_or(f64::NAN, |(number, _)| number))
}

/// Returns a name in lower case without underscores.
pub(super) fn plain(name: &str) -> String {
    name.to_lowercase().chars().filter(|c| *c != '_').collect()
}
