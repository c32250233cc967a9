//! One pair of axes and its contents.

use crate::{Axis, Colour, Field, Series};

/// A pair of axes with series, bands, reference lines and notes.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Coloured cells behind all other elements.
    pub field: Option<Field>,
    /// Data, drawn in this order.
    pub series: Vec<Series>,
    /// Shaded ranges behind the data.
    pub bands: Vec<PanelBand>,
    /// Lines across the panel.
    pub references: Vec<ReferenceLine>,
    /// Texts at points.
    pub notes: Vec<PanelNote>,
    /// Height of the frame, pixels.
    pub height_px: f64,
}

/// Direction of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Along {
    /// Horizontal.
    X,
    /// Vertical.
    Y,
}

/// A shaded range of one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelBand {
    /// Axis of the range.
    pub along: Along,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Name in the legend.
    pub label: Option<String>,
    /// Colour of the shade.
    pub colour: Colour,
}

/// A thin dotted line across the panel at one value. A vertical line has its name above the frame,
/// a horizontal one at its right.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLine {
    /// Axis of the value.
    pub along: Along,
    /// Value.
    pub value: f64,
    /// Name; omitted where it would touch the name of an earlier line.
    pub label: Option<String>,
}

/// A text at a point, right above it.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelNote {
    /// Abscissa of the point.
    pub x: f64,
    /// Ordinate of the point.
    pub y: f64,
    /// Text; moved inwards where it would leave the frame.
    pub text: String,
}

impl Panel {
    /// Creates empty axes, 300 pixels high.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            field: None,
            series: Vec::new(),
            bands: Vec::new(),
            references: Vec::new(),
            notes: Vec::new(),
            height_px: 300.0,
        }
    }

    /// Adds a series.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds coloured cells.
    #[must_use]
    pub fn field(mut self, field: Field) -> Self {
        self.field = Some(field);
        self
    }

    /// Adds a shaded range.
    #[must_use]
    pub fn band(mut self, along: Along, low: f64, high: f64, label: Option<&str>) -> Self {
        self.bands.push(PanelBand {
            along,
            low,
            high,
            label: label.map(str::to_owned),
            colour: Colour::Grey,
        });
        self
    }

    /// Adds a reference line.
    #[must_use]
    pub fn reference(mut self, along: Along, value: f64, label: Option<&str>) -> Self {
        self.references.push(ReferenceLine {
            along,
            value,
            label: label.map(str::to_owned),
        });
        self
    }

    /// Adds a text at a point.
    #[must_use]
    pub fn note(mut self, x: f64, y: f64, text: &str) -> Self {
        self.notes.push(PanelNote {
            x,
            y,
            text: text.to_owned(),
        });
        self
    }

    /// Sets the height of the frame, pixels.
    #[must_use]
    pub fn high(mut self, height_px: f64) -> Self {
        self.height_px = height_px;
        self
    }
}
