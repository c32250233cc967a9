//! SVG to PNG, with the font of the program only.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::PictureError;
use super::outlines::Outlined;

/// Longest side of a picture, pixels.
pub(super) const MAX_SIDE: f64 = 20_000.0;

/// Renders an SVG document at `scale` times its size as a PNG file.
pub(super) fn png(svg: &str, scale: f64) -> Result<Vec<u8>, PictureError> {
    let file = pixels(svg, scale)?.encode_png();
    file.map_err(|fault| render(fault.to_string()))
}

pub(super) fn render(reason: String) -> PictureError {
    PictureError::Render { reason }
}

/// Renders an SVG document at `scale` times its size.
pub(super) fn pixels(svg: &str, scale: f64) -> Result<Pixmap, PictureError> {
    let (tree, [width, height]) = tree(&Outlined::new(svg), scale)?;
    let blank = Pixmap::new(width.round() as u32, height.round() as u32);
    let mut pixels = blank.ok_or_else(|| render("there is not enough memory for it".to_owned()))?;
    resvg::render(
        &tree,
        Transform::from_scale(scale as f32, scale as f32),
        &mut pixels.as_mut(),
    );
    Ok(pixels)
}

/// Returns the elements of a document, and its size times `scale`.
pub(super) fn tree(document: &Outlined, scale: f64) -> Result<(Tree, [f64; 2]), PictureError> {
    let tree = Tree::from_str(&document.svg, &Options::default())
        .map_err(|fault| render(fault.to_string()))?;
    let size = tree.size();
    let [width, height] = [size.width(), size.height()].map(|length| f64::from(length) * scale);
    let possible = |length: f64| (1.0..=MAX_SIDE).contains(&length.round());
    if !(possible(width) && possible(height)) {
        return Err(PictureError::Size { width, height });
    }
    Ok((tree, [width, height]))
}
