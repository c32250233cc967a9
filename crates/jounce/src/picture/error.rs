//! What can be wrong with a picture.

use std::path::PathBuf;

use crate::store::StoreError;

/// A picture that cannot be drawn or stored. Empty data and NaN are not faults: they give a gap or the words "no data".
#[derive(Debug, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum PictureError {
    /// An axis range that was asked for makes no sense.
    #[error("the axis \"{axis}\" cannot run from {low} to {high}; it needs finite ends, low < high{}", if *.log { ", both > 0 on a logarithmic axis" } else { "" })]
    Range {
        /// Quantity on the axis.
        axis: String,
        /// Lower end asked for.
        low: f64,
        /// Upper end asked for.
        high: f64,
        /// Whether the axis is logarithmic.
        log: bool,
    },
    /// A series with more places than values, or the other way round.
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
    /// A size that no picture can have.
    #[error(
        "a picture of {width} by {height} pixels cannot be drawn; both must lie between 1 and 20000"
    )]
    Size {
        /// Width, pixels.
        width: f64,
        /// Height, pixels.
        height: f64,
    },
    /// The ending of the file name says no known format.
    #[error("cannot tell the format of \"{path}\" from its name; use .svg or .png")]
    Format {
        /// The path.
        path: PathBuf,
    },
    /// The renderer refused the picture.
    #[error("the picture cannot be rendered as PNG: {reason}")]
    Render {
        /// What it said.
        reason: String,
    },
    /// The file could not be stored.
    #[error(transparent)]
    Store(#[from] StoreError),
}
