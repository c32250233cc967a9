//! Errors of a picture.

use std::path::PathBuf;

use jounce_io::store::StoreError;

/// A picture that cannot be drawn or stored. Empty data and NaN are not errors: they give a gap or
/// the words "no data".
#[derive(Debug, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum PictureError {
    /// A requested axis range that is invalid.
    #[error("the axis \"{axis}\" cannot run from {low} to {high}; it needs finite ends, low < high{}", if *.log { ", both > 0 on a logarithmic axis" } else { "" })]
    Range {
        /// Quantity on the axis.
        axis: String,
        /// Requested lower end.
        low: f64,
        /// Requested upper end.
        high: f64,
        /// True where the axis is logarithmic.
        log: bool,
    },
    /// A series with different numbers of abscissas and ordinates.
    #[error(
        "the series \"{series}\" has {x} places and {y} values; it needs as many of the one as of the other"
    )]
    Lengths {
        /// Label of the series.
        series: String,
        /// Number of abscissas.
        x: usize,
        /// Number of ordinates.
        y: usize,
    },
    /// A size outside the allowed range.
    #[error(
        "a picture of {width} by {height} pixels cannot be drawn; both must lie between 1 and 20000"
    )]
    Size {
        /// Width, pixels.
        width: f64,
        /// Height, pixels.
        height: f64,
    },
    /// A file name whose extension is not a known format.
    #[error("the extension of \"{path}\" is not a known format; use .svg, .png or .pdf")]
    Format {
        /// Path.
        path: PathBuf,
    },
    /// A renderer refused the picture.
    #[error("the picture cannot be rendered: {reason}")]
    Render {
        /// Message of the renderer.
        reason: String,
    },
    /// A file that is no picture of jounce with its origin.
    #[error("{}: {reason}", path.display())]
    Read {
        /// Path.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The file could not be stored.
    #[error(transparent)]
    Store(#[from] StoreError),
}
