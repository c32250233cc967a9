//! A harvester to scale: a side view of its bodies, its circuits, and a close-up of every small
//! gap.
//!
//! Lengths and thicknesses of beams, patches and gaps have one scale in both directions in the side
//! view; a line thinner than a pixel is drawn one pixel wide. Masses, springs and the ground are
//! symbols. The bodies of a contact stand apart by its gap. A gap too small for the side view has a
//! close-up with its own scale, printed next to it. A plate is a symbol in the side view and has a
//! plan view with its own scale.
mod canvas;
mod grips;
mod layout;
mod model;
mod parts;
mod sheet;
mod symbols;

pub use grips::{Grip, GripPart, GripSheet};
pub use layout::rect::Rect;
pub use model::{
    Drawing, DrawnBeam, DrawnBody, DrawnCircuit, DrawnContact, DrawnDrive, DrawnEdge, DrawnElement,
    DrawnPatch, DrawnPlace, DrawnPlan, DrawnPoint, DrawnRectangle, DrawnShape, Seat,
};

use super::{PictureError, file, raster};
use jounce_io::table::Manifest;
use std::path::Path;

/// Room for the sheet and its views.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewRoom {
    /// Width of the sheet, px; between 320 and the default of 900.
    pub width_px: f64,
    /// Height for the side view, and for each plan view, px. A view whose symbols and labels need
    /// more is higher.
    pub height_px: f64,
}

impl Drawing {
    /// Returns the drawing as an SVG document without ids, scripts or links.
    pub fn to_svg(&self) -> String {
        self.sheet().svg
    }

    /// Returns the drawing with the positions of its parts, for a page in which they can be moved.
    pub fn sheet(&self) -> GripSheet {
        let room = ViewRoom {
            width_px: sheet::WIDTH,
            height_px: f64::INFINITY,
        };
        sheet::draw_sheet(self, room)
    }

    /// Returns the drawing as [`Drawing::sheet`] for a page with little room, where labels keep their
    /// size and bodies become smaller.
    pub fn sheet_in(&self, room: ViewRoom) -> GripSheet {
        let width_px = room.width_px.clamp(sheet::MIN_WIDTH, sheet::WIDTH);
        sheet::draw_sheet(self, ViewRoom { width_px, ..room })
    }

    /// Returns the drawing as a PNG file of `scale` times its size in pixels.
    ///
    /// # Errors
    /// [`PictureError::Size`] where the size is outside the allowed range.
    pub fn to_png(&self, scale: f64) -> Result<Vec<u8>, PictureError> {
        raster::png(&self.to_svg(), scale)
    }

    /// Writes the drawing atomically, in the format of the extension of `path`: `.svg`, `.png`
    /// at scale 2, or `.pdf`.
    ///
    /// # Errors
    /// As for [`Drawing::to_png`], another extension, a path that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), PictureError> {
        file::write(path, || Ok(self.to_svg()), None)
    }

    /// Writes the drawing like [`Drawing::write`], with its origin, which
    /// [`StoredPicture`](crate::StoredPicture) reads.
    ///
    /// # Errors
    /// As for [`Drawing::write`].
    pub fn write_with(&self, path: &Path, manifest: &Manifest) -> Result<(), PictureError> {
        file::write(path, || Ok(self.to_svg()), Some(manifest))
    }
}
