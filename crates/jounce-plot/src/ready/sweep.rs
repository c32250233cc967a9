//! Sweeps: a result over a parameter stepped up and down, at several levels (figure 6 of the
//! paper).

use crate::{Axis, Colour, Figure, Line, Marker, Panel, Scale, Series};

/// Direction of the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LineDirection {
    /// From low to high: solid line, filled triangles to the right.
    Up,
    /// From high to low: dashed line, open triangles to the left.
    Down,
    /// Independent points: circles without a line.
    Independent,
    /// A closed form: a grey line.
    Linear,
}

/// Words of the legend for steps from low to high.
pub const UP_WORDS: &str = "up: increasing values";

/// Words of the legend for steps from high to low.
pub const DOWN_WORDS: &str = "down: decreasing values";

/// One sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepLine {
    /// Level or case, the same for both directions of one level: `50 N`.
    pub label: String,
    /// Direction.
    pub direction: LineDirection,
    /// Parameter, in its SI unit.
    pub parameter: Vec<f64>,
    /// Result at each step.
    pub value: Vec<f64>,
    /// True for each step that had settled; empty if all had. Unsettled steps get a ring.
    pub settled: Vec<bool>,
}

/// Axes of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepLook {
    /// Parameter: `Drive frequency`, `Hz`.
    pub parameter: Axis,
    /// Result: `Mean power per force squared`, `W/N^2`.
    pub value: Axis,
}

impl SweepLook {
    /// Returns the axes of normalised mean power over drive frequency, as in the paper's figure 6.
    pub fn power_over_frequency(scale: Scale) -> Self {
        Self {
            parameter: Axis::linear("Drive frequency", "Hz"),
            value: Axis::of(scale, "Mean power per force squared", "W/N^2"),
        }
    }
}

/// Draws sweeps in one panel: a colour for each level, the direction by line and marker.
pub fn sweep(title: &str, style: &SweepLook, lines: &[SweepLine]) -> Figure {
    let mut panel = Panel::new(style.parameter.clone(), style.value.clone()).high(380.0);
    let levels = levels(lines);
    let both_ways = lines
        .iter()
        .any(|line| line.direction == LineDirection::Down);
    let mut named: Vec<&str> = Vec::new();
    for line in lines {
        let series = sweep_series(line, &levels);
        if named.contains(&line.label.as_str()) {
            panel = panel.with(series);
            continue;
        }
        named.push(&line.label);
        // If both directions are in the picture, only the colour shows the level; a separate key
        // explains lines and markers. A single level needs no name.
        let is_stepped = matches!(line.direction, LineDirection::Up | LineDirection::Down);
        panel = if both_ways && is_stepped && levels.len() == 1 {
            panel.with(series)
        } else if both_ways && line.direction != LineDirection::Independent {
            panel
                .with(Series::key(&line.label, Some(Line::Solid), None).colour(series.colour))
                .with(series)
        } else {
            panel.with(series.label(&line.label))
        };
    }
    for line in lines.iter().filter(|line| line.settled.contains(&false)) {
        panel = panel.with(unsettled(line));
    }
    let colour = match levels.len() {
        1 => Colour::nth(0),
        _ => Colour::Ink,
    };
    let keys = keys(lines).into_iter();
    panel.series.extend(keys.map(|key| key.colour(colour)));
    panel.series.extend(unsettled_key(lines));
    Figure::new(title).with(panel)
}

/// Returns the levels with a colour, in their order of appearance.
fn levels(lines: &[SweepLine]) -> Vec<&str> {
    let mut levels: Vec<&str> = Vec::new();
    for line in lines
        .iter()
        .filter(|line| line.direction != LineDirection::Linear)
    {
        if !levels.contains(&line.label.as_str()) {
            levels.push(&line.label);
        }
    }
    levels
}

fn sweep_series(line: &SweepLine, levels: &[&str]) -> Series {
    let colour = Colour::nth(
        levels
            .iter()
            .position(|level| *level == line.label)
            .unwrap_or(0),
    );
    let series = Series::line(line.parameter.clone(), line.value.clone()).colour(colour);
    match line.direction {
        LineDirection::Up => series.marker(Marker::Right),
        LineDirection::Down => series.style(Line::Dashed).marker(Marker::Left),
        LineDirection::Independent => Series {
            line: None,
            ..series.marker(Marker::Circle)
        },
        LineDirection::Linear => series.colour(Colour::Grey),
    }
}

fn unsettled(line: &SweepLine) -> Series {
    let points = line
        .parameter
        .iter()
        .zip(&line.value)
        .zip(&line.settled)
        .filter(|(_, settled)| !**settled);
    let (x, y) = points.map(|((x, y), _)| (*x, *y)).unzip();
    Series::points(x, y, Marker::Ring).colour(Colour::Ink)
}

/// Returns the key of lines and markers, if more than one is used.
fn keys(lines: &[SweepLine]) -> Vec<Series> {
    let has = |direction| lines.iter().any(|line| line.direction == direction);
    let mut keys = Vec::new();
    if has(LineDirection::Up) && (has(LineDirection::Down) || has(LineDirection::Linear)) {
        keys.push(Series::key(
            UP_WORDS,
            Some(Line::Solid),
            Some(Marker::Right),
        ));
    }
    if has(LineDirection::Down) {
        keys.push(Series::key(
            DOWN_WORDS,
            Some(Line::Dashed),
            Some(Marker::Left),
        ));
    }
    keys
}

fn unsettled_key(lines: &[SweepLine]) -> Option<Series> {
    let has_unsettled = lines.iter().any(|line| line.settled.contains(&false));
    has_unsettled.then(|| Series::key("not settled", None, Some(Marker::Ring)))
}
