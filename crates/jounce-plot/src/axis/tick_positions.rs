//! Positions of the ticks of an axis: equal steps or parts of decades.

use super::log_labels::{LogLabels, log_labels, of_decades};
use super::span::Span;
use crate::{Axis, Scale};

/// Returns the values of the major and minor ticks, and the decimals of the labels if the steps are
/// equal.
pub(super) fn tick_positions(
    axis: &Axis,
    span: &Span,
    factor: f64,
    room: f64,
) -> (Vec<f64>, Vec<f64>, Option<i32>) {
    match span.scale {
        Scale::Linear => {
            let (major, minor, decimals) =
                equal_steps(axis.step.map(|step| step / factor), span, factor, room);
            (major, minor, Some(decimals))
        }
        Scale::Log => decade_steps(span, factor, room),
    }
}

/// Labels of a logarithmic axis may be as near as half of the mean distance on a linear one: their
/// distances differ.
const NEAREST: f64 = 0.5;

fn decade_steps(span: &Span, factor: f64, room: f64) -> (Vec<f64>, Vec<f64>, Option<i32>) {
    let LogLabels { values, step } = log_labels(span.low, span.high, NEAREST / room);
    if let Some(step) = step {
        let decimals = -((step / factor).log10() + 1e-9).floor() as i32;
        let (_, minor, _) = equal_steps(Some(step / factor), span, factor, room);
        return (values, minor, Some(decimals));
    }
    let has_each_decade = values
        .windows(2)
        .all(|pair| pair[1] / pair[0] < 10.0 * (1.0 + 1e-9));
    let mantissas = if has_each_decade {
        &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0][..]
    } else {
        &[1.0]
    };
    (values, of_decades(span.low, span.high, mantissas), None)
}

fn equal_steps(
    requested: Option<f64>,
    span: &Span,
    factor: f64,
    room: f64,
) -> (Vec<f64>, Vec<f64>, i32) {
    let (low, high) = (span.low / factor, span.high / factor);
    let rough = (high - low) / room;
    let exponent = (rough.log10() + 1e-9).floor() as i32;
    let (mantissa, parts) = match rough / 10f64.powi(exponent) {
        m if m <= 1.000_001 => (1.0, 5.0),
        m if m <= 2.0 => (2.0, 4.0),
        m if m <= 5.0 => (5.0, 5.0),
        _ => (10.0, 5.0),
    };
    let (step, parts, decimals) = match requested {
        // Thirds of 90 degrees, fifths otherwise.
        Some(step) if step > 0.0 && (high - low) / step < 50.0 => (
            step,
            if step % 3.0 == 0.0 { 3.0 } else { 5.0 },
            decimals_of(step),
        ),
        _ => (
            mantissa * 10f64.powi(exponent),
            parts,
            if mantissa >= 10.0 {
                -exponent - 1
            } else {
                -exponent
            },
        ),
    };
    let multiples = |step: f64| {
        let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        (0..=(last - first).max(-1.0) as i64)
            .map(move |i| (first + i as f64) * step * factor)
            .take(((last - first).max(-1.0) + 1.0) as usize)
    };
    (
        multiples(step).collect(),
        multiples(step / parts).collect(),
        decimals,
    )
}

fn decimals_of(step: f64) -> i32 {
    (0..12)
        .find(|&d| (step * 10f64.powi(d)).fract().abs() < 1e-9)
        .unwrap_or(12)
}
