//! Mode shapes along a beam, with its patches shaded.

use crate::{Along, Axis, Colour, Figure, Panel, Series};

/// One shape, scaled to a largest value of one when drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeShape {
    /// Name in the legend: `1: 8.67 Hz`.
    pub label: String,
    /// Displacement at each position, in any unit.
    pub displacement: Vec<f64>,
}

/// A patch on the beam.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapePatch {
    /// Name in the legend.
    pub label: String,
    /// Distance of the start from the root, m.
    pub start_m: f64,
    /// Distance of the end from the root, m.
    pub end_m: f64,
}

/// Draws shapes over the positions `position_m` along the beam, each scaled to one.
pub fn mode_shapes(
    title: &str,
    position_m: &[f64],
    shapes: &[ModeShape],
    patches: &[ShapePatch],
) -> Figure {
    let mut panel = Panel::new(
        Axis::linear("Position along the beam", "m"),
        Axis::linear("Shape, scaled to one", ""),
    )
    .high(320.0);
    panel = panel.reference(Along::Y, 0.0, None);
    for patch in patches {
        panel = panel.band(Along::X, patch.start_m, patch.end_m, Some(&patch.label));
    }
    for (index, shape) in shapes.iter().enumerate() {
        let series = Series::line(position_m.to_vec(), scaled(&shape.displacement));
        panel = panel.with(series.label(&shape.label).colour(Colour::nth(index)));
    }
    Figure::new(title).with(panel)
}

/// Divides by the value of largest magnitude, so that it becomes +1.
fn scaled(values: &[f64]) -> Vec<f64> {
    let largest = values
        .iter()
        .copied()
        .filter(|x| x.is_finite())
        .fold(
            0.0,
            |largest: f64, x| if x.abs() > largest.abs() { x } else { largest },
        );
    values
        .iter()
        .map(|x| if largest == 0.0 { *x } else { x / largest })
        .collect()
}
