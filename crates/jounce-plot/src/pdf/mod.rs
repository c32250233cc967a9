//! SVG to PDF: one page of vectors, with the letters of its texts as a font inside.
//!
//! A document has no date, so that the same figure gives the same bytes. Nothing is compressed:
//! two files are compared line by line. The metadata with the origin are the last object.

mod font;
mod painter;

use super::PictureError;
use super::outlines::Outlined;
use super::raster::{render, tree};
use super::svg::{escape, unescape};
use font::FontObjects;
use painter::Painter;
use pdf_writer::writers::ExtGraphicsState;
use pdf_writer::{Finish, Name, Pdf, Rect, Ref, TextStr};

/// Points of 1/72 inch for each pixel of 1/96 inch.
const POINTS: f64 = 0.75;

/// Element of the metadata that holds the origin.
const OPEN: &str = "<jounce:origin>";
const CLOSE: &str = "</jounce:origin>";

/// End of a file.
const END: &[u8] = b"%%EOF";

/// Numbers of the objects of a document.
const CATALOG: i32 = 1;
const PAGES: i32 = 2;
const PAGE: i32 = 3;
const INFORMATION: i32 = 4;
const CONTENT: i32 = 5;
const FONT: FontObjects = FontObjects {
    font: 6,
    letters: 7,
    descriptor: 8,
    file: 9,
    unicode: 10,
};
const METADATA: i32 = 11;

/// Returns an SVG document as a PDF file, with its origin if there is one.
pub(super) fn pdf(svg: &str, origin: Option<&str>) -> Result<Vec<u8>, PictureError> {
    let document = Outlined::new(svg);
    let (tree, size) = tree(&document, 1.0)?;
    let [width, height] = size.map(|length| (POINTS * length) as f32);
    let mut painter = Painter::new(&document);
    painter.paint(&tree, [POINTS as f32, height]);
    if !painter.is_complete {
        let reason = "PDF needs paths of one colour and texts, and the picture has other elements";
        return Err(render(reason.to_owned()));
    }
    let Painter {
        content,
        font,
        opacities,
        ..
    } = painter;

    let mut pdf = Pdf::new();
    let mut catalog = pdf.catalog(Ref::new(CATALOG));
    catalog.pages(Ref::new(PAGES));
    if origin.is_some() {
        catalog.metadata(Ref::new(METADATA));
    }
    catalog.finish();
    pdf.pages(Ref::new(PAGES)).kids([Ref::new(PAGE)]).count(1);
    let mut page = pdf.page(Ref::new(PAGE));
    page.media_box(Rect::new(0.0, 0.0, width, height))
        .parent(Ref::new(PAGES))
        .contents(Ref::new(CONTENT));
    let mut resources = page.resources();
    if !font.is_empty() {
        resources.fonts().pair(font::NAME, Ref::new(FONT.font));
    }
    let mut states = resources.ext_g_states();
    for (index, [fill, stroke]) in opacities.iter().enumerate() {
        let name = painter::state_name(index);
        let mut state = states
            .insert(Name(name.as_bytes()))
            .start::<ExtGraphicsState>();
        state.non_stroking_alpha(*fill).stroking_alpha(*stroke);
    }
    states.finish();
    resources.finish();
    page.finish();
    pdf.document_info(Ref::new(INFORMATION))
        .title(TextStr(&document.title))
        .producer(TextStr("jounce"));
    pdf.stream(Ref::new(CONTENT), &content.finish());
    if !font.is_empty() {
        font.write(&mut pdf, &FONT)
            .map_err(|fault| render(fault.to_string()))?;
    }
    if let Some(origin) = origin {
        pdf.metadata(Ref::new(METADATA), metadata(origin).as_bytes());
    }
    Ok(pdf.finish())
}

/// Returns the metadata packet of a document.
fn metadata(origin: &str) -> String {
    let origin = escape(origin);
    format!(
        "<?xpacket begin=\"\u{feff}\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n\
         <x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n\
         <rdf:Description rdf:about=\"\" xmlns:jounce=\"https://github.com/jounce/jounce/\">{OPEN}{origin}{CLOSE}</rdf:Description>\n\
         </rdf:RDF></x:xmpmeta>\n<?xpacket end=\"r\"?>"
    )
}

/// Returns a file up to its metadata, and the origin; `None` where there is none, or where the file
/// is cut off.
pub(super) fn parts(bytes: &[u8]) -> Option<(&[u8], String)> {
    if !bytes.ends_with(END) {
        return None;
    }
    let last = |part: &str| {
        bytes
            .windows(part.len())
            .rposition(|own| own == part.as_bytes())
    };
    let origin = bytes.get(last(OPEN)? + OPEN.len()..last(CLOSE)?)?;
    let picture = &bytes[..last(&format!("\n{METADATA} 0 obj\n"))?];
    Some((picture, unescape(std::str::from_utf8(origin).ok()?)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use ttf_parser::{Face, GlyphId, OutlineBuilder};

    const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"100\"><title>a &lt; b</title>\
        <rect width=\"200\" height=\"100\" fill=\"#ffffff\"/>\
        <svg x=\"10\" y=\"20\" width=\"30\" height=\"40\" overflow=\"hidden\"><path d=\"M1 2L3 4Z\" fill=\"#ff0000\" fill-opacity=\"0.5\" stroke=\"#0000ff\" stroke-dasharray=\"6 5\"/></svg>\
        <text x=\"5\" y=\"7\" font-size=\"12\" fill=\"#00ff00\">Ωl漢l</text></svg>";

    /// Returns the stream of an object.
    fn stream(pdf: &[u8], object: i32) -> &[u8] {
        let find = |from: usize, part: &str| {
            let rest = &pdf[from..];
            from + rest
                .windows(part.len())
                .position(|own| own == part.as_bytes())
                .unwrap()
        };
        let start = find(find(0, &format!("\n{object} 0 obj\n")), "stream\n") + 7;
        &pdf[start..find(start, "\nendstream")]
    }

    /// Steps of an outline as text.
    struct Steps(String);

    impl OutlineBuilder for Steps {
        fn move_to(&mut self, x: f32, y: f32) {
            self.0 += &format!("M{x} {y}");
        }
        fn line_to(&mut self, x: f32, y: f32) {
            self.0 += &format!("L{x} {y}");
        }
        fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
            self.0 += &format!("Q{x1} {y1} {x} {y}");
        }
        fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
            self.0 += &format!("C{x1} {y1} {x2} {y2} {x} {y}");
        }
        fn close(&mut self) {
            self.0.push('Z');
        }
    }

    #[test]
    fn the_page_has_the_size_the_paths_and_the_texts_of_the_document() {
        let file = pdf(SVG, None).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains("/MediaBox [0 0 150 75]") && text.contains("/Title (a < b)"));
        assert!(!text.contains("Image") && !text.contains("Date"));
        let content = String::from_utf8_lossy(stream(&file, CONTENT)).into_owned();
        for part in [
            "0.75 0 0 -0.75 0 75 cm",
            "10 20 m\n40 20 l\n40 60 l\n10 60 l\nh\nW\nn",
            "1 0 0 1 10 20 cm\n/G0 gs\n1 0 0 rg\n0 0 1 RG",
            "[6 5] 0 d\n1 2 m\n3 4 l\nh\nB",
            "0 1 0 rg\nBT\n/F 12 Tf\n1 0 0 -1 5 7 Tm",
            " -600 ",
        ] {
            assert!(content.contains(part), "{part}\n{content}");
        }
        assert!(text.contains("/G0 <<") && text.contains("/ca 0.5"));
    }

    #[test]
    fn an_element_without_one_colour_is_refused() {
        let gradient = SVG.replace("fill=\"#ff0000\"", "fill=\"url(#g)\"").replace(
            "<title>",
            "<linearGradient id=\"g\"><stop offset=\"0\" stop-color=\"red\"/><stop offset=\"1\" stop-color=\"blue\"/></linearGradient><title>",
        );
        let error = pdf(&gradient, None).unwrap_err().to_string();
        assert!(error.contains("other elements"), "{error}");
    }

    /// The font has the letters of the document only, with their outlines and names.
    #[test]
    fn the_letters_are_inside() {
        let file = pdf(SVG, None).unwrap();
        let own = Face::parse(stream(&file, FONT.file), 0).unwrap();
        let original = Face::parse(dejavu::sans::regular(), 0).unwrap();
        assert_eq!(own.number_of_glyphs(), 3);
        for (glyph, letter) in [(1, 'Ω'), (2, 'l')] {
            let [mut one, mut two] = [Steps(String::new()), Steps(String::new())];
            own.outline_glyph(GlyphId(glyph), &mut one).unwrap();
            let of_letter = original.glyph_index(letter).unwrap();
            original.outline_glyph(of_letter, &mut two).unwrap();
            assert_eq!(one.0, two.0);
        }
        let names = String::from_utf8_lossy(stream(&file, FONT.unicode)).into_owned();
        assert!(names.contains("<0001> <03A9>\n<0002> <006C>"), "{names}");
    }

    #[test]
    fn the_origin_is_read_as_written_and_changes_nothing_before_it() {
        let [one, two] =
            ["{\"a\":\"<&>\"}", "longer"].map(|origin| pdf(SVG, Some(origin)).unwrap());
        let (picture, origin) = parts(&one).unwrap();
        assert_eq!(origin, "{\"a\":\"<&>\"}");
        assert_eq!(parts(&two).unwrap(), (picture, "longer".to_owned()));
        assert_eq!(parts(&one[..one.len() - 1]), None);
        assert_eq!(parts(&pdf(SVG, None).unwrap()), None);
    }
}
