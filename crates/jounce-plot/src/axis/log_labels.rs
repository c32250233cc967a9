//! Values with a label on a logarithmic axis: the first of these sets with at least two values that
//! all have room.
//!
//! 1. Below 0.7 decades: multiples of a step, 1, 2 or 5 times a power of ten.
//! 2. 1, 2 and 5 of each decade; with three powers of ten or more, these must have twice the room.
//! 3. Powers of ten; then every second, third, ... of them.
//!
//! Where no set has two values with room: the first and the last line of the axis. The live page
//! has the same rule in `web/src/ticks.ts`; both are tested with the cases of `cases.json`.

/// Span below which a logarithmic axis has equal steps, decades.
const NARROW: f64 = 0.7;

/// Number of equal steps of a narrow axis, at most.
const MAX_STEPS: f64 = 7.0;

/// Span above which only the powers of ten are lines, decades.
const WIDE: f64 = 4.0;

/// Rounding of the ends of an axis, relative to a step.
const ROUNDING: f64 = 1e-9;

/// Labelled values of a logarithmic axis.
#[derive(Debug, PartialEq)]
pub(super) struct LogLabels {
    pub values: Vec<f64>,
    /// The values are multiples of this step; absent where they are 1, 2 or 5 of a decade.
    pub step: Option<f64>,
}

/// True for an axis whose labels are multiples of a step, as those of a linear axis.
pub(super) fn is_narrow(low: f64, high: f64) -> bool {
    (high / low).log10() < NARROW
}

/// Returns the labels of an axis whose labels need the distance `nearest`, a share of the axis.
pub(super) fn log_labels(low: f64, high: f64, nearest: f64) -> LogLabels {
    let decades = (high / low).log10();
    let fits = |values: &[f64], rooms: f64| {
        let is_apart = |pair: &[f64]| (pair[1] / pair[0]).log10() >= rooms * nearest * decades;
        values.len() > 1 && values.windows(2).all(is_apart)
    };
    if is_narrow(low, high) {
        let finest = step_of_at_least((high - low) / MAX_STEPS);
        let steps = std::iter::successors(Some(finest), |step| Some(step_of_at_least(1.5 * step)));
        let found = steps
            .take_while(|step| *step < high)
            .map(|step| (multiples(low, high, step), Some(step)))
            .find(|(values, _)| fits(values, 1.0));
        let (values, step) =
            found.unwrap_or_else(|| (ends(&multiples(low, high, finest)), Some(finest)));
        return LogLabels { values, step };
    }
    let powers = of_decades(low, high, &[1.0]);
    let parts = of_decades(low, high, &[1.0, 2.0, 5.0]);
    let rooms = if powers.len() < 3 { 1.0 } else { 2.0 };
    let every = |count: usize| -> Vec<f64> {
        let is_kept = |power: &&f64| (power.log10().round() as i64).rem_euclid(count as i64) == 0;
        powers.iter().filter(is_kept).copied().collect()
    };
    let values = if fits(&parts, rooms) {
        parts
    } else {
        (1..=powers.len())
            .map(every)
            .find(|values| fits(values, 1.0))
            .unwrap_or_else(|| ends(&lines(low, high, decades)))
    };
    LogLabels { values, step: None }
}

/// Returns the lines of an axis that is not narrow.
fn lines(low: f64, high: f64, decades: f64) -> Vec<f64> {
    if decades > WIDE {
        of_decades(low, high, &[1.0])
    } else {
        of_decades(low, high, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])
    }
}

/// Returns the smallest step of 1, 2 or 5 times a power of ten that is not below a value.
fn step_of_at_least(value: f64) -> f64 {
    let ten = 10_f64.powi(value.log10().floor() as i32);
    let found = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|factor| factor * ten >= value * (1.0 - ROUNDING));
    found.unwrap_or(10.0) * ten
}

fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step - ROUNDING).ceil() as i64;
    let last = (high / step + ROUNDING).floor() as i64;
    (first..=last).map(|count| count as f64 * step).collect()
}

/// Returns the values of the given mantissas between both ends.
pub(super) fn of_decades(low: f64, high: f64, mantissas: &[f64]) -> Vec<f64> {
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let is_inside =
        |value: &f64| *value >= low * (1.0 - ROUNDING) && *value <= high * (1.0 + ROUNDING);
    (first..=last)
        .flat_map(|power| mantissas.iter().map(move |own| own * 10_f64.powi(power)))
        .filter(is_inside)
        .collect()
}

/// Returns the first and the last value.
fn ends(values: &[f64]) -> Vec<f64> {
    match values {
        [first, .., last] => vec![*first, *last],
        few => few.to_vec(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::log_labels;

    #[test]
    fn labels_are_those_of_the_cases_that_the_live_page_shares() {
        let cases: serde_json::Value = serde_json::from_str(include_str!("cases.json")).unwrap();
        for case in cases["labels"].as_array().unwrap() {
            let number = |name: &str| case[name].as_f64().unwrap();
            let found = log_labels(number("low"), number("high"), number("nearest")).values;
            let labels: Vec<f64> = case["labels"]
                .as_array()
                .unwrap()
                .iter()
                .map(|label| label.as_f64().unwrap())
                .collect();
            let is_equal = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() < 1e-9;
            assert!(
                found.len() == labels.len() && found.iter().zip(&labels).all(is_equal),
                "{case}: {found:?}"
            );
        }
    }
}
