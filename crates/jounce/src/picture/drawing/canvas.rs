//! A sheet that remembers what it covers, so that labels find free places.

use super::labels::{LINE, LabelRequest, placed};
use super::rect::Rect;
use crate::picture::svg::{Anchor, Svg, number};
use crate::picture::text::SMALL;

/// The look of lines.
pub const INK: &str = "class=\"jounce-rule\" stroke=\"#1a1a1a\" stroke-width=\"1.2\" fill=\"none\"";

/// The look of thin lines.
pub const THIN: &str =
    "class=\"jounce-grid\" stroke=\"#8a8a8a\" stroke-width=\"0.8\" fill=\"none\"";

/// An SVG under construction with what it covers.
pub struct Canvas<'s> {
    /// The document.
    pub svg: &'s mut Svg,
    covered: Vec<Rect>,
    wanted: Vec<LabelRequest>,
    /// Left and right edge of what labels may cover.
    page: (f64, f64),
}

impl<'s> Canvas<'s> {
    /// An empty one.
    pub fn new(svg: &'s mut Svg, page: (f64, f64)) -> Self {
        Self {
            svg,
            covered: Vec::new(),
            wanted: Vec::new(),
            page,
        }
    }

    /// A rectangle that labels keep off.
    pub fn solid(&mut self, rect: Rect, look: &str) {
        self.svg
            .rect(rect.left, rect.top, rect.width(), rect.height(), look);
        self.cover(rect);
    }

    /// Keeps labels off a rectangle.
    pub fn cover(&mut self, rect: Rect) {
        self.covered.push(rect);
    }

    /// Asks for a label.
    pub fn label(&mut self, anchor: (f64, f64), toward: (f64, f64), lines: Vec<String>) {
        self.label_along(anchor, Vec::new(), toward, lines);
    }

    /// Asks for a label of something long, whose line may start at other points of it.
    pub fn label_along(
        &mut self,
        anchor: (f64, f64),
        others: Vec<(f64, f64)>,
        toward: (f64, f64),
        lines: Vec<String>,
    ) {
        self.wanted.push(LabelRequest {
            anchor,
            others,
            toward,
            lines,
        });
    }

    /// Sets all labels; gives what everything together covers.
    pub fn finish(self) -> Rect {
        let labels = placed(&self.wanted, &self.covered, self.page);
        for label in &labels {
            if let Some([from, to]) = label.leader {
                let steps = format!(
                    "M{} {}L{} {}",
                    number(from.0),
                    number(from.1),
                    number(to.0),
                    number(to.1)
                );
                self.svg.path(&steps, THIN);
            }
            for (line, text) in label.lines.iter().enumerate() {
                let middle = 0.5 * (label.room.left + label.room.right);
                self.svg.text(
                    middle,
                    label.room.top + 11.5 + LINE * line as f64,
                    SMALL,
                    Anchor::Middle,
                    text,
                );
            }
        }
        self.covered
            .iter()
            .chain(labels.iter().map(|label| &label.room))
            .fold(Rect::EMPTY, |all, rect| all.joined(rect))
    }
}
