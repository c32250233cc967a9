//! A harvester to scale: a side view of what belongs together, its circuits, and a closer look at every small gap.
//!
//! Lengths and thicknesses of beams, patches and gaps have one scale in both directions in the side view; a line thinner than a pixel is
//! drawn one pixel wide. Masses, springs and the ground are symbols. Bodies that strike each other stand as far apart as their gap says.
//! A gap that the side view hardly shows has a closer look with a scale of its own, said beside it.
mod assembly;
mod bodies;
mod canvas;
mod circuit;
mod close_up;
mod contacts;
mod dimension;
mod drives;
mod electric;
mod grips;
mod hatch;
mod labels;
mod layout;
mod model;
mod rect;
mod scale;
mod sheet;
mod symbols;

pub use grips::{Grip, GripPart, GripSheet};
pub use model::{
    Drawing, DrawnBeam, DrawnBody, DrawnCircuit, DrawnContact, DrawnDrive, DrawnElement,
    DrawnPatch, DrawnPlace, DrawnShape, Seat,
};
pub use rect::Rect;

use super::{PictureError, file, raster};
use std::path::Path;

impl Drawing {
    /// The drawing as an SVG document without ids, scripts or links.
    pub fn to_svg(&self) -> String {
        self.sheet().svg
    }

    /// The drawing with the places of what is on it, for a page that lets its parts be moved.
    pub fn sheet(&self) -> GripSheet {
        sheet::drawn(self)
    }

    /// The drawing as a PNG file of `scale` times its size in pixels.
    ///
    /// # Errors
    /// [`PictureError::Size`] where no picture has that size.
    pub fn to_png(&self, scale: f64) -> Result<Vec<u8>, PictureError> {
        raster::png(&self.to_svg(), scale)
    }

    /// Writes the drawing whole or not at all, in the format that the ending of `path` names: `.svg`, or `.png` at scale 2.
    ///
    /// # Errors
    /// As for [`Drawing::to_png`], another ending, a place that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), PictureError> {
        file::write(path, || Ok(self.to_svg()))
    }
}
