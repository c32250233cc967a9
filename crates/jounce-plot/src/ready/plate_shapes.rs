//! Mode shapes over a plate: one panel to scale for each mode, with its nodal lines.

use crate::{Axis, Colour, Field, Figure, Panel, Series};

/// One shape over a plate, scaled to a largest value of one when drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateShape {
    /// Name of the mode: `1: 8.67 Hz`.
    pub label: String,
    /// Displacement in the middle of each cell: columns along the length, each with a value for
    /// every cell across the width; in any unit.
    pub columns: Vec<Vec<f64>>,
}

/// Width of the frame of a panel, px, about.
const FRAME_PX: f64 = 620.0;

/// Height of the frame of a picture of a motion, px, and its largest width.
const MOTION_PX: (f64, f64) = (110.0, 260.0);
/// Room next to the frame for its labels, px.
const LABELS_PX: f64 = 100.0;

/// Draws the shapes over a plate of given length and width, m. Colours go from the largest negative
/// to the largest positive displacement; the nodal lines are dark.
pub fn plate_shapes(title: &str, [length_m, width_m]: [f64; 2], shapes: &[PlateShape]) -> Figure {
    let height_px = (FRAME_PX * width_m / length_m).clamp(40.0, FRAME_PX);
    let panel = |shape: &PlateShape| {
        let largest = largest(&shape.columns);
        panel(
            "Position along the plate",
            shape,
            [length_m, width_m],
            largest,
        )
        .high(height_px)
    };
    shapes.iter().fold(Figure::new(title), |figure, shape| {
        figure.with(panel(shape))
    })
}

/// Draws the displacement of a plate at each instant of a motion, as one small figure each. The
/// colours go from the negative to the positive of the displacement `largest`, the same at all
/// instants; displacements as in [`PlateShape::columns`].
pub fn plate_motion(
    [length_m, width_m]: [f64; 2],
    instants: &[Vec<Vec<f64>>],
    largest: f64,
) -> Vec<Figure> {
    let px_per_m = (MOTION_PX.0 / width_m).min(MOTION_PX.1 / length_m);
    let picture = |columns: &Vec<Vec<f64>>| {
        let shape = PlateShape {
            label: String::new(),
            columns: columns.clone(),
        };
        let panel = panel("", &shape, [length_m, width_m], largest);
        let mut figure = Figure::new("").with(panel.high((px_per_m * width_m).max(40.0)));
        figure.width_px = LABELS_PX + (px_per_m * length_m).max(80.0);
        figure
    };
    instants.iter().map(picture).collect()
}

fn largest(columns: &[Vec<f64>]) -> f64 {
    (columns.iter().flatten()).fold(0.0_f64, |max, w| max.max(w.abs()))
}

/// Returns the filled contours of a shape with its nodal lines.
fn panel(along: &str, shape: &PlateShape, [length_m, width_m]: [f64; 2], largest: f64) -> Panel {
    let edges = |count: usize, size_m: f64| -> Vec<f64> {
        (0..=count)
            .map(|k| size_m * k as f64 / count as f64)
            .collect()
    };
    let rows = shape.columns.first().map_or(0, Vec::len);
    let field = Field {
        x: edges(shape.columns.len(), length_m),
        y: edges(rows, width_m),
        columns: shape.columns.clone(),
        range: (-largest, largest),
    };
    let [x, y] = nodal_lines(&shape.columns, [length_m, width_m]);
    Panel::new(
        Axis::linear(along, "m").between(0.0, length_m),
        Axis::linear(&shape.label, "m").between(0.0, width_m),
    )
    .field(field)
    .with(Series::line(x, y).colour(Colour::Ink))
}

/// Returns the lines on which a shape is zero, as segments apart from each other by NaN. The shape is
/// linear along the sides of the squares between the middles of the cells.
fn nodal_lines(columns: &[Vec<f64>], [length_m, width_m]: [f64; 2]) -> [Vec<f64>; 2] {
    let mut lines = [Vec::new(), Vec::new()];
    let rows = columns.first().map_or(0, Vec::len);
    let place = |i: f64, j: f64| {
        [
            length_m * (i + 0.5) / columns.len() as f64,
            width_m * (j + 0.5) / rows as f64,
        ]
    };
    for i in 1..columns.len() {
        for j in 1..rows {
            let corners = [(i - 1, j - 1), (i, j - 1), (i, j), (i - 1, j)];
            let mut crossings = Vec::new();
            for side in 0..4 {
                let [a, b] = [corners[side], corners[(side + 1) % 4]];
                let [from, to] = [a, b].map(|(i, j)| columns[i][j]);
                if (from > 0.0) != (to > 0.0) {
                    let share = from / (from - to);
                    let between = |a: usize, b: usize| a as f64 + share * (b as f64 - a as f64);
                    crossings.push(place(between(a.0, b.0), between(a.1, b.1)));
                }
            }
            for pair in crossings.chunks_exact(2) {
                for (axis, line) in lines.iter_mut().enumerate() {
                    line.extend([pair[0][axis], pair[1][axis], f64::NAN]);
                }
            }
        }
    }
    lines
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// `w = x - y` on a square: the nodal line is its diagonal.
    #[test]
    fn nodal_lines_are_where_a_shape_is_zero() {
        let at = |k: usize| (k as f64 + 0.5) / 20.0;
        let columns: Vec<Vec<f64>> = (0..20)
            .map(|i| (0..20).map(|j| at(i) - at(j)).collect())
            .collect();
        let [x, y] = nodal_lines(&columns, [1.0, 1.0]);
        let drawn = x.iter().zip(&y).filter(|(x, _)| !x.is_nan());
        assert!(x.len() > 50 && drawn.clone().all(|(x, y)| (x - y).abs() < 1e-12));
        let shape = PlateShape {
            label: "1: 8 Hz".to_owned(),
            columns,
        };
        let svg = plate_shapes("a", [1.0, 0.5], &[shape]).to_svg().unwrap();
        assert!(svg.contains("1: 8 Hz"));
    }

    /// The colours of a motion keep their meaning: half the largest displacement has not the colour
    /// of the largest.
    #[test]
    fn all_instants_of_a_motion_have_one_range() {
        let flat = |w: f64| vec![vec![w; 8]; 12];
        let figures = plate_motion([0.1, 0.06], &[flat(1.0), flat(0.5), flat(-1.0)], 1.0);
        let svg: Vec<String> = figures.iter().map(|f| f.to_svg().unwrap()).collect();
        let has = |k: usize, colour: &str| svg[k].contains(&format!("fill=\"{colour}\""));
        assert!(has(0, "#fde725") && !has(1, "#fde725") && has(2, "#440154"));
        assert!(!has(0, "#440154") && !has(2, "#fde725"));
    }
}
