//! Ends of stable segments, where the largest multiplier passes modulus one.

use super::curve_piece::PiecePoint;
use super::measure::BandwidthSearch;
use super::result::{BandLimit, IntervalEdge};
use super::stable_segment::{SegmentEnd, StableSegment};
use crate::Branch;
use crate::branches::RESOLUTION;

/// Error of a multiplier relative to the tolerance of the integration.
const MULTIPLIER_ERROR_FACTOR: f64 = 1e3;

impl BandwidthSearch<'_> {
    /// Returns the point where the largest multiplier has modulus one; `inwards` leads to the
    /// stable side.
    pub(super) fn stability_edge(
        &self,
        segment: &StableSegment,
        inwards: f64,
    ) -> Option<SegmentEnd> {
        let piece = self.piece(segment)?;
        let margin = |point: &PiecePoint| Some(1.0 - point.floquet_max_abs()?);
        let zero = piece.zero((0.0, 1.0), self.tolerance, margin)?;
        let neighbour = piece.at(zero.point.x + inwards)?;
        let slope = (margin(&neighbour)? - zero.value) / inwards;
        let x_error = (zero.value.abs() + MULTIPLIER_ERROR_FACTOR * self.tolerance) / slope.abs();
        // At a fold the key is stationary, so the second-order term counts.
        let parameter_error = piece.parameter_error(&zero.point, x_error)?
            + x_error * x_error * (self.range.1 - self.range.0);
        // The boundary lies between the two points, even where the multiplier passes modulus one
        // slowly.
        let parameter_error = parameter_error.min(segment.largest_distance(zero.point.parameter()));
        let edge = IntervalEdge {
            parameter: zero.point.parameter(),
            parameter_error,
            at: BandLimit::Stability,
        };
        let power_error = 2.0 * piece.orbit(&zero.point)?.error_estimate;
        Some(SegmentEnd {
            x: zero.point.x,
            power_w: zero.point.mean_power_w(),
            power_error,
            edge,
        })
    }

    /// Returns the bifurcation located during continuation, where the curve between the points
    /// cannot be computed; `stable` is the stable end.
    pub(super) fn located(
        &self,
        segment: &StableSegment,
        branch: &Branch,
        stable: usize,
    ) -> Option<SegmentEnd> {
        let [a, b] = segment.points;
        let event = branch.bifurcation_between([a, b])?;
        let x_error = MULTIPLIER_ERROR_FACTOR * self.tolerance
            / (a.orbit.floquet_max_abs() - b.orbit.floquet_max_abs()).abs();
        let parameter_error = x_error * (a.parameter - b.parameter).abs()
            + RESOLUTION * (self.range.1 - self.range.0);
        let edge = IntervalEdge {
            parameter: event.parameter,
            parameter_error,
            at: BandLimit::Stability,
        };
        let power_error = 2.0 * event.orbit.error_estimate;
        Some(SegmentEnd {
            edge,
            power_w: event.orbit.mean_power_w,
            power_error,
            ..segment.ends[stable]
        })
    }
}
