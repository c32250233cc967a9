//! Mean power over the load, with its intervals.

use jounce_plot::{Axis, Colour, Figure, Line, Marker, Panel, Series};

/// Mean power of one record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadPoint {
    /// Load resistance, ohm.
    pub resistance_ohm: f64,
    /// Mean power, in the unit of the figure.
    pub power: f64,
    /// Half-width of its 95 % confidence interval.
    pub half_width: f64,
}

/// Plots mean power over resistance (logarithmic axis) with vertical lines for the 95 % confidence
/// intervals. `unit` is `W`, or `W/(m/s^2)^2` for power divided by the mean square of the base
/// acceleration.
pub fn power_over_load(title: &str, unit: &str, points: &[LoadPoint]) -> Figure {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.resistance_ohm.total_cmp(&b.resistance_ohm));
    let resistance: Vec<f64> = sorted.iter().map(|point| point.resistance_ohm).collect();
    let power: Vec<f64> = sorted.iter().map(|point| point.power).collect();
    let bar = |point: &LoadPoint| {
        // A gap after each line separates it from the next one.
        [
            (point.power - point.half_width),
            (point.power + point.half_width),
            f64::NAN,
        ]
        .map(|power| (point.resistance_ohm, power))
    };
    let (x, y): (Vec<f64>, Vec<f64>) = sorted.iter().flat_map(bar).unzip();
    let panel = Panel::new(
        Axis::log("Load resistance", "ohm"),
        Axis::linear("Mean power", unit),
    )
    .high(320.0);
    let means = Series::line(resistance, power)
        .style(Line::Thin)
        .marker(Marker::Circle)
        .label("mean of a record");
    let intervals = Series::line(x, y)
        .colour(Colour::Ink)
        .label("95 % interval");
    Figure::new(title).with(panel.with(intervals).with(means))
}
