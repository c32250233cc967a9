//! Pictures in SVG, PNG and PDF for papers and reports.
//!
//! A [`Figure`] is a column of [`Panel`]s. A panel has two [`Axis`], [`Series`] of data, shaded
//! bands, reference lines and notes. The ready-made figures ([`mode_shapes`], [`time_histories`],
//! [`spectra`], [`frequency_responses`], [`sweep`], [`power_against_resistance`]) take plain data
//! and choose these.
//!
//! Lengths are in pixels of 1/96 inch; a figure is 720 wide by default. Text is set in DejaVu Sans,
//! whose file is part of the program (Bitstream Vera licence: free to use, embed and pass on). PNGs
//! therefore look the same on a machine without fonts, and widths are measured. A PDF holds the
//! letters that it uses. The SVG names common fonts of similar width after DejaVu Sans. A picture
//! does not depend on time or machine: the same figure gives the same bytes.
//!
//! Elements have the classes `paper`, `ink`, `rule` and `grid` (prefixed `jounce-`); a page may
//! recolour an inline SVG with them.
mod axis;
mod colour;
mod drawing;
mod error;
mod figure;
mod file;
mod outlines;
mod pdf;
mod raster;
mod ready;
pub mod report;
pub mod show;
mod stored;
mod svg;
mod text;

pub use axis::{Axis, Scale};
pub use colour::Colour;
pub use drawing::{
    Drawing, DrawnBeam, DrawnBody, DrawnCircuit, DrawnContact, DrawnDrive, DrawnEdge, DrawnElement,
    DrawnPatch, DrawnPlace, DrawnPlan, DrawnPoint, DrawnRectangle, DrawnShape, Grip, GripPart,
    GripSheet, Rect, Seat, ViewRoom,
};
pub use error::PictureError;
pub use figure::{
    Along, Field, Figure, Line, Marker, Panel, PanelBand, PanelNote, ReferenceLine, Series,
};
pub use ready::{
    BifurcationLine, BranchLine, BranchMark, DOWN_WORDS, DensityLine, DiagramDots, DiagramView,
    LineDirection, ModeShape, PlateShape, ResponseLine, ShapePatch, SpectrumLine, SweepLine,
    SweepLook, TimeSpectrum, Trace, UP_WORDS, bifurcations, branches, densities, diagram, ensemble,
    event_marker, frequency_responses, mode_shapes, plate_motion, plate_shapes,
    power_against_resistance, spectra, spectrogram, sweep, time_histories,
};
pub use stored::{PictureDifference, StoredPicture};
pub(crate) use svg::escape;
