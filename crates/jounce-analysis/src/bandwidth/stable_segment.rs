//! Stable part of the curve between two neighbouring points of a branch.

use super::result::{BandLimit, IntervalEdge};
use crate::BranchPoint;

/// Fraction of the key interval from a stable to an unstable end, within which a stability change
/// counts as at the stable end.
const HARD_STABILITY_CHANGE: f64 = 0.01;

/// End of a segment.
#[derive(Debug, Clone, Copy)]
pub struct SegmentEnd {
    /// Fraction of the piece.
    pub x: f64,
    pub power_w: f64,
    /// Relative error of the power.
    pub power_error: f64,
    pub edge: IntervalEdge,
}

/// Stable part of the curve between two neighbouring points.
#[derive(Clone, Copy)]
pub struct StableSegment<'b> {
    pub cycles: u32,
    pub points: [&'b BranchPoint; 2],
    pub ends: [SegmentEnd; 2],
}

impl StableSegment<'_> {
    /// Returns the larger power of the two ends if no neighbouring segment rises further from
    /// there.
    pub fn highest_end_power(&self, all: &[StableSegment]) -> Option<f64> {
        let top = usize::from(self.ends[1].power_w > self.ends[0].power_w);
        let power_w = self.ends[top].power_w;
        let rises = |other: &StableSegment| {
            let shared = other
                .points
                .iter()
                .position(|point| std::ptr::eq(*point, self.points[top]));
            shared.is_some_and(|shared| other.ends[1 - shared].power_w > power_w)
        };
        (!all.iter().any(rises)).then_some(power_w)
    }

    /// Returns the distance of a value of the key from the farther one of the two points.
    pub fn largest_distance(&self, parameter: f64) -> f64 {
        self.points
            .iter()
            .map(|point| (point.parameter - parameter).abs())
            .fold(0.0, f64::max)
    }

    /// Returns the stability boundary beyond a stable end, known only to the width of the piece,
    /// where the curve between its points cannot be computed.
    pub fn unresolved_end(&self, stable: usize) -> SegmentEnd {
        let [a, b] = self.points;
        let parameter_error = (b.parameter - a.parameter).abs();
        let edge = IntervalEdge {
            parameter: self.points[stable].parameter,
            parameter_error,
            at: BandLimit::Stability,
        };
        SegmentEnd {
            edge,
            ..self.ends[stable]
        }
    }

    /// Sets the end of the stable part at a fold close to the stable end. The key may reach beyond
    /// the fold there by less than the error; the edge is then the stable end.
    pub fn turn_back(&mut self, stable: usize, edge: IntervalEdge) {
        let [stable_parameter, other] = [
            self.points[stable].parameter,
            self.points[1 - stable].parameter,
        ];
        let distance = (stable_parameter - edge.parameter).abs();
        if distance < HARD_STABILITY_CHANGE * (other - edge.parameter).abs() {
            let parameter_error = edge.parameter_error + distance;
            self.ends[stable].edge = IntervalEdge {
                parameter: stable_parameter,
                parameter_error,
                at: BandLimit::Stability,
            };
        }
    }

    /// Interpolates half power linearly between the ends, where the curve between them cannot be
    /// computed.
    pub fn between(&self, half_w: f64) -> IntervalEdge {
        let [a, b] = self.ends;
        let width = b.edge.parameter - a.edge.parameter;
        let share = (half_w - a.power_w) / (b.power_w - a.power_w);
        IntervalEdge {
            parameter: a.edge.parameter + share * width,
            parameter_error: width.abs(),
            at: BandLimit::HalfPower,
        }
    }
}
