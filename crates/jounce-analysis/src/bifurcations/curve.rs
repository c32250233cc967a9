//! Results of a search for bifurcation curves.

use crate::BranchKind;
use serde::Serialize;

/// Kind of a curve over two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CurveKind {
    /// Largest mean power along a branch over the first key.
    Peak,
    /// Bifurcation.
    #[serde(untagged)]
    Bifurcation(BranchKind),
}

impl CurveKind {
    /// Returns the name in results.
    pub fn name(self) -> &'static str {
        match self {
            CurveKind::Peak => "peak",
            CurveKind::Bifurcation(kind) => kind.name(),
        }
    }
}

/// Fraction of the widths and of the power, within which a curve ends on its start.
const CLOSED_CURVE_SHARE: f64 = 1e-5;

/// Curve of one kind over two keys.
#[derive(Debug, Clone, PartialEq)]
pub struct BifurcationCurve {
    /// Kind of the curve.
    pub kind: CurveKind,
    /// Level that is crossed, as specified.
    pub level: Option<String>,
    /// Period of the orbits in drive cycles.
    pub period_cycles: u32,
    /// Points along the curve.
    pub points: Vec<BifurcationCurvePoint>,
    /// Messages with place and reason where continuation stopped early.
    pub failures: Vec<String>,
}

/// Point of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BifurcationCurvePoint {
    /// First key, SI.
    pub parameter: f64,
    /// Second key, SI.
    pub parameter_2: f64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// True if the orbit attracts; only on a curve of peaks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stable: Option<bool>,
}

impl BifurcationCurve {
    /// Returns first key and power where the curve crosses a value of the second key, interpolated
    /// linearly.
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

    /// Cuts at half its length a curve that turned back over its own points, which happens at a
    /// missed corner. `came_back` states that it did; otherwise it must end exactly on its start.
    /// The widths are those of the ranges of the keys.
    pub(super) fn truncate_at_turn(&mut self, came_back: bool, widths: [f64; 2]) {
        let distance = |a: &BifurcationCurvePoint, b: &BifurcationCurvePoint| {
            ((b.parameter - a.parameter) / widths[0])
                .hypot((b.parameter_2 - a.parameter_2) / widths[1])
        };
        let ends_on_start = match &self.points[..] {
            [first, .., last] => {
                let power_w = (last.mean_power_w - first.mean_power_w).abs();
                self.points.len() > 4
                    && distance(first, last) < CLOSED_CURVE_SHARE
                    && power_w <= CLOSED_CURVE_SHARE * first.mean_power_w.abs()
            }
            _ => false,
        };
        if !(came_back || ends_on_start) {
            return;
        }
        let mut remaining = 0.5
            * self
                .points
                .windows(2)
                .map(|pair| distance(&pair[0], &pair[1]))
                .sum::<f64>();
        let is_before = |pair: &[BifurcationCurvePoint]| {
            remaining -= distance(&pair[0], &pair[1]);
            remaining > 0.0
        };
        let turn = self
            .points
            .windows(2)
            .map(is_before)
            .take_while(|is_before| *is_before)
            .count();
        self.points.truncate(turn + 1);
        let at = self.points.last().map_or(f64::NAN, |last| last.parameter_2);
        self.failures.push(format!(
            "from {at} the curve turned back over its own points"
        ));
    }

    /// True when another curve has the same kind and period.
    pub(super) fn is_alike(&self, other: &BifurcationCurve) -> bool {
        (self.kind, &self.level, self.period_cycles)
            == (other.kind, &other.level, other.period_cycles)
    }

    /// Joins the continuation in the other direction from the same first point.
    pub fn joined(mut self, other: BifurcationCurve) -> BifurcationCurve {
        self.points.reverse();
        self.points.extend(other.points.into_iter().skip(1));
        self.failures.extend(other.failures);
        self
    }
}
