//! A bifurcation diagram: points from integration over the continued branches.

use super::branches::{BranchLine, panel};
use crate::{Axis, Colour, Figure, Marker, Panel, Series};

/// Points from integration with one name.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramDots {
    /// Name: `stepped up`, `1a`.
    pub label: String,
    /// Parameter of each point.
    pub parameter: Vec<f64>,
    /// Value of each point.
    pub value: Vec<f64>,
}

/// One panel of a diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramView {
    /// Value axis.
    pub value: Axis,
    /// Continued branches.
    pub lines: Vec<BranchLine>,
    /// Points from integration.
    pub dots: Vec<DiagramDots>,
}

/// Number of colours for branches; those of dots follow.
const FIRST_COLOUR: usize = 3;

/// Markers of dots, in order.
const MARKERS: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Ring, Marker::Right];

/// Draws panels over one parameter.
pub fn diagram(title: &str, parameter: &Axis, views: &[DiagramView]) -> Figure {
    let mut figure = Figure::new(title);
    for view in views {
        let mut figure_panel = panel(
            Panel::new(parameter.clone(), view.value.clone()).high(340.0),
            &view.lines,
            &[],
        );
        for (k, dots) in view.dots.iter().enumerate() {
            let points = Series::points(
                dots.parameter.clone(),
                dots.value.clone(),
                MARKERS[k % MARKERS.len()],
            );
            figure_panel = figure_panel.with(
                points
                    .colour(Colour::nth(FIRST_COLOUR + k))
                    .label(&dots.label),
            );
        }
        if !figure.panels.is_empty() {
            // The legend is in the first panel.
            figure_panel.series.retain(|series| !series.x.is_empty());
            figure_panel
                .series
                .iter_mut()
                .for_each(|series| series.label = None);
        }
        figure = figure.with(figure_panel);
    }
    figure
}
