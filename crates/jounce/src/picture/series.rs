//! A series of points and how it is drawn.

use super::Colour;

/// Points `(x, y)`, joined by a line, marked, or both. NaN and infinities are gaps.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Abscissas.
    pub x: Vec<f64>,
    /// Ordinates, as many.
    pub y: Vec<f64>,
    /// Name in the legend; without one the series is not listed.
    pub label: Option<String>,
    /// Colour of line and markers.
    pub colour: Colour,
    /// The line, if the points are joined.
    pub line: Option<Line>,
    /// The marker, if the points are marked; on a line, markers closer than 14 pixels are thinned.
    pub marker: Option<Marker>,
}

/// A style of line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Line {
    /// Full weight.
    #[default]
    Solid,
    /// Full weight, dashed.
    Dashed,
    /// Half the weight: for dense records and comparisons.
    Thin,
}

/// A mark at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// Filled circle.
    Circle,
    /// Open circle.
    Ring,
    /// Filled square.
    Square,
    /// Filled triangle pointing right: sweep up.
    Right,
    /// Open triangle pointing left: sweep down.
    Left,
}

impl Series {
    /// Points joined by a solid line.
    pub fn line(x: Vec<f64>, y: Vec<f64>) -> Self {
        Self {
            x,
            y,
            label: None,
            colour: Colour::default(),
            line: Some(Line::Solid),
            marker: None,
        }
    }

    /// Marked points.
    pub fn points(x: Vec<f64>, y: Vec<f64>, marker: Marker) -> Self {
        Self {
            line: None,
            marker: Some(marker),
            ..Self::line(x, y)
        }
    }

    /// No points, only an entry in the legend that explains a style.
    pub fn key(label: &str, line: Option<Line>, marker: Option<Marker>) -> Self {
        Self {
            line,
            marker,
            ..Self::line(Vec::new(), Vec::new())
        }
        .label(label)
        .colour(Colour::Ink)
    }

    /// The same under a name in the legend.
    #[must_use]
    pub fn label(mut self, label: &str) -> Self {
        self.label = Some(label.to_owned());
        self
    }

    /// The same in another colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = colour;
        self
    }

    /// The same with another style of line.
    #[must_use]
    pub fn style(mut self, line: Line) -> Self {
        self.line = Some(line);
        self
    }

    /// The same with marked points.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = Some(marker);
        self
    }
}
