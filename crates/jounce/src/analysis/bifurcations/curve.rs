//! What a jump search answers.

use crate::analysis::BranchKind;
use serde::Serialize;

/// What is followed over two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CurveKind {
    /// The largest mean power along a branch over the first key.
    Peak,
    /// A bifurcation.
    #[serde(untagged)]
    Bifurcation(BranchKind),
}

impl CurveKind {
    /// Name in answers.
    pub fn name(self) -> &'static str {
        match self {
            CurveKind::Peak => "peak",
            CurveKind::Bifurcation(kind) => kind.name(),
        }
    }
}

/// Share of the widths, and of the power, within which a curve ends on its start.
const CLOSED_CURVE_SHARE: f64 = 1e-5;

/// A curve of one kind over two keys.
#[derive(Debug, Clone, PartialEq)]
pub struct BifurcationCurve {
    /// What happens on it.
    pub kind: CurveKind,
    /// The level that is passed, as it was given.
    pub level: Option<String>,
    /// Period of its orbits in drive cycles.
    pub period_cycles: u32,
    /// Points along it.
    pub points: Vec<BifurcationCurvePoint>,
    /// Where it could not be followed, and why.
    pub failures: Vec<String>,
}

/// A point of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BifurcationCurvePoint {
    /// First key, SI.
    pub parameter: f64,
    /// Second key, SI.
    pub parameter_2: f64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// On a curve of peaks, whether the orbit attracts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stable: Option<bool>,
}

impl BifurcationCurve {
    /// First key and power where the curve passes a value of the second, interpolated linearly.
    pub fn crossings(&self, parameter_2: f64) -> Vec<(f64, f64)> {
        let between = |pair: &[BifurcationCurvePoint]| {
            let (a, b) = (&pair[0], &pair[1]);
            let t = (parameter_2 - a.parameter_2) / (b.parameter_2 - a.parameter_2);
            let at = |x: f64, y: f64| x + t * (y - x);
            (0.0..=1.0).contains(&t).then(|| {
                (
                    at(a.parameter, b.parameter),
                    at(a.mean_power_w, b.mean_power_w),
                )
            })
        };
        self.points.windows(2).filter_map(between).collect()
    }

    /// Ends a curve that came back over its own points, as one does that misses the way round a corner, where it turned round: half-way. It is
    /// known to have come back, or ends on its very start; widths are those of the keys.
    pub(super) fn end_where_it_turned(&mut self, came_back: bool, widths: [f64; 2]) {
        let way = |a: &BifurcationCurvePoint, b: &BifurcationCurvePoint| {
            ((b.parameter - a.parameter) / widths[0])
                .hypot((b.parameter_2 - a.parameter_2) / widths[1])
        };
        let ends_on_start = match &self.points[..] {
            [first, .., last] => {
                let power_w = (last.mean_power_w - first.mean_power_w).abs();
                self.points.len() > 4
                    && way(first, last) < CLOSED_CURVE_SHARE
                    && power_w <= CLOSED_CURVE_SHARE * first.mean_power_w.abs()
            }
            _ => false,
        };
        if !(came_back || ends_on_start) {
            return;
        }
        let mut left = 0.5
            * self
                .points
                .windows(2)
                .map(|pair| way(&pair[0], &pair[1]))
                .sum::<f64>();
        let is_before = |pair: &[BifurcationCurvePoint]| {
            left -= way(&pair[0], &pair[1]);
            left > 0.0
        };
        let turn = self
            .points
            .windows(2)
            .map(is_before)
            .take_while(|is_before| *is_before)
            .count();
        self.points.truncate(turn + 1);
        let at = self.points.last().map_or(f64::NAN, |last| last.parameter_2);
        self.failures
            .push(format!("from {at} the walk came back over its own points"));
    }

    /// True when another curve is of the same kind and period.
    pub(super) fn is_alike(&self, other: &BifurcationCurve) -> bool {
        (self.kind, &self.level, self.period_cycles)
            == (other.kind, &other.level, other.period_cycles)
    }

    /// Joins a walk in the other direction from the same first point.
    pub fn joined(mut self, other: BifurcationCurve) -> BifurcationCurve {
        self.points.reverse();
        self.points.extend(other.points.into_iter().skip(1));
        self.failures.extend(other.failures);
        self
    }
}
