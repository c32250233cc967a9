//! A picture as stored in a file with its origin, and the first difference of two of them.

use super::svg::{escape, unescape};
use super::{PictureError, pdf, raster};
use jounce_io::table::Manifest;
use std::path::Path;

/// Keyword of the text in a PNG file that holds the origin.
const KEYWORD: &str = "jounce";

/// Elements of an SVG file and of the metadata of a PDF file that hold the origin.
const OPEN: &str = "<metadata>";
const CLOSE: &str = "</metadata>\n";

/// End of an SVG file.
const END: &str = "</svg>\n";

/// Picture of a file, with its origin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredPicture {
    /// Origin of the picture.
    pub manifest: Manifest,
    content: Content,
}

/// What the picture shows.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Content {
    Svg(String),
    Png {
        size: [u32; 2],
        rgba: Vec<u8>,
    },
    /// Bytes before the metadata, one letter each.
    Pdf(String),
}

/// First difference of two pictures.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct PictureDifference {
    /// Place: `line 12`, `size`, or `pixel 3, 40` from the upper left corner.
    pub place: String,
    /// Content of the first picture.
    pub first: String,
    /// Content of the second picture.
    pub second: String,
}

/// Returns an SVG document with its origin.
pub(super) fn svg_with(svg: &str, manifest: &Manifest) -> Result<String, PictureError> {
    let body = svg.strip_suffix(END).unwrap_or(svg);
    let origin = escape(&text(manifest)?);
    Ok(format!("{body}{OPEN}{origin}{CLOSE}{END}"))
}

/// Returns an SVG document rendered at `scale` times its size, with its origin.
pub(super) fn png_with(
    svg: &str,
    scale: f64,
    manifest: &Manifest,
) -> Result<Vec<u8>, PictureError> {
    let pixels = raster::pixels(svg, scale)?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let render = |fault: png::EncodingError| PictureError::Render {
        reason: fault.to_string(),
    };
    encoder
        .add_itxt_chunk(KEYWORD.to_owned(), text(manifest)?)
        .map_err(render)?;
    let mut writer = encoder.write_header().map_err(render)?;
    writer
        .write_image_data(&pixels.take_demultiplied())
        .map_err(render)?;
    writer.finish().map_err(render)?;
    Ok(bytes)
}

/// Returns an SVG document as a PDF file, with its origin if there is one.
pub(super) fn pdf_with(svg: &str, manifest: Option<&Manifest>) -> Result<Vec<u8>, PictureError> {
    pdf::pdf(svg, manifest.map(text).transpose()?.as_deref())
}

fn text(manifest: &Manifest) -> Result<String, PictureError> {
    serde_json::to_string(manifest).map_err(|fault| PictureError::Render {
        reason: fault.to_string(),
    })
}

impl StoredPicture {
    /// Reads an SVG, PNG or PDF file that jounce wrote with its origin.
    ///
    /// # Errors
    /// The extension is unknown, or the file is missing, damaged or without the origin.
    pub fn read(path: &Path) -> Result<Self, PictureError> {
        let read = |reason: String| PictureError::Read {
            path: path.to_owned(),
            reason,
        };
        let bytes = || std::fs::read(path).map_err(|fault| read(fault.to_string()));
        let (text, content) = match path.extension().and_then(|ending| ending.to_str()) {
            Some("svg") => from_svg(bytes()?),
            Some("png") => from_png(&bytes()?),
            Some("pdf") => from_pdf(&bytes()?),
            _ => {
                let path = path.to_owned();
                return Err(PictureError::Format { path });
            }
        }
        .map_err(read)?;
        let manifest = serde_json::from_str(&text)
            .map_err(|_| read("its origin is not that of jounce".to_owned()))?;
        Ok(Self { manifest, content })
    }

    /// Returns the first difference from another picture; origins are not compared.
    pub fn first_difference(&self, other: &Self) -> Option<PictureDifference> {
        match (&self.content, &other.content) {
            (Content::Svg(first), Content::Svg(second)) => {
                different_lines(first.lines(), second.lines())
            }
            (Content::Pdf(first), Content::Pdf(second)) => {
                different_lines(first.split('\n'), second.split('\n'))
            }
            (
                Content::Png { size, rgba },
                Content::Png {
                    size: other_size,
                    rgba: other_rgba,
                },
            ) if size == other_size => different_pixels(size[0], rgba, other_rgba),
            (first, second) => {
                let [first, second] = [first, second].map(Content::size);
                Some(PictureDifference {
                    place: "size".to_owned(),
                    first,
                    second,
                })
            }
        }
    }
}

impl Content {
    fn size(&self) -> String {
        match self {
            Self::Svg(_) => "an SVG document".to_owned(),
            Self::Pdf(_) => "a PDF document".to_owned(),
            Self::Png { size, .. } => format!("{} by {} pixels", size[0], size[1]),
        }
    }
}

/// Returns the origin of an SVG document, and the document without it.
fn from_svg(bytes: Vec<u8>) -> Result<(String, Content), String> {
    let document = String::from_utf8(bytes).map_err(|fault| fault.to_string())?;
    let found = document.split_once(OPEN).and_then(|(before, rest)| {
        let (origin, after) = rest.split_once(CLOSE)?;
        Some((origin.to_owned(), format!("{before}{after}")))
    });
    let (origin, picture) = found.ok_or_else(without_origin)?;
    Ok((unescape(&origin), Content::Svg(picture)))
}

/// Returns the origin of a PNG file, and its pixels.
fn from_png(bytes: &[u8]) -> Result<(String, Content), String> {
    let damaged = |fault: png::DecodingError| fault.to_string();
    let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    let mut reader = decoder.read_info().map_err(damaged)?;
    let length = reader.output_buffer_size().ok_or("it is too large")?;
    let mut rgba = vec![0; length];
    reader.next_frame(&mut rgba).map_err(damaged)?;
    reader.finish().map_err(damaged)?;
    let info = reader.info();
    let mut texts = info.utf8_text.iter();
    let note = texts.find(|note| note.keyword == KEYWORD);
    let origin = note.ok_or_else(without_origin)?;
    let origin = origin.get_text().map_err(damaged)?;
    let size = [info.width, info.height];
    Ok((origin, Content::Png { size, rgba }))
}

/// Returns the origin of a PDF file, and the file before the metadata.
fn from_pdf(bytes: &[u8]) -> Result<(String, Content), String> {
    let (picture, origin) = pdf::parts(bytes).ok_or_else(without_origin)?;
    let picture = picture.iter().map(|&byte| char::from(byte)).collect();
    Ok((origin, Content::Pdf(picture)))
}

fn without_origin() -> String {
    "the picture has no record of its command; only pictures that a command of jounce wrote have one"
        .to_owned()
}

fn different_lines<'a>(
    mut one: impl Iterator<Item = &'a str>,
    mut two: impl Iterator<Item = &'a str>,
) -> Option<PictureDifference> {
    for line in 1.. {
        match (one.next(), two.next()) {
            (None, None) => break,
            (first, second) if first == second => {}
            (first, second) => {
                let [first, second] =
                    [first, second].map(|line| line.unwrap_or("nothing").to_owned());
                return Some(PictureDifference {
                    place: format!("line {line}"),
                    first,
                    second,
                });
            }
        }
    }
    None
}

fn different_pixels(width: u32, first: &[u8], second: &[u8]) -> Option<PictureDifference> {
    let pixels = first.chunks(4).zip(second.chunks(4));
    let (index, (first, second)) = (pixels.enumerate()).find(|(_, (one, two))| one != two)?;
    let (x, y) = (index % width as usize, index / width as usize);
    Some(PictureDifference {
        place: format!("pixel {x}, {y}"),
        first: format!("{first:?}"),
        second: format!("{second:?}"),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::Figure;
    use jounce_io::table::Record;

    fn manifest() -> Manifest {
        Manifest {
            record: Some(Record {
                arguments: vec!["run".into(), "a & <b>'s \"c\" &lt;.toml".into()],
                table: "run".into(),
                inputs: Vec::new(),
            }),
            ..Manifest::new("")
        }
    }

    fn figure(title: &str) -> Figure {
        Figure::new(title)
    }

    #[test]
    fn a_picture_is_read_as_written() {
        let folder = tempfile::tempdir().unwrap();
        for ending in ["svg", "png", "pdf"] {
            let path = folder.path().join("a").with_extension(ending);
            figure("\"x\" < 1").write_with(&path, &manifest()).unwrap();
            let stored = StoredPicture::read(&path).unwrap();
            assert_eq!(stored.manifest, manifest());
            assert_eq!(stored.first_difference(&stored), None);
            figure("another").write_with(&path, &manifest()).unwrap();
            let other = StoredPicture::read(&path).unwrap();
            let difference = stored.first_difference(&other).unwrap();
            let place = if ending == "png" { "pixel" } else { "line" };
            assert!(difference.place.starts_with(place), "{difference:?}");
        }
    }

    #[test]
    fn the_drawing_is_that_without_origin() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.svg");
        figure("a").write_with(&path, &manifest()).unwrap();
        let Content::Svg(svg) = StoredPicture::read(&path).unwrap().content else {
            panic!("an SVG document");
        };
        assert_eq!(svg, figure("a").to_svg().unwrap());
    }

    #[test]
    fn pictures_without_origin_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        for ending in ["svg", "png", "pdf"] {
            let path = folder.path().join("a").with_extension(ending);
            figure("a").write(&path).unwrap();
            let fault = StoredPicture::read(&path).unwrap_err().to_string();
            assert!(fault.contains("no record of its command"), "{fault}");
            std::fs::write(&path, [0xff, 0xd8, 0xff]).unwrap();
            let fault = StoredPicture::read(&path).unwrap_err().to_string();
            assert!(fault.contains(&path.display().to_string()), "{fault}");
        }
    }
}
