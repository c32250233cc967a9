//! The SVG elements of a figure. Coordinates have two decimals; colours are attributes, so that a
//! page's style may override them.

use std::fmt::Write as _;

use super::text::FAMILY;

/// Characters of markup and their escapes; the last one is part of all escapes.
const ESCAPES: [(char, &str); 5] = [
    ('<', "&lt;"),
    ('>', "&gt;"),
    ('"', "&quot;"),
    ('\'', "&#39;"),
    ('&', "&amp;"),
];

/// A document under construction.
pub(super) struct Svg {
    width: f64,
    title: String,
    body: String,
}

/// Alignment of a text at its point.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Svg {
    /// Creates an empty page of white paper with an accessible title.
    pub fn new(width: f64, title: &str) -> Self {
        Self {
            width,
            title: escape(title),
            body: String::new(),
        }
    }

    /// Returns the finished document; its height is known after all is drawn.
    pub fn finish(self, height: f64) -> String {
        let (w, h, body) = (number(self.width), number(height), self.body);
        let title = if self.title.is_empty() {
            String::new()
        } else {
            format!("<title>{}</title>\n", self.title)
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" role=\"img\" font-family=\"{FAMILY}\">\n\
             {title}<rect class=\"jounce-paper\" width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        )
    }

    /// Opens a window: subsequent elements are clipped to it, with coordinates from its upper left
    /// corner.
    pub fn open_window(&mut self, x: f64, y: f64, width: f64, height: f64) {
        let (x, y, w, h) = (number(x), number(y), number(width), number(height));
        let _ = writeln!(
            self.body,
            "<svg x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" overflow=\"hidden\">"
        );
    }

    /// Closes the last window.
    pub fn close_window(&mut self) {
        self.body.push_str("</svg>\n");
    }

    /// Draws a rectangle with the attributes `style`.
    pub fn rect(&mut self, x: f64, y: f64, width: f64, height: f64, style: &str) {
        let (x, y, w, h) = (number(x), number(y), number(width), number(height));
        let _ = writeln!(
            self.body,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" {style}/>"
        );
    }

    /// Draws a path with the attributes `style`; an empty path is omitted.
    pub fn path(&mut self, steps: &str, style: &str) {
        if !steps.is_empty() {
            let _ = writeln!(self.body, "<path d=\"{steps}\" {style}/>");
        }
    }

    /// Draws a text on the baseline through `(x, y)`.
    pub fn text(&mut self, x: f64, y: f64, size: f64, anchor: Anchor, text: &str) {
        self.set(x, y, size, anchor, "", text);
    }

    /// Draws an upward text, its baseline through `(x, y)`, centred there.
    pub fn upward_text(&mut self, x: f64, y: f64, size: f64, text: &str) {
        let turn = format!(" transform=\"rotate(-90 {} {})\"", number(x), number(y));
        self.set(x, y, size, Anchor::Middle, &turn, text);
    }

    fn set(&mut self, x: f64, y: f64, size: f64, anchor: Anchor, turn: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y, size, text) = (number(x), number(y), number(size), escape(text));
        let _ = writeln!(
            self.body,
            "<text class=\"jounce-ink\" x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"#1a1a1a\"{turn}>{text}</text>"
        );
    }
}

/// Returns a coordinate with at most two decimals.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

/// Returns text with the characters of markup escaped; characters not allowed in XML (control
/// characters) are replaced.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        if let Some((_, escape)) = ESCAPES.iter().find(|(plain, _)| *plain == letter) {
            escaped.push_str(escape);
            continue;
        }
        match letter {
            '\t' | '\n' | '\r' => escaped.push(' '),
            letter if letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}') => {
                escaped.push('\u{fffd}')
            }
            letter => escaped.push(letter),
        }
    }
    escaped
}

/// Returns the text of which [`escape`] gives this one.
pub(super) fn unescape(text: &str) -> String {
    let plain = |text: String, (plain, escape): &(char, &str)| {
        text.replace(escape, plain.encode_utf8(&mut [0; 4]))
    };
    ESCAPES.iter().fold(text.to_owned(), plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_texts_are_escaped() {
        assert_eq!(
            [0.0, -0.001, 1.0, 1.005, 12.3456, 100.0].map(number),
            ["0", "0", "1", "1", "12.35", "100"]
        );
        assert_eq!(
            escape("a<b & \"c\" 'd'\u{0}"),
            "a&lt;b &amp; &quot;c&quot; &#39;d&#39;\u{fffd}"
        );
    }
}
