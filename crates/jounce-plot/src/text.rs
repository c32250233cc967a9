//! The font and the widths of texts set in it.

use std::sync::LazyLock;

use ttf_parser::Face;

/// Font family of an SVG: the font of the program first, then common fonts that are not wider.
pub(super) const FAMILY: &str = "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif";

/// Size of the figure's title, pixels.
pub(super) const TITLE: f64 = 15.0;
/// Size of axis titles, pixels.
pub(super) const LABEL: f64 = 13.0;
/// Size of all other text, pixels.
pub(super) const SMALL: f64 = 12.0;
/// Distance of two lines of text relative to their size.
pub(super) const LEADING: f64 = 1.3;

/// The font.
pub(super) static FACE: LazyLock<Face<'static>> = LazyLock::new(|| {
    Face::parse(dejavu::sans::regular(), 0).expect("the font that comes with the program is whole")
});

/// Returns the width of a letter, in units of the font.
pub(super) fn advance(letter: char) -> f64 {
    let glyph = FACE.glyph_index(letter);
    glyph
        .and_then(|glyph| FACE.glyph_hor_advance(glyph))
        .map_or(0.6 * f64::from(FACE.units_per_em()), f64::from)
}

/// Returns the width of a text at a size, pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size / f64::from(FACE.units_per_em())
}

/// Breaks a text between words into lines of at most `room` pixels; a longer word gets its own
/// line.
pub(super) fn wrap(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Advance widths of DejaVu Sans in units of 1/2048 em: `0` 1303, `−` 1716, `A` 1401.
    #[test]
    fn widths_are_those_of_the_font() {
        assert!(
            (width("0−A", 2048.0) - (1303.0 + 1716.0 + 1401.0)).abs() < 1e-9,
            "{}",
            width("0−A", 2048.0)
        );
        assert!(width("Ωµ²⁻¹⁰×°½", 10.0) > 30.0);
    }

    #[test]
    fn long_texts_break_between_words() {
        let lines = wrap(
            "The voltage output with impact for an excitation of 13 Hz",
            15.0,
            200.0,
        );
        assert!(
            lines.len() >= 2 && lines.iter().all(|line| width(line, 15.0) <= 200.0),
            "{lines:?}"
        );
        assert_eq!(wrap("  ", 15.0, 200.0).len(), 0);
    }
}
