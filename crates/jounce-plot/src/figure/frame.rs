//! The frame of a panel: grid, ticks, labels, titles.

use std::fmt::Write as _;

use super::layout::{Plot, TICK};
use crate::svg::{Anchor, Svg, number};
use crate::text::{LABEL, LEADING, SMALL};

const GRID: &str = "class=\"jounce-grid\" fill=\"none\" stroke=\"#e6e6e6\" stroke-width=\"0.8\"";
const RULE: &str = "class=\"jounce-rule\" fill=\"none\" stroke=\"#333333\" stroke-width=\"0.9\"";

/// Draws the grid, before the data; omitted where there is no data.
pub(super) fn grid(svg: &mut Svg, plot: &Plot<'_>) {
    if !plot.has_data() {
        return;
    }
    let mut steps = String::new();
    for x in plot
        .x_ticks
        .major
        .iter()
        .filter_map(|(value, _)| plot.x.fraction(*value))
    {
        let _ = write!(
            steps,
            "M{} {}v{}",
            number(plot.left + x * plot.width),
            number(plot.top),
            number(plot.height)
        );
    }
    for y in plot
        .y_ticks
        .major
        .iter()
        .filter_map(|(value, _)| plot.y.fraction(*value))
    {
        let _ = write!(
            steps,
            "M{} {}h{}",
            number(plot.left),
            number(plot.top + (1.0 - y) * plot.height),
            number(plot.width)
        );
    }
    svg.path(&steps, GRID);
}

/// Draws frame, ticks, labels and titles, after the data.
pub(super) fn frame(svg: &mut Svg, plot: &Plot<'_>) {
    svg.rect(plot.left, plot.top, plot.width, plot.height, RULE);
    svg.path(&ticks(plot), RULE);
    let bottom = plot.top + plot.height;
    for (value, label) in &plot.y_ticks.major {
        if let Some(position) = plot.y.fraction(*value) {
            let y = plot.top + (1.0 - position) * plot.height;
            svg.text(
                plot.left - TICK - 3.0,
                y + 0.36 * SMALL,
                SMALL,
                Anchor::End,
                label,
            );
        }
    }
    for (line, text) in plot.y_title.iter().rev().enumerate() {
        let x = plot.y_title_right - 4.0 - line as f64 * LABEL * LEADING;
        svg.upward_text(x, plot.top + plot.height / 2.0, LABEL, text);
    }
    if !plot.labels_x {
        return;
    }
    for (value, label) in &plot.x_ticks.major {
        if let Some(position) = plot.x.fraction(*value) {
            svg.text(
                plot.left + position * plot.width,
                bottom + TICK + 3.0 + 0.9 * SMALL,
                SMALL,
                Anchor::Middle,
                label,
            );
        }
    }
    let y = bottom + TICK + 3.0 + SMALL * LEADING + LABEL + 2.0;
    svg.text(
        plot.left + plot.width / 2.0,
        y,
        LABEL,
        Anchor::Middle,
        &plot.x_ticks.title,
    );
}

/// Returns ticks that point outwards, so that they cover no data.
fn ticks(plot: &Plot<'_>) -> String {
    let mut steps = String::new();
    let major = |list: &[(f64, String)]| {
        list.iter()
            .map(|(value, _)| (*value, TICK))
            .collect::<Vec<_>>()
    };
    let minor = |list: &[f64]| {
        list.iter()
            .map(|value| (*value, 0.55 * TICK))
            .collect::<Vec<_>>()
    };
    let bottom = plot.top + plot.height;
    for (value, length) in major(&plot.x_ticks.major)
        .into_iter()
        .chain(minor(&plot.x_ticks.minor))
    {
        if let Some(position) = plot.x.fraction(value).filter(|_| plot.x.holds(value)) {
            let _ = write!(
                steps,
                "M{} {}v{}",
                number(plot.left + position * plot.width),
                number(bottom),
                number(length)
            );
        }
    }
    for (value, length) in major(&plot.y_ticks.major)
        .into_iter()
        .chain(minor(&plot.y_ticks.minor))
    {
        if let Some(position) = plot.y.fraction(value).filter(|_| plot.y.holds(value)) {
            let _ = write!(
                steps,
                "M{} {}h-{}",
                number(plot.left),
                number(plot.top + (1.0 - position) * plot.height),
                number(length)
            );
        }
    }
    steps
}
