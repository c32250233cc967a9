//! Features before and after a fit.

use jounce_plot::{Along, Axis, Colour, Figure, Line, Marker, Panel, Series};

use crate::fit::{FitResult, FittedCurve, FittedFeature};

/// Plots the relative error of every feature before and after, in percent, with vertical lines for
/// the 95 % confidence intervals of the measurement. Each measured curve is shown with the model
/// before and after, and the 95 % prediction interval.
pub fn fitted(title: &str, result: &FitResult) -> Figure {
    let mut panels = Vec::new();
    if !result.features.is_empty() {
        panels.push(numbers(result));
    }
    panels.extend(result.curves.iter().map(curve));
    Figure {
        panels,
        ..Figure::new(title)
    }
}

fn numbers(result: &FitResult) -> Panel {
    let number: Vec<f64> = (1..=result.features.len()).map(|k| k as f64).collect();
    let percent = |value: &dyn Fn(&FittedFeature) -> f64| {
        result
            .features
            .iter()
            .map(|feature| 100.0 * value(feature))
            .collect::<Vec<f64>>()
    };
    let bar = |(k, feature): (usize, &FittedFeature)| {
        let half = 100.0 * result.quantile * feature.deviation;
        [-half, half, f64::NAN].map(|error| ((k + 1) as f64, error))
    };
    let (x, y): (Vec<f64>, Vec<f64>) = result.features.iter().enumerate().flat_map(bar).unzip();
    let axes = Panel::new(
        Axis::linear("Feature", "").every(1.0),
        Axis::linear("Model over measurement - 1", "%"),
    )
    .high(320.0);
    let interval = Series::line(x, y)
        .colour(Colour::Grey)
        .style(Line::Thin)
        .label("95 % interval of the measurement");
    let initial = Series::points(
        number.clone(),
        percent(&|feature| feature.errors().0),
        Marker::Ring,
    )
    .colour(Colour::nth(1))
    .label("before");
    let fitted = Series::points(
        number,
        percent(&|feature| feature.errors().1),
        Marker::Circle,
    )
    .label("after");
    axes.reference(Along::Y, 0.0, None)
        .with(interval)
        .with(initial)
        .with(fitted)
}

fn curve(curve: &FittedCurve) -> Panel {
    let (name, unit) = if curve.over == "time_s" {
        ("Time", "s")
    } else {
        ("Frequency", "Hz")
    };
    let line = |values: &[f64]| Series::line(curve.at.clone(), values.to_vec());
    Panel::new(
        Axis::linear(name, unit),
        Axis::linear(&curve.name, &curve.unit),
    )
    .high(240.0)
    .with(
        line(&curve.low)
            .colour(Colour::Grey)
            .style(Line::Thin)
            .label("95 % interval of a measurement"),
    )
    .with(line(&curve.high).colour(Colour::Grey).style(Line::Thin))
    .with(
        line(&curve.before)
            .colour(Colour::nth(1))
            .style(Line::Thin)
            .label("before"),
    )
    .with(line(&curve.after).label("after"))
    .with(
        Series::points(curve.at.clone(), curve.measured.clone(), Marker::Ring)
            .colour(Colour::nth(2))
            .label("measured"),
    )
}
