//! Options: each is one field, with its default and its line of help. The command line reads the
//! fields as arguments, Python as keyword arguments.

use crate::error::Error;
use crate::harvester::Harvester;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use jounce_spec::{Faults, KeyRange, Quantity};

/// Definition of an option.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct OptionDefinition {
    /// Name of the field, which is the keyword in Python.
    pub name: String,
    /// Name on the command line, without `--`.
    pub argument: String,
    /// Default as written on the command line; empty without one.
    pub default: String,
    /// Allowed words of a choice; empty for other options.
    pub choices: Vec<String>,
    /// One line of help.
    pub help: String,
}

impl OptionDefinition {
    /// Returns the name of the option in a study and in Python: its name without a unit.
    pub fn keyword(&self) -> String {
        let negated = self.argument.strip_prefix("no-");
        negated.unwrap_or(&self.argument).replace('-', "_")
    }
}

/// Returns the definitions of all options of a computation.
///
/// ```
/// let options = jounce::definitions::<jounce::RunOptions>();
/// assert!(options.iter().any(|option| option.name == "tolerance"));
/// ```
pub fn definitions<O: Args>() -> Vec<OptionDefinition> {
    let command = O::augment_args(Command::new("options"));
    let definition = |argument: &clap::Arg| OptionDefinition {
        name: argument.get_id().to_string(),
        argument: argument.get_long().unwrap_or_default().to_owned(),
        default: join(
            argument
                .get_default_values()
                .iter()
                .map(|value| value.to_string_lossy()),
        ),
        choices: match argument.get_action().takes_values() {
            true => argument.get_possible_values(),
            false => Vec::new(),
        }
        .iter()
        .map(|choice| choice.get_name().to_owned())
        .collect(),
        help: argument
            .get_help()
            .map(ToString::to_string)
            .unwrap_or_default(),
    };
    command.get_arguments().map(definition).collect()
}

fn join<'a>(values: impl Iterator<Item = std::borrow::Cow<'a, str>>) -> String {
    values.collect::<Vec<_>>().join(" ")
}

/// Returns the options with their defaults; a required text is empty.
///
/// # Panics
/// Where a default is not a valid value; a test of each options type excludes it.
pub(crate) fn defaults<O: Args + FromArgMatches>() -> O {
    let command = O::augment_args(Command::new("options").no_binary_name(true));
    let command = command.mut_args(|argument| match argument.is_required_set() {
        true => argument.required(false).default_value(""),
        false => argument,
    });
    let matches: Result<ArgMatches, clap::Error> = command.try_get_matches_from([""; 0]);
    match matches.and_then(|matches| O::from_arg_matches(&matches)) {
        Ok(options) => options,
        Err(error) => panic!("a default is not valid: {error}"),
    }
}

/// Reads a time with its unit, s.
pub(crate) fn time_s(text: &str) -> Result<f64, String> {
    si(Quantity::Time)(text)
}

/// Reads a frequency with its unit, Hz.
pub(crate) fn frequency_hz(text: &str) -> Result<f64, String> {
    si(Quantity::Frequency)(text)
}

/// Returns a reader of a quantity with its unit, in SI.
pub(crate) fn si(quantity: Quantity) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| quantity.read(text).map_err(|error| error.to_string())
}

/// Refuses options that differ from their defaults; `expected` says what they need. A field is named
/// after its option and the unit.
pub(crate) fn refuse_changed<O: Default + serde::Serialize>(
    options: &O,
    fields: &[&'static str],
    expected: &str,
) -> Result<(), Error> {
    let json = |options: &O| serde_json::to_value(options).unwrap_or_default();
    let (values, defaults) = (json(options), json(&O::default()));
    let is_changed = |field: &&&'static str| values[**field] != defaults[**field];
    let Some(field) = fields.iter().find(is_changed) else {
        return Ok(());
    };
    let text = |value: &serde_json::Value| match value.as_str() {
        Some(text) => text.to_owned(),
        None => value.to_string(),
    };
    let value = match values[*field].as_array() {
        Some(items) => items.iter().map(text).collect::<Vec<_>>().join(" "),
        None => text(&values[*field]),
    };
    let units = ["_f", "_hz", "_kg", "_m", "_n", "_ohm", "_s"];
    let option = units.iter().find_map(|unit| field.strip_suffix(unit));
    Err(Error::option(option.unwrap_or(field), value, expected))
}

/// Reads a resistance with its unit, ohm.
pub(crate) fn resistance_ohm(text: &str) -> Result<f64, String> {
    si(Quantity::Resistance)(text)
}

/// Reads two quantities of an option, as in `0.2s:3s`.
pub(crate) fn ends(text: &str, quantity: Quantity) -> Result<(f64, f64), String> {
    let example = match quantity {
        Quantity::Time => "0.2s:3s",
        _ => "500Hz:4300Hz",
    };
    let usage = || format!("write FROM:TO, as in {example}, the smaller one first");
    let (from, to) = text.split_once(':').ok_or_else(usage)?;
    let read = si(quantity);
    let (from, to) = (read(from)?, read(to)?);
    if from < to {
        Ok((from, to))
    } else {
        Err(usage())
    }
}

/// Reads two times with their units, s.
pub(crate) fn times_s(text: &str) -> Result<(f64, f64), String> {
    ends(text, Quantity::Time)
}

/// Reads two frequencies with their units, Hz.
pub(crate) fn frequencies_hz(text: &str) -> Result<(f64, f64), String> {
    ends(text, Quantity::Frequency)
}

/// Reads `KEY=RANGE` of an option: a key with its values.
pub(crate) fn key_range(
    harvester: &Harvester,
    option: &'static str,
    text: &str,
) -> Result<KeyRange, Error> {
    let range = harvester.file().range(text);
    range.map_err(|faults| range_error(option, text, faults))
}

/// Returns the error of a key or a range of an option.
pub(crate) fn range_error(option: &'static str, text: &str, faults: impl Into<Faults>) -> Error {
    let value = if text.is_empty() { "empty" } else { text };
    Error::Range {
        option,
        value: value.to_owned(),
        faults: faults.into(),
    }
}

/// Returns the value of an option if it is finite and above 0.
pub(crate) fn check_above_zero(option: &'static str, value: f64, unit: &str) -> Result<f64, Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(value);
    }
    let text = format!("{value} {unit}");
    Err(Error::option(option, text.trim(), "it must be above 0"))
}

/// Returns the frequency of a drive, Hz, if it is above 0 and below the highest one that samples of a
/// rate show; `part` is that share of the rate and its name.
pub(crate) fn check_drive(
    drive_hz: f64,
    rate_hz: f64,
    (part, name): (f64, &str),
) -> Result<f64, Error> {
    let limit_hz = part * rate_hz;
    if drive_hz < limit_hz {
        return check_above_zero("drive", drive_hz, "Hz");
    }
    let expected = format!("it must be below {name} the sampling rate, which is {limit_hz} Hz");
    Err(Error::option("drive", format!("{drive_hz} Hz"), expected))
}

/// Largest number of frequencies of a band.
const MAX_POINTS: usize = 1_000_000;

/// Checks the ends of a band, Hz, and the number of its frequencies.
pub(crate) fn check_band([low_hz, high_hz]: [f64; 2], points: usize) -> Result<(), Error> {
    if !(low_hz > 0.0 && low_hz < high_hz && high_hz.is_finite()) {
        let expected = format!("it must be above 0 Hz and below `high`, {high_hz} Hz");
        return Err(Error::option("low", format!("{low_hz} Hz"), expected));
    }
    if !(2..=MAX_POINTS).contains(&points) {
        let expected = format!("it must be from 2 to {MAX_POINTS}");
        return Err(Error::option("points", points, expected));
    }
    Ok(())
}

/// Checks the tolerance of an orbit; double precision allows no smaller one than the limit.
///
/// # Errors
/// [`Error::Option`].
pub fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    if (1e-14..1e-2).contains(&tolerance) {
        return Ok(());
    }
    let value = format!("{tolerance:e}");
    Err(Error::option(
        "tolerance",
        value,
        "give a number from 1e-14 to below 0.01",
    ))
}

/// Runs work on a pool of its own with so many threads; a shared pool does not survive a `fork`.
pub(crate) fn on_threads<T: Send>(
    threads: Option<u16>,
    work: impl FnOnce() -> Result<T, Error> + Send,
) -> Result<T, Error> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from));
    pool.build()?.install(work)
}
