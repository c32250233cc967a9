//! A figure: panels under one title, to SVG, PNG, PDF or a file.

mod curve;
mod field;
mod frame;
mod layout;
mod legend;
mod marks;
mod panel;
mod series;

pub use field::Field;
pub use panel::{Along, Panel, PanelBand, PanelNote, ReferenceLine};
pub use series::{Line, Marker, Series};

use jounce_io::table::Manifest;
use std::path::Path;

use super::svg::{Anchor, Svg};
use super::text::{LEADING, TITLE, width};
use super::{PictureError, file, raster};
use frame::{frame, grid};
use layout::{FigureLayout, Plot};
use legend::LegendPlace;
use marks::{markers, marks};

/// A column of panels under one title. Panels over equal horizontal axes share one; if their
/// vertical axes are also equal, they share the vertical range.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Title above the panels; may be empty.
    pub title: String,
    /// Panels from top to bottom.
    pub panels: Vec<Panel>,
    /// Width of the picture, pixels of 1/96 inch; the height follows from the panels.
    pub width_px: f64,
}

impl Figure {
    /// Creates a figure without panels, 720 pixels wide.
    pub fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            panels: Vec::new(),
            width_px: 720.0,
        }
    }

    /// Adds a panel below.
    #[must_use]
    pub fn with(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Returns the picture as an SVG document without ids, scripts or links, so that many fit
    /// inline in one page.
    ///
    /// # Errors
    /// An invalid range, a series of unequal lengths, a size outside the allowed range.
    pub fn to_svg(&self) -> Result<String, PictureError> {
        self.check()?;
        let layout = FigureLayout::new(self, 0.0)?;
        let positions: Vec<_> = layout.plots.iter().map(legend::place).collect();
        let size_outside = |(plot, position): (&Plot<'_>, &LegendPlace)| {
            (*position == LegendPlace::Beside)
                .then(|| legend::size(plot.panel))
                .flatten()
        };
        let legend_width = layout
            .plots
            .iter()
            .zip(&positions)
            .filter_map(size_outside)
            .map(|(legend_px, _)| legend_px)
            .fold(0.0, f64::max);
        if legend_width == 0.0 {
            return Ok(self.draw(&layout, &positions));
        }
        // A narrower frame may have no room for a legend inside, so legends inside are placed
        // again.
        let layout = FigureLayout::new(self, legend_width)?;
        let new_position = |(plot, position): (_, &LegendPlace)| {
            if *position == LegendPlace::Beside {
                LegendPlace::Beside
            } else {
                legend::place(plot)
            }
        };
        let positions: Vec<_> = layout
            .plots
            .iter()
            .zip(&positions)
            .map(new_position)
            .collect();
        Ok(self.draw(&layout, &positions))
    }

    /// Returns the picture as a PNG file of `scale` times the size in pixels (2 gives 192 dpi at
    /// the nominal size).
    ///
    /// # Errors
    /// As for [`Figure::to_svg`], and a scale that gives a size outside the allowed range.
    pub fn to_png(&self, scale: f64) -> Result<Vec<u8>, PictureError> {
        raster::png(&self.to_svg()?, scale)
    }

    /// Writes the picture atomically, in the format of the extension of `path`: `.svg`, `.png`
    /// at scale 2, or `.pdf`.
    ///
    /// # Errors
    /// As for [`Figure::to_png`], another extension, a path that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), PictureError> {
        file::write(path, || self.to_svg(), None)
    }

    /// Writes the picture like [`Figure::write`], with its origin, which
    /// [`StoredPicture`](crate::StoredPicture) reads.
    ///
    /// # Errors
    /// As for [`Figure::write`].
    pub fn write_with(&self, path: &Path, manifest: &Manifest) -> Result<(), PictureError> {
        file::write(path, || self.to_svg(), Some(manifest))
    }

    fn check(&self) -> Result<(), PictureError> {
        let mut series = self.panels.iter().flat_map(|panel| &panel.series);
        if let Some(series) = series.find(|series| series.x.len() != series.y.len()) {
            let (x, y) = (series.x.len(), series.y.len());
            return Err(PictureError::Lengths {
                series: series.label.clone().unwrap_or_default(),
                x,
                y,
            });
        }
        self.panels
            .iter()
            .filter_map(|panel| panel.field.as_ref())
            .try_for_each(|field| field.check())?;
        let possible = |length: f64| (1.0..=raster::MAX_SIDE).contains(&length);
        match self
            .panels
            .iter()
            .map(|panel| panel.height_px)
            .find(|height| !possible(*height))
        {
            Some(height) => Err(PictureError::Size {
                width: self.width_px,
                height,
            }),
            None if !possible(self.width_px) => Err(PictureError::Size {
                width: self.width_px,
                height: 1.0,
            }),
            None => Ok(()),
        }
    }

    fn draw(&self, layout: &FigureLayout<'_>, positions: &[LegendPlace]) -> String {
        let mut svg = Svg::new(self.width_px, &self.title);
        let left = layout.plots.first().map_or(12.0, |plot| plot.left);
        let widest = layout
            .title
            .iter()
            .map(|line| width(line, TITLE))
            .fold(0.0, f64::max);
        // Flush with the frame if the title fits there, else from the edge of the picture.
        let left = if left + widest <= self.width_px - 12.0 {
            left
        } else {
            12.0
        };
        for (line, text) in layout.title.iter().enumerate() {
            svg.text(
                left,
                12.0 + TITLE + line as f64 * TITLE * LEADING,
                TITLE,
                Anchor::Start,
                text,
            );
        }
        for (plot, position) in layout.plots.iter().zip(positions) {
            grid(&mut svg, plot);
            marks(&mut svg, plot);
            frame(&mut svg, plot);
            markers(&mut svg, plot);
            legend::legend(&mut svg, plot, *position);
        }
        svg.finish(layout.height)
    }
}
