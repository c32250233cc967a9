//! Bifurcation curves over two parameters: curves of one kind share a line style and a colour.

use crate::{Axis, Colour, Figure, Line, Panel, Series};

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct BifurcationLine {
    /// Kind of bifurcation: `fold`.
    pub kind: String,
    /// First parameter.
    pub x: Vec<f64>,
    /// Second parameter.
    pub y: Vec<f64>,
}

/// Draws curves over two parameters.
pub fn bifurcations(title: &str, x: Axis, y: Axis, lines: &[BifurcationLine]) -> Figure {
    let mut panel = Panel::new(x, y).high(380.0);
    let mut kinds: Vec<&str> = Vec::new();
    for line in lines {
        let known = kinds.iter().position(|kind| *kind == line.kind);
        let colour = Colour::nth(known.unwrap_or(kinds.len()));
        panel = panel.with(Series::line(line.x.clone(), line.y.clone()).colour(colour));
        if known.is_none() {
            kinds.push(&line.kind);
            panel = panel.with(Series::key(&line.kind, Some(Line::Solid), None).colour(colour));
        }
    }
    Figure::new(title).with(panel)
}
