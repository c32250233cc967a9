//! Legend: in the corner where it covers no data, else at the right of the frame.

use super::curve::along;
use super::layout::Plot;
use super::marks::{band_style, line_style, marker_path, marker_points, marker_style, pixel_runs};
use crate::svg::{Anchor, Svg, number};
use crate::text::{SMALL, width};
use crate::{Panel, Series};

const ROW: f64 = 18.0;
const KEY: f64 = 28.0;
const PADDING: f64 = 8.0;
/// Free paper around a legend inside the frame, pixels.
const CLEAR: f64 = 6.0;

/// Position of a legend, from the upper left corner of the frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LegendPlace {
    /// Nothing to list.
    None,
    /// Inside the frame.
    Inside(f64, f64),
    /// At the right of the frame.
    Beside,
}

/// Returns the width and height of the legend of a panel; `None` if no element has a name.
pub(super) fn size(panel: &Panel) -> Option<(f64, f64)> {
    let names = names(panel);
    let widest = names
        .iter()
        .map(|name| width(name, SMALL))
        .fold(0.0, f64::max);
    (!names.is_empty()).then_some((
        widest + KEY + 3.0 * PADDING,
        names.len() as f64 * ROW + PADDING,
    ))
}

fn names(panel: &Panel) -> Vec<&str> {
    let series = panel
        .series
        .iter()
        .filter_map(|series| series.label.as_deref());
    series
        .chain(panel.bands.iter().filter_map(|band| band.label.as_deref()))
        .collect()
}

/// Returns the first position in the frame that covers no data; if there is none, the right of the
/// frame.
pub(super) fn place(plot: &Plot<'_>) -> LegendPlace {
    let Some((w, h)) = size(plot.panel) else {
        return LegendPlace::None;
    };
    let covered = covered(plot);
    let (left, centre, right) = (CLEAR, (plot.width - w) / 2.0, plot.width - w - CLEAR);
    let (top, bottom) = (CLEAR, plot.height - h - CLEAR);
    if right < left || bottom < top {
        return LegendPlace::Beside;
    }
    let middle = (plot.height - h) / 2.0;
    let candidates = [
        (right, top),
        (left, top),
        (right, bottom),
        (left, bottom),
        (centre, top),
        (centre, bottom),
        (right, middle),
        (left, middle),
    ];
    let hits = |(x, y): &(f64, f64), (px, py): &(f64, f64)| {
        (x - CLEAR..x + w + CLEAR).contains(px) && (y - CLEAR..y + h + CLEAR).contains(py)
    };
    candidates
        .into_iter()
        .find(|at| !covered.iter().any(|point| hits(at, point)))
        .map_or(LegendPlace::Beside, |(x, y)| LegendPlace::Inside(x, y))
}

/// Returns points in the frame covered by data and notes, spaced so closely that a legend cannot
/// lie between them. A reference line may be covered: it continues at both ends.
fn covered(plot: &Plot<'_>) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for series in &plot.panel.series {
        if series.line.is_some() {
            points.extend(
                pixel_runs(plot, series)
                    .iter()
                    .flat_map(|run| along(run, ROW / 2.0)),
            );
        }
        if series.marker.is_some() {
            points.extend(marker_points(plot, series));
        }
    }
    for note in &plot.panel.notes {
        if let Some((x, y)) = plot.pixel(note.x, note.y) {
            let half = width(&note.text, SMALL) / 2.0;
            points.extend(along(
                &[(x - half, y - SMALL), (x + half, y - SMALL)],
                ROW / 2.0,
            ));
        }
    }
    points
}

/// Draws the legend of a panel at its position.
pub(super) fn legend(svg: &mut Svg, plot: &Plot<'_>, position: LegendPlace) {
    let (x, y) = match position {
        LegendPlace::None => return,
        LegendPlace::Inside(x, y) => (plot.left + x, plot.top + y),
        LegendPlace::Beside => (plot.left + plot.width + PADDING, plot.top),
    };
    if let (LegendPlace::Inside(..), Some((w, h))) = (position, size(plot.panel)) {
        let style = "class=\"jounce-paper jounce-grid\" fill=\"#ffffff\" stroke=\"#cccccc\" stroke-width=\"0.8\"";
        svg.rect(x, y, w, h, style);
    }
    let mut row = y + PADDING / 2.0 + ROW / 2.0;
    for series in plot
        .panel
        .series
        .iter()
        .filter(|series| series.label.is_some())
    {
        key(svg, series, x + PADDING, row);
        entry(svg, series.label.as_deref(), x, &mut row);
    }
    for band in plot.panel.bands.iter().filter(|band| band.label.is_some()) {
        svg.rect(x + PADDING, row - 5.0, KEY, 10.0, &band_style(band.colour));
        entry(svg, band.label.as_deref(), x, &mut row);
    }
}

fn entry(svg: &mut Svg, label: Option<&str>, x: f64, row: &mut f64) {
    svg.text(
        x + 2.0 * PADDING + KEY,
        *row + 0.36 * SMALL,
        SMALL,
        Anchor::Start,
        label.unwrap_or_default(),
    );
    *row += ROW;
}

fn key(svg: &mut Svg, series: &Series, x: f64, y: f64) {
    if let Some(line) = series.line {
        svg.path(
            &format!("M{} {}h{}", number(x), number(y), number(KEY)),
            &line_style(line, series.colour),
        );
    }
    if let Some(marker) = series.marker {
        svg.path(
            &marker_path(marker, x + KEY / 2.0, y, 1.0),
            &marker_style(marker, series.colour),
        );
    }
}
