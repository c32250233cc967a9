//! Sampling rates and steps that a file stores as scalars.

use std::collections::HashMap;
use std::io;

use super::{Array, Path, Tree};
use crate::read::column::raw::Rate;
use crate::recording::{Issue, IssueKind, Over};

/// Names of scalars that give a rate in Hz, a step in s (Hz over frequency), or a first position;
/// in lower case without underscores.
const RATE_KEYS: [&str; 8] = [
    "fs",
    "samplerate",
    "samplingrate",
    "samplefrequency",
    "samplingfrequency",
    "samplefreq",
    "samplingfreq",
    "fsamp",
];
const STEP_KEYS: [&str; 9] = [
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
const FREQUENCY_STEP_KEYS: [&str; 4] = ["df", "deltaf", "frequencystep", "freqstep"];
const START_KEYS: [&str; 6] = [
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
pub(super) fn spacings(scalars: &[Array], tree: &mut Tree) -> io::Result<Vec<Spacing>> {
    let mut result: Vec<Spacing> = Vec::new();
    let mut by_scope: HashMap<Vec<String>, usize> = HashMap::new();
    let starts = starts(scalars)?;
    for scalar in scalars {
        let Some(mut spacing) = spacing(scalar, tree)? else {
            continue;
        };
        match by_scope.get(&spacing.scope).map(|known| &result[*known]) {
            Some(known) if known.over == spacing.over => {
                if spacing.rate.differs_from(known.rate.rate_hz) {
                    let [a, b] = [&known.rate, &spacing.rate];
                    let message = format!(
                        "{} is a rate of {} Hz, {} one of {} Hz; the first is used",
                        a.source, a.rate_hz, b.source, b.rate_hz
                    );
                    tree.issues
                        .push(Issue::new(IssueKind::HeaderDisagrees, 1, None, message));
                }
            }
            _ => {
                spacing.start = starts.get(spacing.scope.as_slice()).copied();
                by_scope.insert(spacing.scope.clone(), result.len());
                result.push(spacing);
            }
        }
    }
    Ok(result)
}

/// Spacing given by one scalar, recognised by its name.
fn spacing(scalar: &Array, tree: &Tree) -> io::Result<Option<Spacing>> {
    let name = plain(scalar.path.name());
    let is = |names: &[&str]| names.contains(&name.as_str());
    let (is_rate, is_step, is_frequency_step) =
        (is(&RATE_KEYS), is(&STEP_KEYS), is(&FREQUENCY_STEP_KEYS));
    if scalar.imaginary.is_some() || !(is_rate || is_step || is_frequency_step) {
        return Ok(None);
    }
    let number = value(scalar)?;
    let rate_hz = if is_rate { number } else { 1.0 / number };
    let scope = scalar.path.scope().to_vec();
    let over = if is_frequency_step || is_step && is_in_hertz(tree, &scope) {
        Over::Frequency
    } else {
        Over::Time
    };
    let rate = Rate {
        source: format!("{} = {number}", scalar.path),
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
fn starts(scalars: &[Array]) -> io::Result<HashMap<&[String], f64>> {
    let is_start = |scalar: &&Array| START_KEYS.contains(&plain(scalar.path.name()).as_str());
    scalars
        .iter()
        .filter(is_start)
        .map(|scalar| Ok((scalar.path.scope(), value(scalar)?)))
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

fn value(scalar: &Array) -> io::Result<f64> {
    Ok(scalar
        .series
        .first()
        .map(|numbers| numbers.first_and_last())
        .transpose()?
        .flatten()
        .map_or(f64::NAN, |(number, _)| number))
}

/// Returns a name in lower case without underscores.
pub(super) fn plain(name: &str) -> String {
    name.to_lowercase().chars().filter(|c| *c != '_').collect()
}
