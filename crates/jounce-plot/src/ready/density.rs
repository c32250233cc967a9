//! Power spectral densities, one panel each.

use crate::{Axis, Colour, Figure, Line, Panel, Series};

/// The power spectral density of one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct DensityLine {
    /// Name of the quantity.
    pub quantity: String,
    /// Unit.
    pub unit: String,
    /// Density at each frequency; values that are not positive are omitted.
    pub density: Vec<f64>,
    /// Ends of the confidence interval of each value; empty if there is none.
    pub interval: [Vec<f64>; 2],
}

/// Draws densities over `frequency_hz`, each in a panel of its own.
pub fn densities(title: &str, frequency_hz: &[f64], lines: &[DensityLine]) -> Figure {
    let in_unit = |values: &[f64]| {
        values
            .iter()
            .map(|value| if *value > 0.0 { *value } else { f64::NAN })
            .collect::<Vec<_>>()
    };
    lines.iter().fold(Figure::new(title), |figure, line| {
        let panel = Panel::new(
            Axis::linear("Frequency", "Hz"),
            Axis::log(&line.quantity, &line.unit),
        )
        .high(190.0);
        let ends = line.interval.iter().filter(|end| !end.is_empty());
        let panel = ends.enumerate().fold(panel, |panel, (k, end)| {
            let end = Series::line(frequency_hz.to_vec(), in_unit(end))
                .colour(Colour::nth(1))
                .style(Line::Thin);
            panel.with(if k == 0 {
                end.label("95 % interval")
            } else {
                end
            })
        });
        figure.with(panel.with(Series::line(frequency_hz.to_vec(), in_unit(&line.density))))
    })
}
