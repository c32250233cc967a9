//! Bifurcation curves over two parameters: each kind has its colour, and levels differ by their
//! lines.

use super::branches::event_colour;
use crate::{Axis, Colour, Figure, Line, Panel, Series};
use std::collections::BTreeSet;

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct BifurcationLine {
    /// Kind of bifurcation: `fold`; the text of a level.
    pub kind: String,
    /// First parameter.
    pub x: Vec<f64>,
    /// Second parameter.
    pub y: Vec<f64>,
}

/// Lines of levels, in the order of their texts.
const LEVEL_LINES: [Line; 3] = [Line::Solid, Line::Dashed, Line::Thin];

/// Draws curves over two parameters.
pub fn bifurcations(title: &str, x: Axis, y: Axis, lines: &[BifurcationLine]) -> Figure {
    let mut panel = Panel::new(x, y).high(380.0);
    let levels: BTreeSet<&str> = lines
        .iter()
        .map(|line| line.kind.as_str())
        .filter(|kind| event_colour(kind) == Colour::Grey)
        .collect();
    let mut kinds: Vec<&str> = Vec::new();
    for line in lines {
        let colour = event_colour(&line.kind);
        let level = levels.iter().position(|level| *level == line.kind);
        let style = LEVEL_LINES[level.unwrap_or(0) % LEVEL_LINES.len()];
        let series = Series::line(line.x.clone(), line.y.clone());
        panel = panel.with(series.style(style).colour(colour));
        if !kinds.contains(&line.kind.as_str()) {
            kinds.push(&line.kind);
            panel = panel.with(Series::key(&line.kind, Some(style), None).colour(colour));
        }
    }
    Figure::new(title).with(panel)
}
