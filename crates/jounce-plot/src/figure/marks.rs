//! Elements between the axes: bands, lines, markers, reference lines, notes.

use std::fmt::Write as _;

use super::curve::{path, runs};
use super::layout::Plot;
use super::panel::Along;
use crate::svg::{Anchor, Svg, number};
use crate::text::{SMALL, width};
use crate::{Colour, Line, Marker, Series};

/// Smallest distance of markers on a line, pixels.
const MARKER_DISTANCE: f64 = 14.0;

/// Draws all elements inside the frame except the markers, or the words "no data".
pub(super) fn marks(svg: &mut Svg, plot: &Plot<'_>) {
    svg.open_window(plot.left, plot.top, plot.width, plot.height);
    if let Some(field) = &plot.panel.field {
        field.draw(svg, plot);
    }
    bands(svg, plot);
    references(svg, plot);
    for series in &plot.panel.series {
        if let Some(line) = series.line {
            pixel_runs(plot, series)
                .iter()
                .for_each(|run| svg.path(&path(run), &line_style(line, series.colour)));
        }
    }
    svg.close_window();
    if !plot.has_data() {
        svg.text(
            plot.left + plot.width / 2.0,
            plot.top + plot.height / 2.0,
            SMALL,
            Anchor::Middle,
            "no data",
        );
    }
    names(svg, plot);
    notes(svg, plot);
}

/// Draws the markers over the frame: those at an end of an axis are not clipped.
pub(super) fn markers(svg: &mut Svg, plot: &Plot<'_>) {
    for series in &plot.panel.series {
        if let Some(marker) = series.marker {
            let points = marker_points(plot, series);
            let steps: String = points
                .iter()
                .map(|(x, y)| marker_path(marker, plot.left + x, plot.top + y, 1.0))
                .collect();
            svg.path(&steps, &marker_style(marker, series.colour));
        }
    }
}

/// Returns the segments of a series without gap, in pixels of the frame.
pub(super) fn pixel_runs(plot: &Plot<'_>, series: &Series) -> Vec<Vec<(f64, f64)>> {
    runs(
        series
            .x
            .iter()
            .zip(&series.y)
            .map(|(x, y)| plot.pixel(*x, *y)),
    )
}

/// Returns the attributes of a line.
pub(super) fn line_style(line: Line, colour: Colour) -> String {
    let (weight, dash) = match line {
        Line::Solid => ("1.8", ""),
        Line::Dashed => ("1.8", " stroke-dasharray=\"6 4\""),
        Line::Thin => ("1.1", ""),
    };
    let class = if colour == Colour::Ink {
        "class=\"jounce-rule\" "
    } else {
        ""
    };
    format!(
        "{class}fill=\"none\" stroke=\"{}\" stroke-width=\"{weight}\"{dash} stroke-linejoin=\"round\" stroke-linecap=\"round\"",
        colour.hex()
    )
}

/// Returns the attributes of a marker: filled, or open with white paper inside.
pub(super) fn marker_style(marker: Marker, colour: Colour) -> String {
    let rule = if colour == Colour::Ink {
        " jounce-rule"
    } else {
        ""
    };
    match marker {
        Marker::Ring | Marker::Left => {
            format!(
                "class=\"jounce-paper{rule}\" fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"1.2\"",
                colour.hex()
            )
        }
        _ => {
            let ink = if colour == Colour::Ink {
                "class=\"jounce-ink jounce-rule\" "
            } else {
                ""
            };
            format!(
                "{ink}fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.6\"",
                colour.hex()
            )
        }
    }
}

/// Returns the outline of a marker around a point.
pub(super) fn marker_path(marker: Marker, x: f64, y: f64, scale: f64) -> String {
    let at = |dx: f64, dy: f64| format!("{} {}", number(x + scale * dx), number(y + scale * dy));
    let polygon = |corners: &[(f64, f64)]| {
        let corners: Vec<String> = corners.iter().map(|(dx, dy)| at(*dx, *dy)).collect();
        format!("M{}z", corners.join("L"))
    };
    match marker {
        Marker::Circle | Marker::Ring => {
            let r = number(3.0 * scale);
            format!(
                "M{}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z",
                at(-3.0, 0.0),
                d = number(6.0 * scale)
            )
        }
        Marker::Square => polygon(&[(-2.7, -2.7), (2.7, -2.7), (2.7, 2.7), (-2.7, 2.7)]),
        Marker::Right => polygon(&[(-2.8, -3.6), (4.2, 0.0), (-2.8, 3.6)]),
        Marker::Left => polygon(&[(2.8, -3.6), (-4.2, 0.0), (2.8, 3.6)]),
        Marker::Triangle => polygon(&[(-3.6, 2.8), (0.0, -4.2), (3.6, 2.8)]),
        Marker::Diamond => polygon(&[(-3.8, 0.0), (0.0, -3.8), (3.8, 0.0), (0.0, 3.8)]),
        Marker::Cross => {
            let arm = [(0.0, -1.3), (2.2, -3.5), (3.5, -2.2)];
            let turned = (0..4).flat_map(|quarter| {
                arm.map(|(dx, dy)| match quarter {
                    0 => (dx, dy),
                    1 => (-dy, dx),
                    2 => (-dx, -dy),
                    _ => (dy, -dx),
                })
            });
            polygon(&turned.collect::<Vec<_>>())
        }
    }
}

/// Returns the points to mark: all in the frame; on a line, no two closer than the marker distance.
pub(super) fn marker_points(plot: &Plot<'_>, series: &Series) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for (x, y) in series
        .x
        .iter()
        .zip(&series.y)
        .filter(|(x, y)| plot.x.holds(**x) && plot.y.holds(**y))
    {
        let Some(point) = plot.pixel(*x, *y) else {
            continue;
        };
        let near =
            |before: &(f64, f64)| (point.0 - before.0).hypot(point.1 - before.1) < MARKER_DISTANCE;
        if series.line.is_none() || !points.last().is_some_and(near) {
            points.push(point);
        }
    }
    points
}

fn bands(svg: &mut Svg, plot: &Plot<'_>) {
    for band in &plot.panel.bands {
        let span = if band.along == Along::X {
            plot.x
        } else {
            plot.y
        };
        let (Some(low), Some(high)) = (span.fraction(band.low), span.fraction(band.high)) else {
            continue;
        };
        let (low, high) = (low.min(high).clamp(0.0, 1.0), low.max(high).clamp(0.0, 1.0));
        let (x, y, w, h) = match band.along {
            Along::X => (
                low * plot.width,
                0.0,
                (high - low) * plot.width,
                plot.height,
            ),
            Along::Y => (
                0.0,
                (1.0 - high) * plot.height,
                plot.width,
                (high - low) * plot.height,
            ),
        };
        svg.rect(x, y, w, h, &band_style(band.colour));
    }
}

/// Returns the attributes of a shaded range.
pub(super) fn band_style(colour: Colour) -> String {
    format!("fill=\"{}\" fill-opacity=\"0.22\"", colour.hex())
}

fn references(svg: &mut Svg, plot: &Plot<'_>) {
    let mut steps = String::new();
    for line in &plot.panel.references {
        let _ = match line.along {
            Along::X => plot.x.fraction(line.value).map(|x| {
                write!(
                    steps,
                    "M{} 0v{}",
                    number(x * plot.width),
                    number(plot.height)
                )
            }),
            Along::Y => plot.y.fraction(line.value).map(|y| {
                write!(
                    steps,
                    "M0 {}h{}",
                    number((1.0 - y) * plot.height),
                    number(plot.width)
                )
            }),
        };
    }
    svg.path(
        &steps,
        &format!(
            "fill=\"none\" stroke=\"{}\" stroke-width=\"1\" stroke-dasharray=\"1.5 3\"",
            Colour::Grey.hex()
        ),
    );
}

/// Draws the names of reference lines outside the frame; a name that would touch an earlier one is
/// omitted.
fn names(svg: &mut Svg, plot: &Plot<'_>) {
    // Centre and half width of each placed name.
    let (mut across, mut down) = (Vec::<(f64, f64)>::new(), Vec::<(f64, f64)>::new());
    for line in &plot.panel.references {
        let Some(name) = &line.label else { continue };
        let (span, start) = if line.along == Along::X {
            (plot.x, &mut across)
        } else {
            (plot.y, &mut down)
        };
        let Some(position) = span.fraction(line.value).filter(|_| span.holds(line.value)) else {
            continue;
        };
        let (centre, half) = match line.along {
            Along::X => (position * plot.width, width(name, SMALL) / 2.0 + 3.0),
            Along::Y => ((1.0 - position) * plot.height, SMALL * 0.6),
        };
        if start
            .iter()
            .any(|(other, reach)| (centre - other).abs() < half + reach)
        {
            continue;
        }
        start.push((centre, half));
        match line.along {
            Along::X => svg.text(
                plot.left + centre,
                plot.top - 5.0,
                SMALL,
                Anchor::Middle,
                name,
            ),
            Along::Y => svg.text(
                plot.left + plot.width + 6.0,
                plot.top + centre + 0.36 * SMALL,
                SMALL,
                Anchor::Start,
                name,
            ),
        }
    }
}

fn notes(svg: &mut Svg, plot: &Plot<'_>) {
    for note in &plot.panel.notes {
        let Some((x, y)) = plot
            .pixel(note.x, note.y)
            .filter(|_| plot.x.holds(note.x) && plot.y.holds(note.y))
        else {
            continue;
        };
        let half = width(&note.text, SMALL) / 2.0 + 4.0;
        let x = x.clamp(
            half.min(plot.width / 2.0),
            (plot.width - half).max(plot.width / 2.0),
        );
        // Above the point if there is room, else below it.
        let y = if y > 1.6 * SMALL {
            y - 7.0
        } else {
            y + SMALL + 6.0
        };
        svg.text(
            plot.left + x,
            plot.top + y,
            SMALL,
            Anchor::Middle,
            &note.text,
        );
    }
}
