//! Branches of periodic solutions: stable segments solid, unstable ones dashed, bifurcations
//! marked.

use crate::{Axis, Colour, Figure, Line, Marker, Panel, Series};

/// One branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchLine {
    /// Name: `period 1`.
    pub label: String,
    /// Colour, the same for all lines of one name.
    pub colour: Colour,
    /// Parameter along the curve.
    pub parameter: Vec<f64>,
    /// Result.
    pub value: Vec<f64>,
    /// True for each stable point.
    pub stable: Vec<bool>,
}

/// A marked point.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchMark {
    /// Kind: marks of one kind have the same style.
    pub kind: String,
    /// Parameter.
    pub parameter: f64,
    /// Result.
    pub value: f64,
}

/// Returns the marker of an event by its kind; that of a level, whose kind is its text, for others.
pub fn event_marker(kind: &str) -> Marker {
    match kind {
        "fold" => Marker::Square,
        "period-doubling" => Marker::Triangle,
        "neimark-sacker" => Marker::Diamond,
        "branch-point" => Marker::Cross,
        "grazing" => Marker::Circle,
        "sticking" => Marker::Ring,
        _ => Marker::Right,
    }
}

/// Returns the colour of curves of a kind of event, the same in every picture; grey for levels.
pub(super) fn event_colour(kind: &str) -> Colour {
    match kind {
        "fold" => Colour::Blue,
        "period-doubling" => Colour::Vermilion,
        "neimark-sacker" => Colour::Green,
        "branch-point" => Colour::Purple,
        "grazing" => Colour::Orange,
        "sticking" => Colour::Sky,
        "peak" => Colour::Ink,
        _ => Colour::Grey,
    }
}

/// Draws branches in one panel.
pub fn branches(
    title: &str,
    parameter: Axis,
    value: Axis,
    lines: &[BranchLine],
    marks: &[BranchMark],
) -> Figure {
    Figure::new(title).with(panel(
        Panel::new(parameter, value).high(380.0),
        lines,
        marks,
    ))
}

/// Draws branches into a panel.
pub(super) fn panel(mut panel: Panel, lines: &[BranchLine], marks: &[BranchMark]) -> Panel {
    let mut labels: Vec<&str> = Vec::new();
    for line in lines {
        let colour = line.colour;
        for (stable, style) in [(true, Line::Solid), (false, Line::Dashed)] {
            let values = stability_values(line, stable);
            if values.iter().any(|value| value.is_finite()) {
                panel = panel.with(
                    Series::line(line.parameter.clone(), values)
                        .style(style)
                        .colour(colour),
                );
            }
        }
        if !labels.contains(&line.label.as_str()) {
            labels.push(&line.label);
            panel = panel.with(Series::key(&line.label, Some(Line::Solid), None).colour(colour));
        }
    }
    if lines.iter().any(|line| line.stable.contains(&false)) {
        panel = panel.with(Series::key("unstable", Some(Line::Dashed), None));
    }
    let mut kinds: Vec<&str> = Vec::new();
    marks.iter().for_each(|mark| {
        if !kinds.contains(&mark.kind.as_str()) {
            kinds.push(&mark.kind);
        }
    });
    for kind in kinds {
        let (x, y) = marks
            .iter()
            .filter(|mark| mark.kind == kind)
            .map(|mark| (mark.parameter, mark.value))
            .unzip();
        let points = Series::points(x, y, event_marker(kind));
        panel = panel.with(points.colour(Colour::Ink).label(kind));
    }
    panel
}

/// Returns the values on segments of one stability, gaps elsewhere; a segment extends to the next
/// point, so that segments join.
fn stability_values(line: &BranchLine, stable: bool) -> Vec<f64> {
    (0..line.value.len())
        .map(|k| {
            let is_member = line.stable[k] == stable;
            let before = k > 0 && line.stable[k - 1] == stable;
            if is_member || before {
                line.value[k]
            } else {
                f64::NAN
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stable_segments_join_with_gaps_elsewhere() {
        let line = BranchLine {
            label: "period 1".into(),
            colour: Colour::of_period(1),
            parameter: vec![1.0, 2.0, 3.0, 4.0],
            value: vec![5.0, 6.0, 7.0, 8.0],
            stable: vec![true, true, false, false],
        };
        let (solid, dashed) = (
            stability_values(&line, true),
            stability_values(&line, false),
        );
        assert_eq!(solid[..3], [5.0, 6.0, 7.0]);
        assert!(solid[3].is_nan() && dashed[0].is_nan() && dashed[1].is_nan());
        assert_eq!(dashed[2..], [7.0, 8.0]);
    }
}
