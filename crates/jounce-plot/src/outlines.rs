//! Texts of an SVG as the outlines of their letters, so that a renderer needs no fonts.

use std::fmt::Write as _;

use resvg::usvg::roxmltree::{Document, Node};
use ttf_parser::OutlineBuilder;

use super::svg::number;
use super::text::{FACE, advance, width};

/// Start of the ids of the paths of texts.
const ID: &str = "text-";

/// A document without texts: each is a path, whose id leads to the text.
pub(super) struct Outlined {
    /// The document.
    pub svg: String,
    /// Its title; may be empty.
    pub title: String,
    texts: Vec<PlacedText>,
}

/// A text whose baseline begins at `(x, y)`.
pub(super) struct PlacedText {
    /// Its letters.
    pub letters: String,
    /// Size of the font, pixels.
    pub size: f64,
    /// Start of the baseline, pixels.
    pub x: f64,
    /// Height of the baseline, pixels from the top.
    pub y: f64,
}

impl Outlined {
    /// Replaces every text by its outlines. A document that is not XML remains as it is.
    pub fn new(svg: &str) -> Self {
        let Ok(document) = Document::parse(svg) else {
            return Self {
                svg: svg.to_owned(),
                title: String::new(),
                texts: Vec::new(),
            };
        };
        let (mut outlined, mut copied) = (String::with_capacity(2 * svg.len()), 0);
        let mut texts = Vec::new();
        for node in document.descendants().filter(|n| n.has_tag_name("text")) {
            let (range, text) = (node.range(), PlacedText::of(node));
            outlined.push_str(&svg[copied..range.start]);
            write_path(&mut outlined, &format!("{ID}{}", texts.len()), node, &text);
            texts.push(text);
            copied = range.end;
        }
        outlined.push_str(&svg[copied..]);
        let title = document.descendants().find(|n| n.has_tag_name("title"));
        Self {
            svg: outlined,
            title: title.and_then(|n| n.text()).unwrap_or_default().to_owned(),
            texts,
        }
    }

    /// Returns the text of the path with an id.
    pub fn text(&self, id: &str) -> Option<&PlacedText> {
        self.texts.get(id.strip_prefix(ID)?.parse::<usize>().ok()?)
    }
}

impl PlacedText {
    fn of(node: Node<'_, '_>) -> Self {
        let length = |name| {
            let value = node.attribute(name).and_then(|value| value.parse().ok());
            value.unwrap_or(0.0_f64)
        };
        let (letters, size) = (node.text().unwrap_or_default(), length("font-size"));
        let before = match node.attribute("text-anchor") {
            Some("middle") => 0.5 * width(letters, size),
            Some("end") => width(letters, size),
            _ => 0.0,
        };
        Self {
            letters: letters.to_owned(),
            size,
            x: length("x") - before,
            y: length("y"),
        }
    }
}

/// Writes one text as a path with its colour and rotation.
fn write_path(svg: &mut String, id: &str, node: Node<'_, '_>, text: &PlacedText) {
    let mut outline = Outline {
        scale: text.size / f64::from(FACE.units_per_em()),
        x: text.x,
        y: text.y,
        steps: String::new(),
    };
    for letter in text.letters.chars() {
        if let Some(glyph) = FACE.glyph_index(letter) {
            FACE.outline_glyph(glyph, &mut outline);
        }
        outline.x += advance(letter) * outline.scale;
    }
    let _ = write!(svg, "<path id=\"{id}\" d=\"{}\"", outline.steps);
    for name in ["fill", "transform"] {
        if let Some(value) = node.attribute(name) {
            let _ = write!(svg, " {name}=\"{value}\"");
        }
    }
    svg.push_str("/>");
}

/// Steps of a path, from letters whose baseline begins at `(x, y)`.
struct Outline {
    scale: f64,
    x: f64,
    y: f64,
    steps: String,
}

impl Outline {
    fn add<const N: usize>(&mut self, step: char, points: [(f32, f32); N]) {
        self.steps.push(step);
        for (x, y) in points {
            let (x, y) = (
                self.x + self.scale * f64::from(x),
                self.y - self.scale * f64::from(y),
            );
            let _ = write!(self.steps, "{} {} ", number(x), number(y));
        }
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.add('M', [(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add('L', [(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.add('Q', [(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.add('C', [(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.add('Z', []);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The letter `l` of DejaVu Sans is a rectangle from 193 to 377 and from 0 to 1556 of 2048
    /// units per em; its advance is 569.
    #[test]
    fn a_letter_has_the_outline_of_the_font() {
        let letter = |anchor: &str| {
            let svg = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\"><text x=\"1000\" y=\"2000\" font-size=\"2048\" text-anchor=\"{anchor}\" fill=\"#123456\">l</text></svg>"
            );
            Outlined::new(&svg).svg
        };
        let left = |anchor: &str| {
            let svg = letter(anchor);
            let steps = svg.split(['M', 'L']).skip(1).map(|step| {
                let x = step.split(' ').next().expect("a step has a point");
                x.parse::<f64>().expect("an x is a number")
            });
            steps.fold(f64::INFINITY, f64::min)
        };
        assert_eq!(left("start"), 1193.0);
        assert_eq!(left("middle"), 1193.0 - 284.5);
        assert_eq!(left("end"), 1193.0 - 569.0);
        let svg = letter("start");
        assert!(
            svg.contains("1377 444") && svg.contains("fill=\"#123456\"") && !svg.contains("<text")
        );
    }
}
