//! Values on a grid as coloured cells.
//!
//! Colours are those of viridis (S. van der Walt, N. Smith, 2015, public domain): larger values are
//! lighter, for colour-blind readers and in print too.

use std::fmt::Write as _;

use super::layout::Plot;
use crate::PictureError;
use crate::svg::{Svg, number};

/// Values on a grid, drawn behind all other elements of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Edges of the columns, ascending: one more than the number of columns.
    pub x: Vec<f64>,
    /// Edges of the rows, ascending.
    pub y: Vec<f64>,
    /// The columns, each with a value for every row; NaN leaves its cell empty.
    pub columns: Vec<Vec<f64>>,
    /// Values of the first and the last colour; values beyond also get that colour.
    pub range: (f64, f64),
}

const ANCHORS: [[f64; 3]; 11] = [
    [68.0, 1.0, 84.0],
    [72.0, 36.0, 117.0],
    [65.0, 68.0, 135.0],
    [53.0, 95.0, 141.0],
    [42.0, 120.0, 142.0],
    [33.0, 144.0, 141.0],
    [34.0, 168.0, 132.0],
    [66.0, 190.0, 113.0],
    [122.0, 209.0, 81.0],
    [189.0, 223.0, 38.0],
    [253.0, 231.0, 37.0],
];
/// Number of distinct colours.
const LEVELS: usize = 24;

impl Field {
    pub(super) fn check(&self) -> Result<(), PictureError> {
        let fault = |x, y| PictureError::Lengths {
            series: "a field".to_owned(),
            x,
            y,
        };
        if self.x.len() != self.columns.len() + 1 {
            return Err(fault(self.x.len(), self.columns.len() + 1));
        }
        match self
            .columns
            .iter()
            .find(|column| column.len() + 1 != self.y.len())
        {
            Some(column) => Err(fault(column.len() + 1, self.y.len())),
            None => Ok(()),
        }
    }

    fn level(&self, value: f64) -> Option<usize> {
        let share = ((value - self.range.0) / (self.range.1 - self.range.0)).clamp(0.0, 1.0);
        (!share.is_nan()).then(|| ((share * LEVELS as f64) as usize).min(LEVELS - 1))
    }

    /// Draws the cells: neighbours of one colour in a row are one rectangle, and one path holds all
    /// cells of a colour.
    pub(super) fn draw(&self, svg: &mut Svg, plot: &Plot<'_>) {
        let mut paths = vec![String::new(); LEVELS];
        for row in 0..self.y.len().saturating_sub(1) {
            let level = |column: usize| {
                self.columns
                    .get(column)
                    .and_then(|values| self.level(values[row]))
            };
            let mut from = 0;
            while from < self.columns.len() {
                let until = (from..self.columns.len())
                    .find(|column| level(*column) != level(from))
                    .unwrap_or(self.columns.len());
                let corners = plot
                    .pixel(self.x[from], self.y[row])
                    .zip(plot.pixel(self.x[until], self.y[row + 1]));
                if let (Some(level), Some(((left, low), (right, high)))) = (level(from), corners) {
                    let [x, y, w, h] = [left, high, right - left, low - high].map(number);
                    let _ = write!(paths[level], "M{x} {y}h{w}v{h}h-{w}z");
                }
                from = until;
            }
        }
        for (level, path) in paths.iter().enumerate() {
            svg.path(
                path,
                &format!(
                    "fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.3\"",
                    colour(level)
                ),
            );
        }
    }
}

/// Returns the colour of a level, interpolated linearly between the anchors.
fn colour(level: usize) -> String {
    let position = level as f64 / (LEVELS - 1) as f64 * (ANCHORS.len() - 1) as f64;
    let below = (position as usize).min(ANCHORS.len() - 2);
    let share = position - below as f64;
    let part = |k: usize| {
        (ANCHORS[below][k] + share * (ANCHORS[below + 1][k] - ANCHORS[below][k])).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", part(0), part(1), part(2))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::{Axis, Figure, Panel};

    fn draw_field(columns: Vec<Vec<f64>>) -> Result<String, PictureError> {
        let field = Field {
            x: vec![0.0, 1.0, 2.0, 3.0],
            y: vec![0.0, 1.0, 2.0],
            columns,
            range: (0.0, 1.0),
        };
        Figure::new("")
            .with(Panel::new(Axis::linear("", ""), Axis::linear("", "")).field(field))
            .to_svg()
    }

    #[test]
    fn equal_neighbours_are_one_cell_and_gaps_none() {
        let svg = draw_field(vec![vec![0.0, 1.0], vec![0.0, f64::NAN], vec![0.9999, 2.0]]).unwrap();
        let cells = |colour: &str| {
            svg.lines()
                .filter(|line| line.contains(colour))
                .map(|line| line.matches('M').count())
                .sum::<usize>()
        };
        // The lowest row has one rectangle over two columns; the highest colour occurs three times,
        // each apart.
        assert_eq!(
            (cells(&colour(0)), cells(&colour(LEVELS - 1))),
            (1, 3),
            "{svg}"
        );
        assert!(
            !svg.contains("no data") && colour(0) == "#440154" && colour(LEVELS - 1) == "#fde725"
        );
    }

    #[test]
    fn columns_that_do_not_fit_are_an_error() {
        assert!(matches!(
            draw_field(vec![vec![0.0, 1.0]; 2]),
            Err(PictureError::Lengths { .. })
        ));
        assert!(matches!(
            draw_field(vec![vec![0.0]; 3]),
            Err(PictureError::Lengths { .. })
        ));
    }
}
