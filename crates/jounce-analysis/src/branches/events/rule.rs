//! Rule by which a step of a curve is accepted.

use super::coupling::{Couplings, Meeting, coupling_error};
use super::interpolant::Interpolant;
use super::linking::linked_pairs;
use super::not_proved::{NotProved, ProofGap};
use super::spectrum::{
    MultiplierGroup, StepEnd, TestFunction, between, changes_sign, doubling, fold, groups,
    is_enclosed, is_torus_crossing, torus,
};
use super::turning_points::{Extremum, extrema, may_touch_unseen};
use crate::branches::branch::BranchKind;
use crate::branches::branch_tracer::halves::meets_halves;
use crate::branches::branch_tracer::orbit_point::OrbitPoint;
use crate::branches::branch_tracer::tracer::BranchTracer;
use jounce_continuation::{CurvePoint, HermiteSegment, Metric, correct, tangent};
use jounce_orbits::OrbitMethod;
use std::cell::OnceCell;

/// Largest number of halvings of one step; an interval not proved at a thousandth of it is listed.
const MAX_STEP_HALVINGS: u32 = 10;

/// Largest number of points added on one step: five for each halving, which limits the cost where
/// every proof fails.
const MAX_STEP_POINTS: u32 = 50;

impl BranchTracer {
    /// Returns the points that prove the events of a step, and its last point; intervals that are
    /// not proved are added to the list.
    ///
    /// # Errors
    /// As [`BranchTracer::walk`].
    pub(in crate::branches) fn resolved<M: OrbitMethod>(
        &self,
        method: &M,
        before: &OrbitPoint<M>,
        after: OrbitPoint<M>,
        not_proved: &mut Vec<NotProved>,
    ) -> Result<Vec<OrbitPoint<M>>, M::Error> {
        self.halved(
            method,
            (before, after),
            MAX_STEP_HALVINGS,
            &mut { MAX_STEP_POINTS },
            not_proved,
        )
    }

    fn halved<M: OrbitMethod>(
        &self,
        method: &M,
        (before, after): (&OrbitPoint<M>, OrbitPoint<M>),
        halvings: u32,
        points: &mut u32,
        not_proved: &mut Vec<NotProved>,
    ) -> Result<Vec<OrbitPoint<M>>, M::Error> {
        let unproved = self.doubts(method, before, &after);
        if unproved.is_empty() {
            return Ok(vec![after]);
        }
        let may_halve = halvings > 0 && *points > 0;
        let middle = if may_halve {
            self.half_way(method, &before.step, &after.step)
        } else {
            None
        };
        let Some(middle) = middle else {
            let why = if may_halve {
                ProofGap::NoMidpoint
            } else {
                ProofGap::SmallestSteps
            };
            unproved.into_iter().for_each(|event| {
                NotProved::add(
                    not_proved,
                    event,
                    [before, &after].map(|at| at.point.parameter),
                    why,
                )
            });
            return Ok(vec![after]);
        };
        *points -= 1;
        let middle = OrbitPoint::new(method, middle)?;
        let mut orbit_points =
            self.halved(method, (before, middle), halvings - 1, points, not_proved)?;
        if let Some(last) = orbit_points.pop() {
            let rest = self.halved(method, (&last, after), halvings - 1, points, not_proved)?;
            orbit_points.push(last);
            orbit_points.extend(rest);
        }
        Ok(orbit_points)
    }

    /// Returns the point of the curve half-way between two.
    fn half_way<M: OrbitMethod>(
        &self,
        method: &M,
        before: &CurvePoint<M::Evaluation>,
        after: &CurvePoint<M::Evaluation>,
    ) -> Option<CurvePoint<M::Evaluation>> {
        let metric = Metric::at(&before.position, self.parameter_scale());
        let segment = HermiteSegment::between(
            &metric,
            (&before.position, &before.tangent),
            (&after.position, &after.tangent),
        );
        let direction = metric.unit(before.position.to(&after.position));
        let corrected = correct(
            method,
            &self.corrector,
            &metric,
            &direction,
            segment.at(0.5 * segment.length),
        )
        .ok()?;
        let direction = tangent(&corrected.local, &metric, &direction)?;
        Some(CurvePoint {
            position: corrected.position,
            tangent: direction,
            local: corrected.local,
            error: corrected.error,
        })
    }

    /// Returns the kinds of events that may occur more than once on a step.
    fn doubts<M: OrbitMethod>(
        &self,
        method: &M,
        before: &OrbitPoint<M>,
        after: &OrbitPoint<M>,
    ) -> Vec<BranchKind> {
        let mut unproved = Vec::new();
        let meets = meets_halves(&before.point.orbit, &after.point.orbit);
        if !meets
            && self
                .turns(&before.step, &after.step)
                .crossings()
                .is_none_or(|count| count > 1)
        {
            unproved.push(BranchKind::Fold);
        }
        let Some(ends) = self.ends(method, before, after) else {
            unproved.extend([
                BranchKind::PeriodDoubling,
                BranchKind::NeimarkSacker,
                BranchKind::Grazing,
            ]);
            return unproved;
        };
        let [one, two] = ends.map(|end| end.readings);
        // Without contacts and switches the multipliers are those of the plant, all inside the unit
        // circle.
        if !(one.current.is_free && two.current.is_free) {
            let couplings = OnceCell::new();
            let couplings = || {
                let make = || Self::couplings(method, before, after);
                couplings.get_or_init(make).as_ref()
            };
            unproved.extend(
                doubtful_multipliers(ends, couplings)
                    .into_iter()
                    .filter(|kind| !(meets && *kind == BranchKind::BranchPoint)),
            );
        }
        let is_open = |turn: &Extremum| turn.past_m.crossings().is_none_or(|count| count > 1);
        if may_touch_unseen(ends) || extrema(ends).iter().any(is_open) {
            unproved.push(BranchKind::Grazing);
        }
        let level = |k: usize| Interpolant {
            values: [one, two].map(|at| at.current.levels[k]),
            slopes: ends.map(|end| end.level(k)),
        };
        if (0..self.levels.len()).any(|k| level(k).crossings().is_none_or(|count| count > 1)) {
            unproved.push(BranchKind::Level);
        }
        unproved
    }

    /// Returns the ends of a step with the data of their test functions; `None` where these cannot
    /// be computed.
    pub(in crate::branches) fn ends<'p, M: OrbitMethod>(
        &self,
        method: &M,
        before: &'p OrbitPoint<M>,
        after: &'p OrbitPoint<M>,
    ) -> Option<[StepEnd<'p>; 2]> {
        let end = |at: &'p OrbitPoint<M>| {
            let metric = Metric::at(&at.step.position, self.parameter_scale());
            Some(StepEnd {
                readings: at.readings(method, self)?,
                length: metric.length(&before.step.position.to(&after.step.position)),
            })
        };
        Some([end(before)?, end(after)?])
    }

    /// Returns the couplings of the multipliers at each end of a step, computed from the map at the
    /// other end.
    fn couplings<M: OrbitMethod>(
        method: &M,
        before: &OrbitPoint<M>,
        after: &OrbitPoint<M>,
    ) -> Option<[Couplings; 2]> {
        let [one, two] = [before, after].map(|point| method.shot(&point.step.local).ok());
        let (one, two) = (one?, two?);
        Some([
            Couplings::of(&before.point.orbit.multipliers, one, two),
            Couplings::of(&after.point.orbit.multipliers, two, one),
        ])
    }

    /// Returns the parameter's component of the tangent, by the cubic of the parameter.
    fn turns<L>(&self, before: &CurvePoint<L>, after: &CurvePoint<L>) -> Interpolant {
        let metric = Metric::at(&before.position, self.parameter_scale());
        let chord = before.position.to(&after.position);
        let length = metric.length(&chord);
        let rate = |step: &CurvePoint<L>| metric.unit(step.tangent.clone()).parameter * length;
        let [first, last] = [rate(before), rate(after)];
        // Bernstein coefficients of its derivative: first, middle, last.
        let middle = 3.0 * chord.parameter - first - last;
        Interpolant {
            values: [first, last],
            slopes: [2.0 * (middle - first), 2.0 * (last - middle)],
        }
    }
}

/// Returns the kinds for which multipliers may pass the critical value more than once. There are two
/// proofs that they do not: the function of each pair with the error of its couplings, and the
/// function of coupled pairs together. Either is enough.
fn doubtful_multipliers<'c>(
    ends: [StepEnd; 2],
    couplings: impl Fn() -> Option<&'c [Couplings; 2]>,
) -> Vec<BranchKind> {
    let pairs = linked_pairs(ends);
    let meetings: Vec<Meeting> = (0..pairs.len())
        .flat_map(|k| (0..k).map(move |other| (k, other)))
        .filter_map(|(k, other)| Meeting::of(ends, &couplings, pairs[k], pairs[other]))
        .collect();
    let is_tied = |one, two| meetings.iter().any(|meeting| meeting.is_of(one, two));
    let separate = doubtful_groups(ends, groups(ends, &pairs, |_, _| false), &meetings);
    if separate.is_empty() || meetings.is_empty() {
        return separate;
    }
    let together = doubtful_groups(ends, groups(ends, &pairs, is_tied), &[]);
    separate
        .into_iter()
        .filter(|kind| together.contains(kind))
        .collect()
}

/// Returns the kinds for which groups of multipliers may pass the critical value more than once;
/// `meetings` are the meetings of multipliers of different groups.
fn doubtful_groups(
    ends: [StepEnd; 2],
    mut groups: Vec<MultiplierGroup>,
    meetings: &[Meeting],
) -> Vec<BranchKind> {
    groups.retain(|group| !is_enclosed(ends, group));
    let kinds: [(BranchKind, TestFunction); 3] = [
        (BranchKind::PeriodDoubling, doubling),
        (BranchKind::BranchPoint, fold),
        (BranchKind::NeimarkSacker, torus),
    ];
    if groups.iter().any(|group| changes_sign(ends, group)) {
        return kinds.iter().map(|(kind, _)| *kind).collect();
    }
    let counts = kinds.map(|(kind, f)| crossings(ends, &groups, (kind, f), meetings));
    // The number of multipliers outside the unit circle separates a Neimark-Sacker point from other
    // events only if it is the single event of the step.
    let is_mixed = |kind: BranchKind| {
        kind == BranchKind::NeimarkSacker
            && counts[2] == Some(1)
            && counts[..2].iter().any(|count| *count != Some(0))
    };
    kinds
        .iter()
        .zip(&counts)
        .filter(|((kind, _), count)| count.is_none_or(|count| count > 1) || is_mixed(*kind))
        .map(|((kind, _), _)| *kind)
        .collect()
}

/// Returns how often the multipliers of all groups pass the critical value of a kind on the step;
/// `None` where it is not proved.
fn crossings(
    ends: [StepEnd; 2],
    groups: &[MultiplierGroup],
    (kind, f): (BranchKind, TestFunction),
    meetings: &[Meeting],
) -> Option<usize> {
    groups
        .iter()
        .map(|group| {
            let extra_error = coupling_error(ends, group, f, meetings);
            let readings = between(ends, group, f).crossings_with(extra_error)?;
            let is_event = kind != BranchKind::NeimarkSacker
                || readings == 0
                || is_torus_crossing(ends, group)?;
            Some(if is_event { readings } else { 0 })
        })
        .sum()
}
