//! A sheet that records covered areas, so that labels find free positions.

use super::layout::labels::{LINE, LabelRequest, place_labels};
use super::layout::rect::Rect;
use crate::svg::{Anchor, Svg, number};
use crate::text::SMALL;

/// Style of lines.
pub const INK: &str = "class=\"jounce-rule\" stroke=\"#1a1a1a\" stroke-width=\"1.2\" fill=\"none\"";

/// Style of thin lines.
pub const THIN: &str =
    "class=\"jounce-grid\" stroke=\"#8a8a8a\" stroke-width=\"0.8\" fill=\"none\"";

/// An SVG under construction with its covered areas.
pub struct Canvas<'s> {
    /// Document.
    pub svg: &'s mut Svg,
    covered: Vec<Rect>,
    requests: Vec<LabelRequest>,
    /// Left and right limits of labels.
    page: (f64, f64),
}

impl<'s> Canvas<'s> {
    /// Creates an empty canvas.
    pub fn new(svg: &'s mut Svg, page: (f64, f64)) -> Self {
        Self {
            svg,
            covered: Vec::new(),
            requests: Vec::new(),
            page,
        }
    }

    /// Draws a rectangle that labels avoid.
    pub fn solid(&mut self, rect: Rect, style: &str) {
        self.svg
            .rect(rect.left, rect.top, rect.width(), rect.height(), style);
        self.cover(rect);
    }

    /// Marks a rectangle that labels avoid.
    pub fn cover(&mut self, rect: Rect) {
        self.covered.push(rect);
    }

    /// Requests a label.
    pub fn label(&mut self, anchor: (f64, f64), toward: (f64, f64), lines: Vec<String>) {
        self.label_along(anchor, Vec::new(), toward, lines);
    }

    /// Requests a label of a long element; the leader may start at other points of it.
    pub fn label_along(
        &mut self,
        anchor: (f64, f64),
        others: Vec<(f64, f64)>,
        toward: (f64, f64),
        lines: Vec<String>,
    ) {
        self.requests.push(LabelRequest {
            anchor,
            others,
            toward,
            lines,
        });
    }

    /// Places all labels; returns the area covered by all elements.
    pub fn finish(self) -> Rect {
        let labels = place_labels(&self.requests, &self.covered, self.page);
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
