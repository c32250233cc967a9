//! A harvester to scale: a side view of every body, and a closer look at every stop.
//!
//! Lengths and thicknesses of beams, patches and gaps have one scale in both directions in the side view; a line thinner than a pixel is
//! drawn one pixel wide. Masses, springs, loads and the ground are symbols. A gap is often smaller than what the side view shows, so each
//! stop has a closer look with a scale of its own, said beside it.
mod body;
mod close_up;
mod dimension;
mod hatch;
mod sheet;
mod stop;
mod symbols;

use super::{PictureError, file, raster};
use std::path::Path;

/// What is drawn: plain lengths and words.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Title above it.
    pub title: String,
    /// One body below the other.
    pub bodies: Vec<DrawnBody>,
}

/// A body: what carries it, and the beam if there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnBody {
    /// What stands at the left end.
    pub carrier: Carrier,
    /// The beam that it carries.
    pub beam: Option<DrawnBeam>,
    /// Stops that points of this body strike.
    pub stops: Vec<DrawnStop>,
    /// Words at the arrow of each drive, with its distance from the root where it acts on the beam, m.
    pub drives: Vec<(String, Option<f64>)>,
}

/// The left end of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Carrier {
    /// The ground.
    Ground,
    /// A rigid mass.
    Mass {
        /// Its name.
        label: String,
        /// Words about it.
        words: Vec<String>,
        /// Stands on a spring.
        sprung: bool,
    },
    /// Something without a shape, given by its modes.
    Given {
        /// Its name.
        label: String,
        /// Words about it.
        words: Vec<String>,
    },
}

/// A beam, its root at the left.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnBeam {
    /// Its name.
    pub label: String,
    /// Length, m.
    pub length_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
    /// Its patches.
    pub patches: Vec<DrawnPatch>,
    /// Named places: name and distance from the root, m.
    pub points: Vec<(String, f64)>,
}

/// A patch on the upper face.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPatch {
    /// Its name and size.
    pub label: String,
    /// Distance of its start from the root, m.
    pub start_m: f64,
    /// Length, m.
    pub length_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
    /// The load between its electrodes, in words; nothing where they are open.
    pub load: Option<String>,
}

/// A stop and what strikes it.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnStop {
    /// Its name.
    pub label: String,
    /// Distance of the striking point from the root, m; nothing where the carrier strikes.
    pub place_m: Option<f64>,
    /// It stands on the side of positive displacement, drawn above.
    pub above: bool,
    /// Gap, m; negative where the point is pressed in at rest.
    pub gap_m: f64,
    /// What carries it: `"ground"` or a name.
    pub frame: String,
    /// It rides on the carrier of this body.
    pub rides: bool,
    /// Its law and numbers.
    pub law: String,
}

impl Drawing {
    /// The drawing as an SVG document without ids, scripts or links.
    pub fn to_svg(&self) -> String {
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
