//! A series of points and its style.

use crate::Colour;

/// Points `(x, y)`, joined by a line, marked, or both. NaN and infinities are gaps.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Abscissas.
    pub x: Vec<f64>,
    /// Ordinates, one for each abscissa.
    pub y: Vec<f64>,
    /// Name in the legend; a series without a name is not listed.
    pub label: Option<String>,
    /// Colour of line and markers.
    pub colour: Colour,
    /// Line, if the points are joined.
    pub line: Option<Line>,
    /// Marker, if the points are marked; on a line, markers closer than 14 pixels are thinned.
    pub marker: Option<Marker>,
}

/// Style of a line.
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
    /// Filled triangle pointing up.
    Triangle,
    /// Filled diamond.
    Diamond,
    /// Filled cross of two diagonals.
    Cross,
}

impl Series {
    /// Creates points joined by a solid line.
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

    /// Creates marked points.
    pub fn points(x: Vec<f64>, y: Vec<f64>, marker: Marker) -> Self {
        Self {
            line: None,
            marker: Some(marker),
            ..Self::line(x, y)
        }
    }

    /// Creates an entry in the legend that explains a style, without points.
    pub fn key(label: &str, line: Option<Line>, marker: Option<Marker>) -> Self {
        Self {
            line,
            marker,
            ..Self::line(Vec::new(), Vec::new())
        }
        .label(label)
        .colour(Colour::Ink)
    }

    /// Sets the name in the legend.
    #[must_use]
    pub fn label(mut self, label: &str) -> Self {
        self.label = Some(label.to_owned());
        self
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = colour;
        self
    }

    /// Sets the style of the line.
    #[must_use]
    pub fn style(mut self, line: Line) -> Self {
        self.line = Some(line);
        self
    }

    /// Marks the points.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = Some(marker);
        self
    }
}
