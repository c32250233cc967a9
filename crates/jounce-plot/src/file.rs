//! Output of a picture to a file.

use std::path::Path;

use super::{PictureError, raster};
use jounce_io::store;

/// Pixels of a PNG file per pixel of the picture: 192 dpi.
const SCALE: f64 = 2.0;

/// Writes a picture atomically, in the format of the extension of `path`: `.svg`, or `.png` at
/// scale 2.
///
/// # Errors
/// The error of `svg`, another extension, a size outside the allowed range, a path that cannot be
/// written.
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
