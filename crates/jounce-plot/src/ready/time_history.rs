//! Time histories, one panel for each quantity over a common time.

use crate::{Axis, Colour, Figure, Line, Panel, Series};

/// A quantity over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Name of the quantity: `Voltage`.
    pub quantity: String,
    /// SI unit.
    pub unit: String,
    /// Value at each time.
    pub values: Vec<f64>,
}

/// Draws traces over the times `time_s`, stacked, as in the paper's figure 7.
pub fn time_histories(title: &str, time_s: &[f64], traces: &[Trace]) -> Figure {
    let height_px = if traces.len() > 1 { 170.0 } else { 280.0 };
    // A dense oscillation is more readable with a thin line.
    let line = if time_s.len() > 3000 {
        Line::Thin
    } else {
        Line::Solid
    };
    let panel = |(index, trace): (usize, &Trace)| {
        let series = Series::line(time_s.to_vec(), trace.values.clone())
            .style(line)
            .colour(Colour::nth(index));
        Panel::new(
            Axis::linear("Time", "s"),
            Axis::linear(&trace.quantity, &trace.unit),
        )
        .high(height_px)
        .with(series)
    };
    Figure {
        panels: traces.iter().enumerate().map(panel).collect(),
        ..Figure::new(title)
    }
}
