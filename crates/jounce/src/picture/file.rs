//! A picture in a file.

use std::path::Path;

use super::{PictureError, raster};
use crate::store;

/// Pixels of a PNG file per pixel of the picture: 192 dpi.
const SCALE: f64 = 2.0;

/// Writes a picture whole or not at all, in the format that the ending of `path` names: `.svg`, or `.png` at scale 2.
///
/// # Errors
/// What `svg` has, another ending, a size no picture can have, a place that cannot be written.
pub(super) fn write(
    path: &Path,
    svg: impl FnOnce() -> Result<String, PictureError>,
) -> Result<(), PictureError> {
    let content = match path.extension().and_then(|ending| ending.to_str()) {
        Some("svg") => svg()?.into_bytes(),
        Some("png") => raster::png(&svg()?, SCALE)?,
        _ => {
            return Err(PictureError::Format {
                path: path.to_owned(),
            });
        }
    };
    Ok(store::write(path, &content)?)
}
