//! Content of the page: the elements that figures have, which are paths of one colour, windows and
//! texts.

use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Name, Str};
use resvg::usvg::tiny_skia_path::{Path as Steps, PathSegment, Point, Transform};
use resvg::usvg::{
    ClipPath, Color, FillRule, Group, LineCap, LineJoin, Node, Paint, Path, Stroke, Tree,
};

use super::font::{self, Font};
use crate::outlines::{Outlined, PlacedText};
use crate::text::advance;

/// Writer of the content.
pub(super) struct Painter<'a> {
    document: &'a Outlined,
    /// The content so far.
    pub content: Content,
    /// Letters of the texts so far.
    pub font: Font,
    /// Opacities of areas and lines that the content uses.
    pub opacities: Vec<[f32; 2]>,
    /// False where the drawing has an element other than paths of one colour and texts.
    pub is_complete: bool,
}

/// Returns the name of the graphics state with the opacities at `index`.
pub(super) fn state_name(index: usize) -> String {
    format!("G{index}")
}

impl<'a> Painter<'a> {
    pub fn new(document: &'a Outlined) -> Self {
        Self {
            document,
            content: Content::new(),
            font: Font::default(),
            opacities: Vec::new(),
            is_complete: true,
        }
    }

    /// Paints a drawing, whose vertical axis points down, on a page in points, whose axis points up.
    pub fn paint(&mut self, tree: &Tree, [scale, height]: [f32; 2]) {
        self.content
            .transform([scale, 0.0, 0.0, -scale, 0.0, height]);
        self.group(tree.root());
    }

    fn group(&mut self, group: &Group) {
        if let Some(clip) = group.clip_path() {
            self.content.save_state();
            self.clip(clip, group.abs_transform());
        }
        for node in group.children() {
            match node {
                Node::Group(inner) => self.group(inner),
                Node::Path(path) => self.path(path),
                Node::Image(_) | Node::Text(_) => self.is_complete = false,
            }
        }
        if group.clip_path().is_some() {
            self.content.restore_state();
        }
    }

    fn clip(&mut self, clip: &ClipPath, place: Transform) {
        let place = place.pre_concat(clip.transform());
        for node in clip.root().children() {
            if let Node::Path(path) = node {
                let steps = path.data().clone();
                if let Some(steps) = steps.transform(place.pre_concat(path.abs_transform())) {
                    self.steps(&steps);
                }
            }
        }
        self.content.clip_nonzero().end_path();
    }

    fn path(&mut self, path: &Path) {
        let fill = path.fill().and_then(|fill| plain(fill.paint()));
        let stroke = path.stroke().and_then(|stroke| plain(stroke.paint()));
        self.is_complete &=
            fill.is_some() == path.fill().is_some() && stroke.is_some() == path.stroke().is_some();
        self.content.save_state();
        let place = path.abs_transform();
        if !place.is_identity() {
            let Transform {
                sx,
                kx,
                ky,
                sy,
                tx,
                ty,
            } = place;
            self.content.transform([sx, ky, kx, sy, tx, ty]);
        }
        self.opacity([
            path.fill().map_or(1.0, |fill| fill.opacity().get()),
            path.stroke().map_or(1.0, |stroke| stroke.opacity().get()),
        ]);
        if let Some([red, green, blue]) = fill {
            self.content.set_fill_rgb(red, green, blue);
        }
        if let (Some([red, green, blue]), Some(stroke)) = (stroke, path.stroke()) {
            self.content.set_stroke_rgb(red, green, blue);
            self.pen(stroke);
        }
        if let Some(text) = self.document.text(path.id()) {
            self.text(text);
        } else {
            self.steps(path.data());
            let even_odd = path
                .fill()
                .is_some_and(|fill| fill.rule() == FillRule::EvenOdd);
            match (fill.is_some(), stroke.is_some()) {
                (true, true) if even_odd => self.content.fill_even_odd_and_stroke(),
                (true, true) => self.content.fill_nonzero_and_stroke(),
                (true, false) if even_odd => self.content.fill_even_odd(),
                (true, false) => self.content.fill_nonzero(),
                (false, true) => self.content.stroke(),
                (false, false) => self.content.end_path(),
            };
        }
        self.content.restore_state();
    }

    fn opacity(&mut self, opacity: [f32; 2]) {
        if opacity == [1.0; 2] {
            return;
        }
        let known = self.opacities.iter().position(|own| *own == opacity);
        let index = known.unwrap_or_else(|| {
            self.opacities.push(opacity);
            self.opacities.len() - 1
        });
        let name = state_name(index);
        self.content.set_parameters(Name(name.as_bytes()));
    }

    fn pen(&mut self, stroke: &Stroke) {
        self.content
            .set_line_width(stroke.width().get())
            .set_line_cap(match stroke.linecap() {
                LineCap::Butt => LineCapStyle::ButtCap,
                LineCap::Round => LineCapStyle::RoundCap,
                LineCap::Square => LineCapStyle::ProjectingSquareCap,
            })
            .set_line_join(match stroke.linejoin() {
                LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
                LineJoin::Round => LineJoinStyle::RoundJoin,
                LineJoin::Bevel => LineJoinStyle::BevelJoin,
            })
            .set_miter_limit(stroke.miterlimit().get());
        if let Some(dashes) = stroke.dasharray() {
            self.content
                .set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
        }
    }

    fn steps(&mut self, steps: &Steps) {
        let content = &mut self.content;
        let mut last = Point::zero();
        for step in steps.segments() {
            match step {
                PathSegment::MoveTo(to) => content.move_to(to.x, to.y),
                PathSegment::LineTo(to) => content.line_to(to.x, to.y),
                PathSegment::QuadTo(by, to) => {
                    let [(x1, y1), (x2, y2)] = [last, to].map(|end| {
                        let part = |end: f32, by: f32| end + (by - end) * 2.0 / 3.0;
                        (part(end.x, by.x), part(end.y, by.y))
                    });
                    content.cubic_to(x1, y1, x2, y2, to.x, to.y)
                }
                PathSegment::CubicTo(one, two, to) => {
                    content.cubic_to(one.x, one.y, two.x, two.y, to.x, to.y)
                }
                PathSegment::Close => content.close_path(),
            };
            if let PathSegment::MoveTo(to)
            | PathSegment::LineTo(to)
            | PathSegment::QuadTo(_, to)
            | PathSegment::CubicTo(_, _, to) = step
            {
                last = to;
            }
        }
    }

    /// Shows the letters of a text; one that the font lacks leaves its width.
    fn text(&mut self, text: &PlacedText) {
        self.content
            .begin_text()
            .set_font(font::NAME, text.size as f32)
            .set_text_matrix([1.0, 0.0, 0.0, -1.0, text.x as f32, text.y as f32]);
        let mut shown = self.content.show_positioned();
        let mut items = shown.items();
        for letter in text.letters.chars() {
            match self.font.glyph(letter) {
                Some(glyph) => items.show(Str(&glyph.to_be_bytes())),
                None => items.adjust(-font::width(advance(letter))),
            };
        }
        drop(items);
        drop(shown);
        self.content.end_text();
    }
}

/// Returns the parts of a plain colour, to three decimals, which 8 bits need; `None` for any other
/// paint.
fn plain(paint: &Paint) -> Option<[f32; 3]> {
    let Paint::Color(Color { red, green, blue }) = paint else {
        return None;
    };
    Some([*red, *green, *blue].map(|part| (f32::from(part) / 0.255).round() / 1000.0))
}
