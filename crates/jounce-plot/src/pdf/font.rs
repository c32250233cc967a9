//! The font of a document: the letters that it uses, in the font of the program.

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Finish, Name, Pdf, Rect, Ref, Str};
use subsetter::{GlyphRemapper, subset};

use crate::text::{FACE, advance};

/// Name of the font in the content of the page.
pub(super) const NAME: Name<'static> = Name(b"F");

/// Name of the font in the document, after the tag of its letters.
const BASE: &str = "DejaVuSans";

/// Glyphs and their numbers, without supplement.
const IDENTITY: SystemInfo<'static> = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// Numbers of the objects of a font.
pub(super) struct FontObjects {
    pub font: i32,
    pub letters: i32,
    pub descriptor: i32,
    pub file: i32,
    pub unicode: i32,
}

/// The letters that a document uses.
#[derive(Default)]
pub(super) struct Font {
    glyphs: GlyphRemapper,
    /// Letter of each glyph from number 1; number 0 is the empty glyph.
    letters: Vec<char>,
}

impl Font {
    pub fn is_empty(&self) -> bool {
        self.letters.is_empty()
    }

    /// Returns the number of the glyph of a letter in the document; `None` where the font has
    /// none.
    pub fn glyph(&mut self, letter: char) -> Option<u16> {
        let glyph = self.glyphs.remap(FACE.glyph_index(letter)?.0);
        if usize::from(glyph) > self.letters.len() {
            self.letters.push(letter);
        }
        Some(glyph)
    }

    /// Writes the font.
    pub fn write(&self, pdf: &mut Pdf, objects: &FontObjects) -> Result<(), subsetter::Error> {
        let file = subset(dejavu::sans::regular(), 0, &self.glyphs)?;
        let name = format!("{}+{BASE}", self.tag());
        let name = Name(name.as_bytes());
        let descriptor = Ref::new(objects.descriptor);
        pdf.type0_font(Ref::new(objects.font))
            .base_font(name)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(Ref::new(objects.letters))
            .to_unicode(Ref::new(objects.unicode));
        let mut font = pdf.cid_font(Ref::new(objects.letters));
        font.subtype(CidFontType::Type2)
            .base_font(name)
            .system_info(IDENTITY)
            .font_descriptor(descriptor)
            .default_width(0.0)
            .cid_to_gid_map_predefined(Name(b"Identity"));
        let widths = self.letters.iter().map(|&letter| width(advance(letter)));
        font.widths().consecutive(1, widths);
        font.finish();
        let bounds = FACE.global_bounding_box();
        let [left, low, right, high] =
            [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(units);
        pdf.font_descriptor(descriptor)
            .name(name)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(left, low, right, high))
            .italic_angle(0.0)
            .ascent(units(FACE.ascender()))
            .descent(units(FACE.descender()))
            .cap_height(units(FACE.capital_height().unwrap_or(FACE.ascender())))
            .stem_v(STEM)
            .font_file2(Ref::new(objects.file));
        let length = file.len() as i32;
        pdf.stream(Ref::new(objects.file), &file)
            .pair(Name(b"Length1"), length);
        let mut unicode = UnicodeCmap::new(Name(b"Letters"), IDENTITY);
        for (glyph, &letter) in (1_u16..).zip(&self.letters) {
            unicode.pair(glyph, letter);
        }
        pdf.stream(Ref::new(objects.unicode), &unicode.finish());
        Ok(())
    }

    /// Returns six capitals, which differ for fonts with other letters (FNV-1a).
    fn tag(&self) -> String {
        let fold = |hash: u64, &letter: &char| {
            (hash ^ u64::from(u32::from(letter))).wrapping_mul(0x0100_0000_01b3)
        };
        let hash = self.letters.iter().fold(0xcbf2_9ce4_8422_2325, fold);
        let capital = |place| char::from(b'A' + (hash / 26_u64.pow(place) % 26) as u8);
        (0..6).map(capital).collect()
    }
}

/// Width of the upright stems of DejaVu Sans, a hint for readers without the font.
const STEM: f32 = 90.0;

/// Returns a length in units of the font as thousandths of an em, the unit of widths.
pub(super) fn width(length: f64) -> f32 {
    (1000.0 * length / f64::from(FACE.units_per_em())) as f32
}

fn units(length: i16) -> f32 {
    width(f64::from(length))
}
