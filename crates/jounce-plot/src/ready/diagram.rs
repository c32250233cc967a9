//! A bifurcation diagram: points from integration over the continued branches.

use super::branches::{BranchLine, panel};
use crate::{Axis, Colour, Figure, Marker, Panel, Series};

/// Points from integration with one name.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramDots {
    /// Name: `1a`, or the direction of the steps.
    pub label: String,
    /// Colour of all points.
    pub colour: Colour,
    /// Marker of all points.
    pub marker: Marker,
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

/// Draws panels over one parameter.
pub fn diagram(title: &str, parameter: &Axis, views: &[DiagramView]) -> Figure {
    let mut figure = Figure::new(title);
    for view in views {
        let mut figure_panel = panel(
            Panel::new(parameter.clone(), view.value.clone()).high(340.0),
            &view.lines,
            &[],
        );
        for dots in &view.dots {
            let (parameter, value) = (dots.parameter.clone(), dots.value.clone());
            let points = Series::points(parameter, value, dots.marker);
            figure_panel = figure_panel.with(points.colour(dots.colour).label(&dots.label));
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
