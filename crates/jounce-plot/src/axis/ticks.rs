//! Ticks of an axis and their labels.
//!
//! Linear axes step by 1, 2 or 5 times a power of ten; logarithmic ones are labelled by the rule of
//! [`super::log_labels`]. Values are written as plain decimals of a prefixed unit if these lie
//! between 0.001 and 10000, else as powers of ten.

use super::log_labels::is_narrow;
use super::span::Span;
use super::tick_positions::tick_positions;
use super::unit;
use crate::{Axis, Scale};

/// Ticks of one axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ticks {
    /// Labelled ticks.
    pub major: Vec<(f64, String)>,
    /// Ticks without a label.
    pub minor: Vec<f64>,
    /// Title of the axis: quantity and (prefixed) unit.
    pub title: String,
}

impl Ticks {
    /// Returns the ticks of an axis with room for about `room` labels.
    pub fn of(axis: &Axis, span: &Span, room: f64) -> Self {
        let unit = unit::printed(&axis.unit);
        let exponent = if unit::takes_prefix(&unit) {
            prefix_exponent(span)
        } else {
            0
        };
        let factor = 10f64.powi(exponent);
        let (values, minor, decimals) = tick_positions(axis, span, factor, room.max(2.0));
        let power = decimals.and_then(|_| common_power(span, factor));
        let label = |&value: &f64| match (decimals, power) {
            (Some(decimals), None) => decimal(value / factor, decimals),
            (Some(decimals), Some(power)) => decimal(
                value / factor / 10f64.powi(power),
                (decimals + power).max(0),
            ),
            (None, _) => scientific(value / factor, axis_is_plain(span, factor)),
        };
        let major = values.iter().map(|value| (*value, label(value))).collect();
        Self {
            major,
            minor,
            title: title(&axis.quantity, &unit, exponent, power),
        }
    }
}

fn title(quantity: &str, unit: &str, exponent: i32, power: Option<i32>) -> String {
    let power = power.map(|power| format!("10{}", unit::raised(&power.to_string())));
    let unit = format!("{}{unit}", unit::prefix(exponent).unwrap_or_default());
    match (power, unit.as_str()) {
        (None, "") => quantity.to_owned(),
        (None, unit) => format!("{quantity} ({unit})"),
        (Some(power), "") => format!("{quantity} ({power})"),
        (Some(power), unit) => format!("{quantity} ({power} {unit})"),
    }
}

/// Returns the power of ten of the prefix. The largest labels of axes with equal steps lie between 1
/// and 1000; labels of other logarithmic axes are plain if possible, else without prefix.
fn prefix_exponent(span: &Span) -> i32 {
    let thousands = |x: f64| (x.log10() / 3.0 + 1e-9).floor() as i32 * 3;
    if span.scale == Scale::Log && !is_narrow(span.low, span.high) {
        let candidates = [0, thousands(span.low), thousands(span.low) + 3];
        // Over many decades a prefix does not help: 10⁻⁵ W is easier to read than 10000 nW.
        let short = (span.high / span.low).log10() < 4.5;
        let plain = |e: &i32| {
            (*e == 0 || short) && unit::prefix(*e).is_some() && axis_is_plain(span, 10f64.powi(*e))
        };
        return candidates.into_iter().find(plain).unwrap_or(0);
    }
    let largest = span.low.abs().max(span.high.abs());
    let exponent = thousands(largest);
    // A round thousand at the end of an axis does not change the unit: 0 to 1000 Hz.
    let exponent = if exponent > 0 && largest < 1.1 * 10f64.powi(exponent) {
        exponent - 3
    } else {
        exponent
    };
    exponent.clamp(-18, 12)
}

/// True where the powers of ten on a logarithmic axis are readable as plain decimals: 0.001 to
/// 10000.
fn axis_is_plain(span: &Span, factor: f64) -> bool {
    (span.low / factor).log10().ceil() >= -3.0 && (span.high / factor).log10().floor() <= 4.0
}

/// Returns the power of ten factored out of the labels of an axis with equal steps, if its unit
/// takes no prefix and its values are far from 1.
fn common_power(span: &Span, factor: f64) -> Option<i32> {
    let largest = span.low.abs().max(span.high.abs()) / factor;
    let power = (largest.log10() + 1e-9).floor() as i32;
    (!(1e-3..1.5e5).contains(&largest)).then_some(power)
}

/// Returns a decimal with a true minus sign and no negative zero.
fn decimal(value: f64, decimals: i32) -> String {
    let text = format!("{value:.*}", usize::try_from(decimals).unwrap_or(0));
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|b| b == b'0' || b == b'.') => digits.to_owned(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

/// Returns a tick label of a logarithmic axis: `0.02`, `100`, or `2×10⁻⁵`, `10⁶`.
fn scientific(value: f64, plain: bool) -> String {
    let exponent = (value.log10() + 1e-9).floor() as i32;
    let mantissa = (value / 10f64.powi(exponent)).round();
    if plain {
        return decimal(value, -exponent);
    }
    let power = format!("10{}", unit::raised(&exponent.to_string()));
    if mantissa <= 1.0 {
        power
    } else {
        format!("{mantissa}×{power}")
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn ticks(axis: Axis, room: f64) -> (String, Vec<String>) {
        let (low, high) = axis.range.unwrap();
        let ticks = Ticks::of(
            &axis,
            &Span {
                low,
                high,
                scale: axis.scale,
            },
            room,
        );
        (
            ticks.title,
            ticks.major.into_iter().map(|(_, label)| label).collect(),
        )
    }

    #[test]
    fn linear_axes_read_as_short_decimals_of_a_prefixed_unit() {
        let (title, labels) = ticks(Axis::linear("Voltage", "V").between(-0.3, 0.3), 6.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Voltage (mV)", "−300 −200 −100 0 100 200 300")
        );
        let (title, labels) = ticks(Axis::linear("Power", "W/N^2").between(0.0, 4.2e-5), 5.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Power (µW/N²)", "0 10 20 30 40")
        );
        let (title, labels) = ticks(Axis::linear("Frequency", "Hz").between(0.0, 1000.0), 5.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Frequency (Hz)", "0 200 400 600 800 1000")
        );
        let (title, labels) = ticks(Axis::linear("Time", "s").between(19.0, 20.0), 5.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Time (s)", "19.0 19.2 19.4 19.6 19.8 20.0")
        );
        assert_eq!(
            ticks(Axis::linear("Ratio", "").between(0.1, 0.4), 4.0)
                .1
                .join(" "),
            "0.1 0.2 0.3 0.4"
        );
    }

    #[test]
    fn units_without_prefix_take_a_power_of_ten() {
        let (title, labels) = ticks(Axis::linear("Mass", "kg").between(0.0, 3e-7), 3.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Mass (10⁻⁷ kg)", "0 1 2 3")
        );
        let (title, labels) = ticks(Axis::linear("Count", "").between(0.0, 2e6), 4.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Count (10⁶)", "0.0 0.5 1.0 1.5 2.0")
        );
    }

    #[test]
    fn requested_step_is_used() {
        let labels = ticks(
            Axis::linear("Phase", "deg")
                .between(-180.0, 180.0)
                .every(90.0),
            9.0,
        );
        assert_eq!(
            (labels.0.as_str(), labels.1.join(" ").as_str()),
            ("Phase (°)", "−180 −90 0 90 180")
        );
    }

    #[test]
    fn log_axes_are_plain_where_they_can_be() {
        let (title, labels) = ticks(Axis::log("Load", "ohm").between(1e4, 1e7), 6.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Load (kΩ)", "10 100 1000 10000")
        );
        let (title, labels) = ticks(Axis::log("Frequency", "Hz").between(1.0, 1000.0), 6.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Frequency (Hz)", "1 10 100 1000")
        );
        let (title, labels) = ticks(Axis::log("Power", "W/N^2").between(1e-10, 1e-4), 8.0);
        assert_eq!(
            (title.as_str(), labels.join(" ").as_str()),
            ("Power (W/N²)", "10⁻¹⁰ 10⁻⁹ 10⁻⁸ 10⁻⁷ 10⁻⁶ 10⁻⁵ 10⁻⁴")
        );
        assert_eq!(
            ticks(Axis::log("Power", "W").between(0.02, 0.5), 8.0)
                .1
                .join(" "),
            "0.02 0.05 0.1 0.2 0.5"
        );
    }

    #[test]
    fn log_axes_have_the_units_of_the_cases_that_the_live_page_shares() {
        let cases: serde_json::Value = serde_json::from_str(include_str!("cases.json")).unwrap();
        for case in cases["units"].as_array().unwrap() {
            let [low, high] = ["low", "high"].map(|end| case[end].as_f64().unwrap());
            let [unit, shown] = ["unit", "shown"].map(|name| case[name].as_str().unwrap());
            let (title, _) = ticks(Axis::log("Power", unit).between(low, high), 6.0);
            assert_eq!(title, format!("Power ({shown})"), "{case}");
        }
    }

    #[test]
    fn many_decades_are_thinned_and_short_spans_step_equally() {
        // Labels of decades may be as near as half of the mean distance: twice as many.
        assert!(ticks(Axis::log("a", "").between(1e-30, 1e30), 8.0).1.len() <= 16);
        assert_eq!(
            ticks(Axis::log("Frequency", "Hz").between(8.0, 14.0), 6.0)
                .1
                .join(" "),
            "8 9 10 11 12 13 14"
        );
    }

    #[test]
    fn extreme_spans_neither_panic_nor_flood() {
        for (low, high) in [
            (0.0, 5e-290),
            (-1e300, 1e300),
            (1.0, 1.000_002),
            (1e15, 1e15 + 1e10),
            (-1e-7, 1e12),
        ] {
            let count = ticks(Axis::linear("a", "V").between(low, high), 7.0)
                .1
                .len();
            assert!((2..=12).contains(&count), "{low} {high}: {count}");
        }
        assert!(
            ticks(Axis::log("a", "W").between(1e-299, 1e299), 7.0)
                .1
                .len()
                <= 15
        );
    }
}
