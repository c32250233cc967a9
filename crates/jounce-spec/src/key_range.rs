//! Values of a sweep.
//!
//! ```text
//! FROM:TO:STEP   x_i = FROM + i STEP, up to and with TO         4Hz:20Hz:0.1Hz
//! FROM:TO:Nx     x_i = FROM + i (TO - FROM) / (N - 1)           4Hz:20Hz:161x
//! FROM:TO:Nlog   x_i = FROM (TO / FROM)^(i / (N - 1))           1kohm:10Mohm:50log
//! A,B,C          these
//! ```
//!
//! Steps are added as decimals, so 4 Hz + 3 * 0.1 Hz equals the double of `"4.3 Hz"` exactly.

use super::fault::Fault;
use super::key::{Kind, Range};
use super::nearest::{clip, join_words};
use super::numeric_key::NumericKey;
use jounce_units::{Decimal, Quantity};

/// Largest number of points of a sweep.
const MAX_POINTS: usize = 1_000_000;

/// A key and its values, in ascending order or as listed.
#[derive(Debug, Clone)]
pub struct KeyRange {
    key: NumericKey,
    values: Vec<f64>,
}

impl KeyRange {
    /// Reads `FROM:TO:STEP`, `FROM:TO:Nx`, `FROM:TO:Nlog`, `A,B,C` or one value, each with its
    /// unit.
    ///
    /// # Errors
    /// A range that is empty, reversed, longer than a million points, in wrong units, with repeated
    /// values or beyond the limits of the key.
    pub fn parse(key: NumericKey, text: &str) -> Result<Self, Fault> {
        let values = points(key.kind(), text).map_err(|reason| fault(&key, &reason))?;
        for value in &values {
            key.check(*value)?;
        }
        Ok(Self { key, values })
    }

    /// Reads the ends of a range, each with its unit, SI.
    ///
    /// # Errors
    /// An end in wrong units or beyond the limits of the key.
    pub fn ends(key: &NumericKey, from: &str, to: &str) -> Result<(f64, f64), Fault> {
        let ends = all_or_reasons([from, to].map(|end| number(key.kind(), end)));
        let ends = ends.map_err(|reason| fault(key, &reason))?;
        for end in &ends {
            key.check(*end)?;
        }
        Ok((ends[0], ends[1]))
    }

    /// Returns the key.
    pub fn key(&self) -> &NumericKey {
        &self.key
    }

    /// Returns the values, SI.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

fn fault(key: &NumericKey, reason: &str) -> Fault {
    Fault::without_position(key.path(), format!("{}: {reason}", key.path()))
}

/// Reads the values of a range as [`KeyRange::parse`], for quantities of one kind, SI.
///
/// # Errors
/// A range that is empty, reversed, longer than a million points, in wrong units or with repeated
/// values.
pub fn quantity_range(quantity: Quantity, text: &str) -> Result<Vec<f64>, String> {
    points(Kind::Quantity(quantity), text)
}

/// Reads one number of a kind, SI.
pub(super) fn number(kind: Kind, text: &str) -> Result<f64, String> {
    Ok(DecimalNumber::read(kind, text)?.value)
}

/// Returns the values of a range. A value that stands twice would be computed twice, with two results
/// for one value of the key.
fn points(kind: Kind, text: &str) -> Result<Vec<f64>, String> {
    let values = listed_points(kind, text)?;
    let mut sorted = values.clone();
    sorted.sort_by(f64::total_cmp);
    let mut repeated: Vec<f64> = sorted
        .windows(2)
        .filter(|pair| pair[0] == pair[1])
        .map(|pair| pair[0])
        .collect();
    repeated.dedup();
    let shown: Vec<String> = repeated.iter().map(|value| kind.show(*value)).collect();
    let shown: Vec<&str> = shown.iter().map(String::as_str).collect();
    match repeated.len() {
        0 => Ok(values),
        _ => Err(format!(
            "\"{}\" has {} more than once; give each value once",
            clip(text),
            join_words(&shown)
        )),
    }
}

fn listed_points(kind: Kind, text: &str) -> Result<Vec<f64>, String> {
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let [from, to, spacing] = parts[..] else {
        if parts.len() != 1 {
            return Err(format!(
                "\"{}\" is not a range; write FROM:TO:STEP, FROM:TO:Nx, FROM:TO:Nlog or A,B,C",
                clip(text)
            ));
        }
        let values = text.split(',').map(|part| number(kind, part));
        return all_or_reasons(values);
    };
    let ends = all_or_reasons([from, to].map(|end| DecimalNumber::read(kind, end)));
    let (ends, spacing) = match (ends, Spacing::read(kind, spacing)) {
        (Ok(ends), Ok(spacing)) => (ends, spacing),
        (ends, spacing) => {
            let reasons = [ends.err(), spacing.err()].into_iter().flatten();
            return Err(reasons.collect::<Vec<_>>().join("; "));
        }
    };
    let (from, to) = (&ends[0], &ends[1]);
    if from.value > to.value {
        return Err(format!(
            "the range {} is reversed; write the smaller value first",
            clip(text)
        ));
    }
    match spacing {
        Spacing::Logarithmic(count) => logarithmic(from.value, to.value, count),
        Spacing::Linear(count) => Ok(linear(from.value, to.value, count)),
        Spacing::Step(step) => stepped(from, to, &step),
    }
}

/// Returns all values, or the reasons of all faults, separated by semicolons.
fn all_or_reasons<T>(
    results: impl IntoIterator<Item = Result<T, String>>,
) -> Result<Vec<T>, String> {
    let (mut values, mut reasons) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(reason) => reasons.push(reason),
        }
    }
    match reasons.is_empty() {
        true => Ok(values),
        false => Err(reasons.join("; ")),
    }
}

/// Spacing of the values of a range.
enum Spacing {
    Step(DecimalNumber),
    /// Number of values at equal distances.
    Linear(usize),
    /// Number of values at equal ratios.
    Logarithmic(usize),
}

impl Spacing {
    fn read(kind: Kind, text: &str) -> Result<Self, String> {
        if let Some(count) = text.strip_suffix("log") {
            return Ok(Self::Logarithmic(count_of(count)?));
        }
        if let Some(count) = text.strip_suffix('x') {
            return Ok(Self::Linear(count_of(count)?));
        }
        let invalid = |reason: &str| {
            format!(
                "the step is {}; {reason}, or give a number of points, as in 3x",
                clip(text)
            )
        };
        let step = DecimalNumber::read(kind, text).map_err(|reason| invalid(&reason))?;
        match step.value > 0.0 {
            true => Ok(Self::Step(step)),
            false => Err(invalid("it must be greater than 0")),
        }
    }
}

/// A number as a double and, if it is a decimal, as integer digits times a power of ten.
struct DecimalNumber {
    value: f64,
    exact: Option<(i128, i64)>,
}

impl DecimalNumber {
    fn read(kind: Kind, text: &str) -> Result<Self, String> {
        let text = text.trim();
        let has_unit = || Decimal::split(text).is_some_and(|(_, unit)| !unit.is_empty());
        let quantity = match kind {
            Kind::Quantity(quantity) | Kind::NamedQuantities(quantity) => Some(quantity),
            Kind::NumberOr(quantity) if has_unit() => Some(quantity),
            _ => None,
        };
        if let Some(quantity) = quantity {
            let value = quantity.read(text).map_err(|error| error.to_string())?;
            return Ok(Self {
                value,
                exact: quantity.exact(text),
            });
        }
        match Decimal::split(text) {
            Some((number, "")) if Range::ANY.holds(number.scaled(0)) => Ok(Self {
                value: number.scaled(0),
                exact: number.integer_ratio(0),
            }),
            _ => Err(format!(
                "\"{}\" is not a plain number; {}",
                clip(text),
                kind.expectation()
            )),
        }
    }

    /// Returns the digits for an exponent that is at most the stored exponent.
    fn digits_at(&self, exponent: i64) -> Option<i128> {
        let (digits, key_exponent) = self.exact?;
        let shift = u32::try_from(key_exponent - exponent)
            .ok()
            .filter(|shift| *shift < 30)?;
        digits.checked_mul(10i128.checked_pow(shift)?)
    }
}

fn stepped(
    from: &DecimalNumber,
    to: &DecimalNumber,
    step: &DecimalNumber,
) -> Result<Vec<f64>, String> {
    let steps = ((to.value - from.value) / step.value * (1.0 + 1e-12) + 1e-9).floor();
    let too_long = || format!("the range has more than {MAX_POINTS} points; make the step larger");
    if steps.is_nan() || steps >= MAX_POINTS as f64 {
        return Err(too_long());
    }
    if steps < 1.0 && from.value < to.value {
        let reason = "the step is larger than the range; make it smaller, or give one value";
        return Err(reason.to_owned());
    }
    let exponent = [from, to, step]
        .iter()
        .filter_map(|number| number.exact)
        .map(|(_, exponent)| exponent)
        .min();
    let digits = exponent.and_then(|e| {
        let first = from.digits_at(e)?;
        Some((
            e,
            first,
            to.digits_at(e)?.checked_sub(first)?,
            step.digits_at(e)?,
        ))
    });
    if let Some((exponent, from, length, step)) = digits
        && step > 0
    {
        // Ends that are equal as doubles may be far apart as decimals.
        if length / step >= MAX_POINTS as i128 {
            return Err(too_long());
        }
        let nearest = |digits: i128| {
            format!("{digits}e{exponent}")
                .parse::<f64>()
                .unwrap_or(f64::INFINITY)
        };
        return Ok((0..=length / step)
            .map(|index| nearest(from + index * step))
            .collect());
    }
    Ok((0..=steps as u64)
        .map(|index| (from.value + index as f64 * step.value).min(to.value))
        .collect())
}

fn linear(from: f64, to: f64, count: usize) -> Vec<f64> {
    let part = |index: usize| index as f64 / (count - 1).max(1) as f64;
    let inner = (0..count).map(|index| {
        if index + 1 == count && count > 1 {
            to
        } else if (to - from).is_finite() {
            from + (to - from) * part(index)
        } else {
            from * (1.0 - part(index)) + to * part(index)
        }
    });
    inner.collect()
}

fn logarithmic(from: f64, to: f64, count: usize) -> Result<Vec<f64>, String> {
    if from <= 0.0 {
        return Err("a logarithmic range must start above 0".to_owned());
    }
    let quotient = to / from;
    let ratio = quotient.ln();
    let exponents = linear(0.0, 1.0, count);
    let inner = exponents
        .into_iter()
        .enumerate()
        .map(|(index, part)| match index {
            0 => from,
            _ if index + 1 == count => to,
            _ if quotient.is_finite() => from * (ratio * part).exp(),
            _ => (from.ln() * (1.0 - part) + to.ln() * part).exp(),
        });
    Ok(inner.collect())
}

fn count_of(text: &str) -> Result<usize, String> {
    let count = text
        .trim()
        .parse::<usize>()
        .ok()
        .filter(|count| (2..=MAX_POINTS).contains(count));
    count.ok_or_else(|| {
        format!(
            "\"{}\" is not a number of points; give 2 to {MAX_POINTS}",
            clip(text)
        )
    })
}
