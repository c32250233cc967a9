//! Pictures in SVG and PNG for papers and reports.
//!
//! A [`Figure`] is a column of [`Panel`]s; a panel has two [`Axis`], [`Series`] of data, shaded bands, reference lines and notes. The
//! ready-made figures ([`mode_shapes`], [`time_histories`], [`spectra`], [`frequency_responses`], [`sweep`], [`power_against_resistance`]) take plain
//! data and choose these.
//!
//! Lengths are in pixels of 1/96 inch; 720 wide by default. Text is set in DejaVu Sans, whose file comes with the program (Bitstream Vera licence:
//! free to use, embed and pass on), so PNGs look the same on a machine without fonts, and widths are measured, not guessed. The SVG names
//! common fonts of about that width after it. Nothing in a picture depends on time or place: the same figure gives the same bytes.
//!
//! Elements have the classes `paper`, `ink`, `rule` and `grid` (prefixed `jounce-`), by which a page may recolour an inline SVG.
mod axis;
mod colour;
mod curve;
mod drawing;
mod error;
mod field;
mod figure;
mod file;
mod frame;
mod layout;
mod legend;
mod marks;
mod panel;
mod raster;
mod ready;
mod series;
mod span;
mod svg;
mod text;
mod ticks;
mod unit;

pub use axis::{Axis, Scale};
pub use colour::Colour;
pub use drawing::{
    Drawing, DrawnBeam, DrawnBody, DrawnCircuit, DrawnContact, DrawnDrive, DrawnElement,
    DrawnPatch, DrawnPlace, DrawnShape, Grip, GripPart, GripSheet, Rect, Seat,
};
pub use error::PictureError;
pub use field::Field;
pub use figure::Figure;
pub use panel::{Along, Panel, PanelBand, PanelNote, ReferenceLine};
pub use ready::{
    BifurcationLine, BranchLine, BranchMark, DensityLine, DiagramDots, DiagramView, LineDirection,
    ModeShape, ResponseLine, ShapePatch, SpectrumLine, SweepLine, SweepLook, TimeSpectrum, Trace,
    bifurcations, branches, densities, diagram, ensemble, frequency_responses, mode_shapes,
    power_against_resistance, spectra, spectrogram, sweep, time_histories,
};
pub use series::{Line, Marker, Series};
pub(crate) use svg::escape;
