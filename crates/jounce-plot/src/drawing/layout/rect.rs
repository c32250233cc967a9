//! Axis-parallel rectangles on the sheet.

/// A rectangle by its edges, px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Right edge.
    pub right: f64,
    /// Lower edge.
    pub bottom: f64,
}

impl Rect {
    /// Empty rectangle; joined with another it gives the other.
    pub const EMPTY: Self = Self {
        left: f64::INFINITY,
        top: f64::INFINITY,
        right: f64::NEG_INFINITY,
        bottom: f64::NEG_INFINITY,
    };

    /// Creates a rectangle by its centre and its size.
    pub fn around((x, y): (f64, f64), (width, height): (f64, f64)) -> Self {
        Self {
            left: x - 0.5 * width,
            top: y - 0.5 * height,
            right: x + 0.5 * width,
            bottom: y + 0.5 * height,
        }
    }

    /// Creates a rectangle between two corners in any order.
    pub fn between(a: (f64, f64), b: (f64, f64)) -> Self {
        Self {
            left: a.0.min(b.0),
            top: a.1.min(b.1),
            right: a.0.max(b.0),
            bottom: a.1.max(b.1),
        }
    }

    /// Returns the width.
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    /// Returns the height.
    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Returns the rectangle enlarged by `by` on every side.
    pub fn grown(&self, by: f64) -> Self {
        Self {
            left: self.left - by,
            top: self.top - by,
            right: self.right + by,
            bottom: self.bottom + by,
        }
    }

    /// Returns the smallest rectangle that holds both.
    pub fn joined(&self, other: &Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// True where the two interiors have a common point.
    pub fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    /// Returns the point of the rectangle nearest to another point.
    pub fn nearest(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (
            x.clamp(self.left, self.right),
            y.clamp(self.top, self.bottom),
        )
    }

    /// True where a straight line segment passes through it.
    pub fn crossed(&self, from: (f64, f64), to: (f64, f64)) -> bool {
        // Part of the line between two opposite edges, in each direction (Liang and Barsky 1984).
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for (start, step, low, high) in [
            (from.0, to.0 - from.0, self.left, self.right),
            (from.1, to.1 - from.1, self.top, self.bottom),
        ] {
            if step == 0.0 {
                if start <= low || start >= high {
                    return false;
                }
            } else {
                let (a, b) = ((low - start) / step, (high - start) / step);
                (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
            }
        }
        first < last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_meet_and_lines_cross_them() {
        let unit = Rect::between((0.0, 0.0), (1.0, 1.0));
        assert!(
            unit.meets(&unit.grown(-0.1)) && !unit.meets(&Rect::between((1.0, 0.0), (2.0, 1.0)))
        );
        assert!(unit.crossed((-1.0, 0.2), (2.0, 0.8)) && unit.crossed((0.5, 0.5), (5.0, 5.0)));
        assert!(
            !unit.crossed((-1.0, 0.9), (0.2, 2.1))
                && !unit.crossed((-1.0, 1.0), (2.0, 1.0))
                && !unit.crossed((2.0, 0.5), (3.0, 0.5))
        );
        assert_eq!(
            (unit.nearest((3.0, 0.5)), Rect::EMPTY.joined(&unit)),
            ((1.0, 0.5), unit)
        );
    }
}
