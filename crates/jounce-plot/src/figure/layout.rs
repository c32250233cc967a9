//! Layout: the frames of the panels and the room around them for ticks, titles and names.

use super::panel::Along;
use crate::axis::span::Span;
use crate::axis::ticks::Ticks;
use crate::text::{LABEL, LEADING, SMALL, TITLE, width, wrap};
use crate::{Figure, Panel, PictureError};

/// Length of a tick and its distance to the label, pixels.
pub(super) const TICK: f64 = 5.0;
const GAP: f64 = 8.0;
const BORDER: f64 = 12.0;

/// A panel with its frame in pixels and its final axes.
pub(super) struct Plot<'a> {
    pub panel: &'a Panel,
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    pub x: Span,
    pub y: Span,
    pub x_ticks: Ticks,
    pub y_ticks: Ticks,
    /// True where the horizontal axis is labelled here; of panels over a common axis only the
    /// lowest is labelled.
    pub labels_x: bool,
    pub y_title: Vec<String>,
    /// Right edge of the vertical title, pixels: one column for all panels.
    pub y_title_right: f64,
}

/// A figure laid out.
pub(super) struct FigureLayout<'a> {
    pub height: f64,
    pub title: Vec<String>,
    pub plots: Vec<Plot<'a>>,
}

impl Plot<'_> {
    /// Returns a point in pixels from the upper left corner of the frame.
    pub fn pixel(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        Some((
            self.x.fraction(x)? * self.width,
            (1.0 - self.y.fraction(y)?) * self.height,
        ))
    }

    /// True where there are coloured cells, or a series has a point inside the frame.
    pub fn has_data(&self) -> bool {
        let inside = |(x, y): (&f64, &f64)| self.x.holds(*x) && self.y.holds(*y);
        let cells = self
            .panel
            .field
            .as_ref()
            .is_some_and(|field| !field.columns.is_empty());
        cells
            || self
                .panel
                .series
                .iter()
                .any(|series| series.x.iter().zip(&series.y).any(inside))
    }
}

impl<'a> FigureLayout<'a> {
    /// Lays a figure out, with `legend_width` pixels at the right for legends.
    pub fn new(figure: &'a Figure, legend_width: f64) -> Result<Self, PictureError> {
        let spans = spans(figure)?;
        let mut plots: Vec<_> = figure
            .panels
            .iter()
            .zip(spans)
            .enumerate()
            .map(|(i, (panel, (x, y)))| start(figure, i, panel, x, y))
            .collect();
        let labels = plots.iter().map(label_room).fold(0.0, f64::max);
        let left = plots.iter().map(title_room).fold(0.0, f64::max) + labels;
        let right = plots.iter().map(right_room).fold(BORDER, f64::max) + legend_width;
        let inner = (figure.width_px - left - right).max(40.0);
        let title = wrap(&figure.title, TITLE, figure.width_px - 2.0 * BORDER);
        let mut top = BORDER
            + title.len() as f64 * TITLE * LEADING
            + if title.is_empty() { 0.0 } else { GAP };
        for plot in &mut plots {
            (plot.left, plot.width) = (left, inner);
            plot.y_title_right = left - labels;
            plot.x_ticks = roomy_ticks(plot);
            plot.top = top + room_above(plot);
            top = plot.top + plot.height + room_below(plot);
        }
        Ok(Self {
            height: (top + BORDER - GAP).max(2.0 * BORDER).ceil(),
            title,
            plots,
        })
    }
}

fn start<'a>(figure: &Figure, index: usize, panel: &'a Panel, x: Span, y: Span) -> Plot<'a> {
    let y_ticks = Ticks::of(&panel.y, &y, panel.height_px / 34.0);
    let y_title = wrap(&y_ticks.title, LABEL, panel.height_px.max(120.0));
    let labels_x = index + 1 == figure.panels.len() || !shares_x(figure);
    let x_ticks = Ticks::of(&panel.x, &x, figure.width_px / 100.0);
    Plot {
        panel,
        left: 0.0,
        top: 0.0,
        width: 0.0,
        height: panel.height_px,
        x,
        y,
        x_ticks,
        y_ticks,
        labels_x,
        y_title,
        y_title_right: 0.0,
    }
}

/// True where the panels have equal horizontal axes and share one.
fn shares_x(figure: &Figure) -> bool {
    figure.panels.windows(2).all(|pair| pair[0].x == pair[1].x)
}

fn spans(figure: &Figure) -> Result<Vec<(Span, Span)>, PictureError> {
    let marked = figure
        .panels
        .iter()
        .flat_map(|panel| &panel.series)
        .any(|series| series.marker.is_some());
    let x_margin = if marked { 0.015 } else { 0.0 };
    let cells = |panel: &Panel| {
        panel
            .field
            .as_ref()
            .map_or_else(Vec::new, |field| field.x.clone())
    };
    let x_of = |panel: &Panel| {
        panel
            .series
            .iter()
            .flat_map(|series| series.x.clone())
            .chain(cells(panel))
            .collect::<Vec<_>>()
    };
    let shares_y = shares_x(figure) && figure.panels.windows(2).all(|pair| pair[0].y == pair[1].y);
    let common: Vec<f64> = figure.panels.iter().flat_map(x_of).collect();
    let span = |panel: &Panel| {
        let positions = if shares_x(figure) {
            common.clone()
        } else {
            x_of(panel)
        };
        let x = Span::settle(&panel.x, positions.into_iter(), x_margin)?;
        let panels = if shares_y {
            &figure.panels[..]
        } else {
            std::slice::from_ref(panel)
        };
        // Notes stand above their points and need room there.
        let margin = if panel.notes.is_empty() { 0.05 } else { 0.13 };
        Ok((
            x,
            Span::settle(
                &panel.y,
                panels.iter().flat_map(|panel| visible_values(panel, x)),
                margin,
            )?,
        ))
    };
    figure.panels.iter().map(span).collect()
}

/// Returns the values in the range of the horizontal axis: the vertical axis spans these.
fn visible_values(panel: &Panel, x: Span) -> impl Iterator<Item = f64> {
    let points = panel
        .series
        .iter()
        .flat_map(|series| series.x.iter().zip(&series.y));
    let cells = panel.field.iter().flat_map(|field| field.y.iter().copied());
    points
        .filter_map(move |(position, value)| x.holds(*position).then_some(*value))
        .chain(cells)
}

/// Returns as many ticks as have room for their labels.
fn roomy_ticks(plot: &Plot<'_>) -> Ticks {
    let mut room = plot.width / 65.0;
    loop {
        let ticks = Ticks::of(&plot.panel.x, &plot.x, room);
        let edges = |(value, label): &(f64, String)| {
            plot.x
                .fraction(*value)
                .map(|at| (at * plot.width, width(label, SMALL) / 2.0))
        };
        let edges: Vec<_> = ticks.major.iter().filter_map(edges).collect();
        if room < 2.0
            || edges
                .windows(2)
                .all(|pair| pair[0].0 + pair[0].1 + GAP <= pair[1].0 - pair[1].1)
        {
            return ticks;
        }
        room *= 0.8;
    }
}

fn title_room(plot: &Plot<'_>) -> f64 {
    BORDER + plot.y_title.len() as f64 * LABEL * LEADING
}

fn label_room(plot: &Plot<'_>) -> f64 {
    GAP / 2.0
        + plot
            .y_ticks
            .major
            .iter()
            .map(|(_, label)| width(label, SMALL))
            .fold(0.0, f64::max)
        + TICK
        + 3.0
}

fn right_room(plot: &Plot<'_>) -> f64 {
    let last = plot
        .x_ticks
        .major
        .last()
        .map_or(0.0, |(_, label)| width(label, SMALL) / 2.0);
    let names = names(plot, Along::Y)
        .map(|name| width(name, SMALL) + 6.0)
        .fold(0.0, f64::max);
    BORDER + last.max(names)
}

fn room_above(plot: &Plot<'_>) -> f64 {
    if names(plot, Along::X).next().is_some() {
        SMALL * LEADING + 2.0
    } else {
        0.0
    }
}

fn room_below(plot: &Plot<'_>) -> f64 {
    if plot.labels_x {
        TICK + 3.0 + SMALL * LEADING + LABEL * LEADING + 2.0 * GAP
    } else {
        2.0 * GAP
    }
}

fn names<'a>(plot: &'a Plot<'_>, along: Along) -> impl Iterator<Item = &'a str> {
    plot.panel
        .references
        .iter()
        .filter(move |line| line.along == along)
        .filter_map(|line| line.label.as_deref())
}
