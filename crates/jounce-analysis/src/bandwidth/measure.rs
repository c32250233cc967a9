//! Peaks and half-power bandwidths of branches, from stable orbits only.
//!
//! A branch is cut into stable segments: the intervals between its points, ended where the largest
//! multiplier passes modulus one. The peak is an end of a segment or a zero of `dP/ds`. The zeros
//! of `P - P_peak / 2` end the half-power intervals.
//!
//! Let `E` be the relative error of the power, twice that of the state. A peak has the error `E |P|
//! / |d2P/dp2| / step`. A half-power edge has the error `E |P| / |dP/dp|`, where `E` includes that
//! of the peak. A stability boundary has the error of the multiplier over its slope, at most the
//! distance to the farther one of its two neighbouring points. The residual error of Newton's
//! method is added to each. Where a branch meets another one inside the range, at a doubling for
//! example, the edge lies within one step of its last point, so its error is the length of that step.
//! Where continuation fails, the branch may continue beyond the edge.

use super::curve_piece::CurvePiece;
use super::merge::merged;
use super::result::{BandInterval, BandLimit, Bandwidth, Bandwidths, IntervalEdge, PowerPeak};
use super::stable_segment::{SegmentEnd, StableSegment};
use crate::{Branch, BranchPoint, Model, Parameter, Termination};
use jounce_continuation::Corrector;
use jounce_orbits::Shooting;
use rayon::prelude::*;

/// Pieces whose power is below this fraction of the largest have no peak of their own.
const MIN_PEAK_SHARE: f64 = 0.9;

/// Stability boundaries whose power is below this fraction of the largest lie outside every
/// half-power interval and are not located.
const MIN_HALF_SHARE: f64 = 0.4;

/// Distance to the neighbouring point of a difference, as a fraction of a piece.
pub(super) const NEIGHBOUR_DISTANCE: f64 = 0.02;

/// Definition of a bandwidth computation.
#[derive(Debug)]
pub struct BandwidthSearch<'s> {
    /// Model of the spec, unchanged.
    pub base: &'s Model,
    /// Family of models over the key.
    pub parameter: &'s Parameter<'s>,
    /// Ends of the range.
    pub range: (f64, f64),
    /// Relative tolerance of the integrations.
    pub tolerance: f64,
}

/// Stable part of a branch with its peak.
struct StablePart<'b> {
    segments: Vec<StableSegment<'b>>,
    peak: PowerPeak,
    /// Relative error of the peak power.
    power_error: f64,
}

impl<'s> BandwidthSearch<'s> {
    /// Computes the bandwidth of each branch and of all branches combined.
    pub fn run(&self, branches: &[Branch]) -> Bandwidths {
        let stable: Vec<Option<StablePart>> = branches
            .par_iter()
            .map(|branch| self.stable(branch))
            .collect();
        let band = |part: &Option<StablePart>| {
            part.as_ref()
                .map(|part| self.above_half((part.peak, part.power_error), &part.segments))
        };
        let band: Vec<Option<Bandwidth>> = stable.iter().map(band).collect();
        if let [only] = &band[..] {
            return Bandwidths {
                together: only.clone(),
                branches: band,
            };
        }
        let all: Vec<StablePart> = stable.into_iter().flatten().collect();
        let highest = all
            .iter()
            .map(|part| (part.peak, part.power_error))
            .max_by(|a, b| a.0.mean_power_w.total_cmp(&b.0.mean_power_w));
        let segments: Vec<StableSegment> = all.into_iter().flat_map(|part| part.segments).collect();
        Bandwidths {
            branches: band,
            together: highest.map(|peak| self.above_half(peak, &segments)),
        }
    }

    fn stable<'b>(&self, branch: &'b Branch) -> Option<StablePart<'b>> {
        let pairs: Vec<&[BranchPoint]> = branch.points.windows(2).collect();
        let stable = branch.points.iter().filter(|point| point.orbit.is_stable());
        let largest_w = stable
            .map(|point| point.orbit.mean_power_w)
            .fold(0.0, f64::max);
        if largest_w == 0.0 {
            // Without power there is no half-power level.
            return None;
        }
        let low_w = MIN_HALF_SHARE * largest_w;
        let segments: Vec<StableSegment> = pairs
            .into_par_iter()
            .filter_map(|pair| self.segment(branch, [&pair[0], &pair[1]], low_w))
            .collect();
        let (mut peak, power_error) = self.peak(&segments)?;
        let outer = branch
            .points
            .first()
            .into_iter()
            .chain(branch.points.last());
        let closed = branch.endings.contains(&Termination::Closed);
        if peak.at == BandLimit::End
            && (closed
                || outer
                    .into_iter()
                    .all(|point| point.parameter != peak.parameter))
        {
            peak.at = BandLimit::Maximum;
        }
        Some(StablePart {
            segments,
            peak,
            power_error,
        })
    }

    /// Returns the curve between the two points of a segment.
    pub(super) fn piece(&self, segment: &StableSegment) -> Option<CurvePiece<'s, Parameter<'s>>> {
        let shooting = Shooting::new(
            self.parameter,
            &self.base.kernel,
            segment.cycles,
            self.tolerance,
        );
        let corrector = Corrector {
            goal: (10.0 * self.tolerance).clamp(1e-11, 1e-6),
            most: 8,
        };
        CurvePiece::new(
            shooting,
            corrector,
            (self.range.1 - self.range.0) / 20.0,
            segment.points,
        )
    }

    /// Returns the stable part between two neighbouring points; `None` where it ends below `low_w`.
    fn segment<'b>(
        &self,
        branch: &Branch,
        points: [&'b BranchPoint; 2],
        low_w: f64,
    ) -> Option<StableSegment<'b>> {
        let end = |x: f64, point: &BranchPoint| SegmentEnd {
            x,
            power_w: point.orbit.mean_power_w,
            power_error: 2.0 * point.orbit.error_estimate,
            edge: IntervalEdge {
                parameter: point.parameter,
                parameter_error: if [self.range.0, self.range.1].contains(&point.parameter) {
                    0.0
                } else {
                    (points[1].parameter - points[0].parameter).abs()
                },
                at: BandLimit::End,
            },
        };
        let mut segment = StableSegment {
            cycles: branch.period_cycles,
            points,
            ends: [end(0.0, points[0]), end(1.0, points[1])],
        };
        match points.map(|point| point.orbit.is_stable()) {
            [true, true] => {}
            [false, false] => return None,
            _ if points.iter().all(|point| point.orbit.mean_power_w < low_w) => return None,
            [first, _] => {
                let edge = self.stability_edge(
                    &segment,
                    if first {
                        -NEIGHBOUR_DISTANCE
                    } else {
                        NEIGHBOUR_DISTANCE
                    },
                );
                let stable = usize::from(!first);
                let segment_end = edge
                    .or_else(|| self.located(&segment, branch, stable))
                    .unwrap_or_else(|| segment.unresolved_end(stable));
                segment.ends[usize::from(first)] = segment_end;
                segment.turn_back(stable, segment_end.edge);
            }
        }
        Some(segment)
    }

    /// Returns the largest power on some segments, at an end or inside, with its relative error.
    fn peak(&self, segments: &[StableSegment]) -> Option<(PowerPeak, f64)> {
        let ends = || segments.iter().flat_map(|segment| segment.ends);
        let highest = ends().max_by(|a, b| a.power_w.total_cmp(&b.power_w))?;
        let worth = |segment: &&StableSegment| {
            segment
                .highest_end_power(segments)
                .is_some_and(|power_w| power_w >= MIN_PEAK_SHARE * highest.power_w)
        };
        let maxima: Vec<SegmentEnd> = segments
            .iter()
            .filter(worth)
            .filter_map(|segment| self.maximum(segment))
            .collect();
        let best = maxima
            .into_iter()
            .filter(|node| node.power_w >= highest.power_w)
            .fold(highest, |a, b| if b.power_w >= a.power_w { b } else { a });
        let IntervalEdge {
            parameter,
            parameter_error,
            at,
        } = best.edge;
        Some((
            PowerPeak {
                parameter,
                parameter_error,
                mean_power_w: best.power_w,
                at,
            },
            best.power_error,
        ))
    }

    /// Returns the maximum inside a segment, if power rises inwards from both ends.
    fn maximum(&self, segment: &StableSegment) -> Option<SegmentEnd> {
        let piece = self.piece(segment)?;
        let [from, to] = segment.ends.map(|end| end.x);
        let noise_w = self.tolerance / NEIGHBOUR_DISTANCE * segment.ends[0].power_w;
        let top = piece.maximum((from, to), noise_w)?;
        let neighbour = |step: f64| piece.power_slope_w(top.point.x + step);
        let second = (neighbour(NEIGHBOUR_DISTANCE)? - neighbour(-NEIGHBOUR_DISTANCE)?)
            / (2.0 * NEIGHBOUR_DISTANCE);
        let power_w = top.point.mean_power_w();
        let power_error = 2.0 * piece.orbit(&top.point)?.error_estimate;
        let x_error = (top.value.abs() + power_error * power_w / NEIGHBOUR_DISTANCE) / second.abs();
        let parameter_error = piece.parameter_error(&top.point, x_error)?;
        let edge = IntervalEdge {
            parameter: top.point.parameter(),
            parameter_error,
            at: BandLimit::Maximum,
        };
        Some(SegmentEnd {
            x: top.point.x,
            power_w,
            power_error,
            edge,
        })
    }

    /// Returns the intervals where stable orbits have at least half of a peak with the given
    /// relative error.
    fn above_half(&self, (peak, error): (PowerPeak, f64), segments: &[StableSegment]) -> Bandwidth {
        let half_w = 0.5 * peak.mean_power_w;
        merged(
            peak,
            segments
                .iter()
                .filter_map(|segment| self.above(segment, half_w, error))
                .collect(),
        )
    }

    /// Returns the interval of a segment above a power.
    fn above(&self, segment: &StableSegment, half_w: f64, error: f64) -> Option<BandInterval> {
        let mut edges = segment.ends.map(|end| end.edge);
        match segment.ends.map(|end| end.power_w >= half_w) {
            [true, true] => {}
            [false, false] => return None,
            [first, _] => {
                edges[usize::from(first)] = self
                    .half_power(segment, half_w, error)
                    .unwrap_or_else(|| segment.between(half_w))
            }
        }
        let [a, b] = edges;
        Some(if a.parameter <= b.parameter {
            BandInterval { from: a, to: b }
        } else {
            BandInterval { from: b, to: a }
        })
    }

    /// Returns the point of a segment at half the peak power.
    fn half_power(&self, segment: &StableSegment, half_w: f64, error: f64) -> Option<IntervalEdge> {
        let piece = self.piece(segment)?;
        let [from, to] = segment.ends.map(|end| end.x);
        let zero = piece.zero((from, to), 0.1 * self.tolerance * half_w, |point| {
            Some(point.mean_power_w() - half_w)
        })?;
        let residual_w =
            zero.value.abs() + (2.0 * piece.orbit(&zero.point)?.error_estimate + error) * half_w;
        let x_error = residual_w / piece.power_slope_w(zero.point.x)?.abs();
        // The power passes half between the two points, however flat it is.
        let parameter_error = piece
            .parameter_error(&zero.point, x_error)?
            .min(segment.largest_distance(zero.point.parameter()));
        Some(IntervalEdge {
            parameter: zero.point.parameter(),
            parameter_error,
            at: BandLimit::HalfPower,
        })
    }
}
