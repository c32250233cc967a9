//! Features before and after a fit.

use jounce::picture::{Along, Axis, Colour, Figure, Line, Marker, Panel, Series};

use crate::fit::{FitAnswer, FittedFeature};

/// Relative error of every feature before and after, in percent; upright lines are the intervals of 95 % of the measurement.
pub fn fitted(title: &str, answer: &FitAnswer) -> Figure {
    let number: Vec<f64> = (1..=answer.features.len()).map(|k| k as f64).collect();
    let percent = |of: &dyn Fn(&FittedFeature) -> f64| answer.features.iter().map(|feature| 100.0 * of(feature)).collect::<Vec<f64>>();
    let upright = |(k, feature): (usize, &FittedFeature)| {
        let half = 196.0 * feature.deviation;
        [-half, half, f64::NAN].map(|error| ((k + 1) as f64, error))
    };
    let (x, y): (Vec<f64>, Vec<f64>) = answer.features.iter().enumerate().flat_map(upright).unzip();
    let axes = Panel::new(Axis::linear("Feature", "").every(1.0), Axis::linear("Model over measurement - 1", "%")).high(320.0);
    let interval = Series::line(x, y).colour(Colour::Grey).style(Line::Thin).label("95 % interval of the measurement");
    let before =
        Series::points(number.clone(), percent(&|feature| feature.errors().0), Marker::Ring).colour(Colour::nth(1)).label("before");
    let after = Series::points(number, percent(&|feature| feature.errors().1), Marker::Circle).label("after");
    Figure::new(title).with(axes.reference(Along::Y, 0.0, None).with(interval).with(before).with(after))
}
