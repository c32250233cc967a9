//! Output of a picture to a file.

use std::path::Path;

use super::{PictureError, raster, stored};
use jounce_io::store;
use jounce_io::table::Manifest;

/// Pixels of a PNG file per pixel of the picture: 192 dpi.
const SCALE: f64 = 2.0;

/// Writes a picture atomically, in the format of the extension of `path`: `.svg`, `.png`
/// at scale 2, or `.pdf`, with its origin if there is one.
///
/// # Errors
/// The error of `svg`, another extension, a size outside the allowed range, a path that cannot be
/// written.
pub(super) fn write(
    path: &Path,
    svg: impl FnOnce() -> Result<String, PictureError>,
    manifest: Option<&Manifest>,
) -> Result<(), PictureError> {
    let content = match (
        path.extension().and_then(|ending| ending.to_str()),
        manifest,
    ) {
        (Some("svg"), None) => svg()?.into_bytes(),
        (Some("svg"), Some(manifest)) => stored::svg_with(&svg()?, manifest)?.into_bytes(),
        (Some("png"), None) => raster::png(&svg()?, SCALE)?,
        (Some("png"), Some(manifest)) => stored::png_with(&svg()?, SCALE, manifest)?,
        (Some("pdf"), manifest) => stored::pdf_with(&svg()?, manifest)?,
        _ => {
            return Err(PictureError::Format {
                path: path.to_owned(),
            });
        }
    };
    Ok(store::write(path, &content)?)
}
