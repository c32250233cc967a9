//! Straight lines through intervals: `start + step k` within `tolerance` of every stamp `k`.
//!
//! Source: J. O'Rourke, "An on-line algorithm for fitting straight lines between data ranges", CACM 24 (1981), 574-578.

/// Set of all lines through the intervals so far: the steepest and the flattest line, and the
/// points that may bound a later one.
#[derive(Default)]
pub(super) struct Corridor {
    /// Lower ends that bound slopes from above, a concave chain, with the first active one; upper
    /// ends, mirrored.
    lower: Chain,
    upper: Chain,
    steepest: Option<CorridorLine>,
    flattest: Option<CorridorLine>,
    closed: bool,
}

#[derive(Clone, Copy)]
struct CorridorPoint {
    x: f64,
    y: f64,
}

#[derive(Clone, Copy)]
struct CorridorLine {
    through: CorridorPoint,
    slope: f64,
}

impl CorridorLine {
    fn between(a: CorridorPoint, b: CorridorPoint) -> Self {
        Self {
            through: b,
            slope: slope(a, b),
        }
    }

    fn at(self, x: f64) -> f64 {
        self.through.y + self.slope * (x - self.through.x)
    }
}

fn slope(a: CorridorPoint, b: CorridorPoint) -> f64 {
    (b.y - a.y) / (b.x - a.x)
}

#[derive(Default)]
struct Chain {
    points: Vec<CorridorPoint>,
    first: usize,
}

impl Chain {
    /// Returns the line from a point of the chain to a later one that `is_better` prefers over its
    /// neighbours; deactivates the points before it.
    fn tangent(
        &mut self,
        to: CorridorPoint,
        is_better: fn(f64, f64) -> bool,
    ) -> Option<CorridorLine> {
        let mut best = slope(*self.points.get(self.first)?, to);
        while let Some(next) = self
            .points
            .get(self.first + 1)
            .map(|point| slope(*point, to))
            .filter(|next| is_better(*next, best))
        {
            best = next;
            self.first += 1;
        }
        Some(CorridorLine {
            through: to,
            slope: best,
        })
    }

    /// Appends a point; `is_convex` decides from the slopes before and after a point if it stays in
    /// the chain.
    fn push(&mut self, point: CorridorPoint, is_convex: fn(f64, f64) -> bool) {
        while let [.., a, b] = self.points[self.first..] {
            if is_convex(slope(a, b), slope(b, point)) {
                break;
            }
            self.points.pop();
        }
        self.points.push(point);
    }
}

impl Corridor {
    /// Adds the interval of the next position; positions ascend.
    pub(super) fn add(&mut self, x: f64, low: f64, high: f64) {
        if self.closed {
            return;
        }
        let (low, high) = (CorridorPoint { x, y: low }, CorridorPoint { x, y: high });
        match (self.steepest, self.flattest) {
            (Some(steepest), Some(flattest)) => {
                self.closed = low.y > steepest.at(x) || high.y < flattest.at(x);
                if high.y < steepest.at(x) {
                    self.steepest = self.lower.tangent(high, |next, best| next < best);
                }
                if low.y > flattest.at(x) {
                    self.flattest = self.upper.tangent(low, |next, best| next > best);
                }
            }
            _ => {
                self.steepest = self
                    .lower
                    .points
                    .first()
                    .map(|first| CorridorLine::between(*first, high));
                self.flattest = self
                    .upper
                    .points
                    .first()
                    .map(|first| CorridorLine::between(*first, low));
            }
        }
        self.lower.push(low, |previous, next| previous > next);
        self.upper.push(high, |previous, next| previous < next);
    }

    /// Flattest and steepest slope of the lines through all intervals; `None` if there is no such
    /// line, or fewer than two intervals.
    pub(super) fn slopes(&self) -> Option<(f64, f64)> {
        let (flattest, steepest) = self.flattest.zip(self.steepest)?;
        (!self.closed && flattest.slope <= steepest.slope)
            .then_some((flattest.slope, steepest.slope))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with the definition: the steepest line over all pairs of a lower end and a later
    /// upper end.
    #[test]
    fn slopes_are_those_of_all_pairs() {
        let random =
            |k: u32| f64::from(k.wrapping_mul(2_654_435_761) >> 8) / f64::from(1u32 << 24) - 0.5;
        for trial in 0..40 {
            let points: Vec<(f64, f64)> = (0..60)
                .map(|k| {
                    (
                        f64::from(k),
                        0.3 * f64::from(k) + 0.9 * random(60 * trial + k),
                    )
                })
                .collect();
            let mut corridor = Corridor::default();
            points
                .iter()
                .for_each(|(x, y)| corridor.add(*x, y - 0.5, y + 0.5));
            let (mut flattest, mut steepest) = (f64::NEG_INFINITY, f64::INFINITY);
            for (k, (xa, ya)) in points.iter().enumerate() {
                for (xb, yb) in &points[k + 1..] {
                    steepest = steepest.min((yb + 0.5 - (ya - 0.5)) / (xb - xa));
                    flattest = flattest.max((yb - 0.5 - (ya + 0.5)) / (xb - xa));
                }
            }
            match corridor.slopes() {
                Some((low, high)) => assert!(
                    (low - flattest).abs() < 1e-12 && (high - steepest).abs() < 1e-12,
                    "{trial}"
                ),
                None => assert!(flattest > steepest, "{trial}"),
            }
        }
        let mut inconsistent = Corridor::default();
        [0.0, 1.0, 5.0]
            .iter()
            .enumerate()
            .for_each(|(k, y)| inconsistent.add(k as f64, y - 0.1, y + 0.1));
        assert_eq!(inconsistent.slopes(), None);
    }
}
