//! SVG to PNG, with the font of the program only.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use super::PictureError;

/// Longest side of a picture, pixels.
pub(super) const MAX_SIDE: f64 = 20_000.0;

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

/// Renders an SVG document at `scale` times its size.
pub(super) fn png(svg: &str, scale: f64) -> Result<Vec<u8>, PictureError> {
    let render = |reason: String| PictureError::Render { reason };
    let options = Options {
        fontdb: FONTS.clone(),
        font_family: "DejaVu Sans".to_owned(),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|fault| render(fault.to_string()))?;
    let (width, height) = (
        f64::from(tree.size().width()) * scale,
        f64::from(tree.size().height()) * scale,
    );
    let possible = |length: f64| (1.0..=MAX_SIDE).contains(&length.round());
    if !(possible(width) && possible(height)) {
        return Err(PictureError::Size { width, height });
    }
    let blank = Pixmap::new(width.round() as u32, height.round() as u32);
    let mut pixels = blank.ok_or_else(|| render("there is not enough memory for it".to_owned()))?;
    resvg::render(
        &tree,
        Transform::from_scale(scale as f32, scale as f32),
        &mut pixels.as_mut(),
    );
    pixels
        .encode_png()
        .map_err(|fault| render(fault.to_string()))
}
