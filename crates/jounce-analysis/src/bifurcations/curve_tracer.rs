//! Continuation of one curve in the plane of two keys.

use super::corner;
use super::curve::{BifurcationCurve, BifurcationCurvePoint};
use super::cusp::{self, RestartPoint};
use super::key_plane::KeyPlane;
use super::search::BifurcationSearch;
use jounce_continuation::{
    Continuation, CorrectedPoint, Corrector, Direction, Metric, Position, StepControl, correct,
    correct_at, lies_between,
};
use jounce_orbits::{Condition, ExtendedEvaluation, ExtendedProblem, multipliers};

/// Distance, in the metric, from a strong resonance at which a curve of tori ends. Shorter steps
/// approach it.
const RESONANCE_DISTANCE: f64 = 1e-3;

/// Smallest step, in goals of Newton's method; shorter steps fail.
const MIN_STEP_GOALS: f64 = 10.0;

/// Fraction of a step, within which its start counts as on an edge.
const EDGE_SHARE: f64 = 1e-9;

/// Fraction of a branch at which it counts as a point: an isolated branch, and its peak, begins
/// there.
const POINT_BRANCH_SHARE: f64 = 2e-4;

/// Fraction of a branch at which it counts as a point where the peak cannot be followed further.
const NEAR_POINT_BRANCH_SHARE: f64 = 1e-3;

/// Largest number of points of one curve.
const MAX_CURVE_POINTS: usize = 400;

/// Edge of the plane that a step crosses.
#[derive(Debug, Clone, Copy)]
struct PlaneEdge {
    /// True for an edge of the first key.
    is_first: bool,
    value: f64,
    /// Fraction of the step up to the edge.
    share: f64,
}

/// Direction in which a curve passes its origin again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CurveClosure {
    /// In the initial direction.
    Onwards,
    /// In the opposite direction: the curve turned back over its own points.
    Backwards,
}

impl BifurcationSearch<'_> {
    /// Continues a curve from its first point in a direction until it ends; `curve` has no points
    /// yet.
    pub(super) fn trace(
        &self,
        tracking: &ExtendedProblem<KeyPlane>,
        corrector: Corrector,
        (first, direction): (CorrectedPoint<ExtendedEvaluation>, Direction),
        mut curve: BifurcationCurve,
    ) -> BifurcationCurve {
        let first_point = point(tracking, &first.position, &first.local);
        curve.points.push(first_point);
        let (origin, outset) = (first.position.clone(), direction.clone());
        let mut walk = self.continuation_from(tracking, corrector, first.position, direction);
        let (mut current, mut came_back) = (first.local, false);
        loop {
            let (mark, before) = (walk.mark(), walk.position.clone());
            let (position, local) = match self.advance(tracking, corrector, &mut walk, &current) {
                Some(Ok(found)) => found,
                Some(Err(reason)) => {
                    curve.failures.push(reason);
                    break;
                }
                None => break,
            };
            if maximum_merges(&local, &mut curve, position.parameter) {
                break;
            }
            let metric = Metric::at(&position, self.scale_2());
            if local.is_resonant {
                if metric.length(&before.to(&position)) > RESONANCE_DISTANCE && walk.retreat(mark) {
                    continue;
                }
                break;
            }
            if let Some(edge) = self.edge_between(tracking, &before, &position) {
                if !self.end_on(tracking, corrector, (&before, &position), edge, &mut curve) {
                    if walk.retreat(mark) {
                        continue;
                    }
                    curve.failures.push(format!(
                        "no point was found on the edge of the range, near {}",
                        before.parameter
                    ));
                }
                break;
            }
            curve.points.push(point(tracking, &position, &local));
            let ends = (&before, &position);
            let closure = closure_of(tracking.condition, &metric, (&origin, &outset), ends)
                .filter(|_| curve.points.len() > 4);
            came_back = closure == Some(CurveClosure::Backwards);
            if closure.is_some()
                || is_born(&local, POINT_BRANCH_SHARE)
                || exceeds_point_limit(&mut curve, position.parameter)
            {
                break;
            }
            current = local;
        }
        curve.truncate_at_turn(came_back, self.ranges.map(|(low, high)| high - low));
        curve
    }

    fn continuation_from<'t, 'p>(
        &self,
        tracking: &'t ExtendedProblem<'p, KeyPlane<'p>>,
        corrector: Corrector,
        position: Position,
        direction: Direction,
    ) -> Continuation<'t, ExtendedProblem<'p, KeyPlane<'p>>> {
        let control = StepControl {
            shortest: MIN_STEP_GOALS * corrector.goal,
            ..StepControl::default()
        };
        Continuation::new(
            tracking,
            corrector,
            control,
            self.scale_2(),
            position,
            direction,
        )
    }

    /// Returns the next point after `current`: one step further, or a restart beyond a corner or a
    /// cusp; `None` where the curve ends.
    fn advance<'t, 'p>(
        &self,
        tracking: &'t ExtendedProblem<'p, KeyPlane<'p>>,
        corrector: Corrector,
        walk: &mut Continuation<'t, ExtendedProblem<'p, KeyPlane<'p>>>,
        current: &ExtendedEvaluation,
    ) -> Option<Result<(Position, ExtendedEvaluation), String>> {
        let before = walk.position.clone();
        match walk.next()? {
            Ok(step) => Some(Ok((step.position, step.local))),
            Err(_) if is_born(current, NEAR_POINT_BRANCH_SHARE) => None,
            Err(error) => {
                let Some(RestartPoint {
                    found,
                    tangent: direction,
                    step,
                }) = self.beyond(tracking, &corrector, (&before, current, &walk.tangent))
                else {
                    return Some(Err(error.to_string()));
                };
                *walk =
                    self.continuation_from(tracking, corrector, found.position.clone(), direction);
                walk.length = step;
                Some(Ok((found.position, found.local)))
            }
        }
    }

    /// Returns the restart point after a failed step: beyond a corner or through a cusp.
    fn beyond(
        &self,
        tracking: &ExtendedProblem<KeyPlane>,
        corrector: &Corrector,
        (position, local, direction): (&Position, &ExtendedEvaluation, &Direction),
    ) -> Option<RestartPoint> {
        let corner =
            corner::beyond_grazing(tracking, corrector, self.scale_2(), (position, direction));
        let restart = corner.map(|(found, direction)| RestartPoint {
            found,
            tangent: direction,
            step: StepControl::default().first,
        });
        restart.or_else(|| {
            cusp::restart_beyond(
                tracking,
                corrector,
                self.scale_2(),
                (position, local, direction),
            )
        })
    }

    /// Ends a curve with the point on an edge, unless its last point counts as on it; false where
    /// the point is not found, which a start nearer to the edge may remedy.
    fn end_on(
        &self,
        tracking: &ExtendedProblem<KeyPlane>,
        corrector: Corrector,
        ends: (&Position, &Position),
        edge: PlaneEdge,
        curve: &mut BifurcationCurve,
    ) -> bool {
        if edge.share < EDGE_SHARE {
            return true;
        }
        let Some(edge_point) = self.correct_on_edge(tracking, corrector, ends, edge) else {
            return false;
        };
        let mut edge_point = point(tracking, &edge_point.position, &edge_point.local);
        *(if edge.is_first {
            &mut edge_point.parameter
        } else {
            &mut edge_point.parameter_2
        }) = edge.value;
        curve.points.push(edge_point);
        true
    }

    /// Returns the edge of the plane that is crossed first between two positions.
    fn edge_between(
        &self,
        tracking: &ExtendedProblem<KeyPlane>,
        before: &Position,
        after: &Position,
    ) -> Option<PlaneEdge> {
        let keys =
            |position: &Position| [tracking.parameter(&position.unknown), position.parameter];
        let (from, to) = (keys(before), keys(after));
        let crossed_edge = |k: usize| {
            let (low, high) = self.ranges[k];
            let value = if to[k] < low { low } else { high };
            let share = ((value - from[k]) / (to[k] - from[k])).clamp(0.0, 1.0);
            (to[k] < low || to[k] > high).then_some(PlaneEdge {
                is_first: k == 0,
                value,
                share,
            })
        };
        [crossed_edge(0), crossed_edge(1)]
            .into_iter()
            .flatten()
            .min_by(|a, b| a.share.total_cmp(&b.share))
    }

    /// Returns the point exactly on an edge.
    fn correct_on_edge(
        &self,
        tracking: &ExtendedProblem<KeyPlane>,
        corrector: Corrector,
        (before, outside): (&Position, &Position),
        edge: PlaneEdge,
    ) -> Option<CorrectedPoint<ExtendedEvaluation>> {
        let mut guess = before.offset_along(&before.to(outside), edge.share);
        if !edge.is_first {
            guess.parameter = edge.value;
            return correct_at(
                tracking,
                &corrector,
                &Metric::at(&guess, self.scale_2()),
                guess,
            )
            .ok();
        }
        let n = guess.unknown.len();
        let parameter_index = tracking.parameter_index();
        guess.unknown[parameter_index] = (edge.value - tracking.origin) / tracking.unit;
        let metric = Metric::at(&guess, self.scale_2());
        // Correction across the first key only, which remains fixed.
        let mut across = Direction {
            unknown: vec![0.0; n],
            parameter: 0.0,
        };
        across.unknown[parameter_index] = metric.unknown;
        correct(tracking, &corrector, &metric, &across, guess).ok()
    }
}

/// Returns how a curve passes its origin again, if it does. A curve of folds that passes it in the
/// opposite direction is on the other side of a cusp.
fn closure_of(
    condition: Condition,
    metric: &Metric,
    (origin, outset): (&Position, &Direction),
    (before, after): (&Position, &Position),
) -> Option<CurveClosure> {
    let sense = if metric.inner(outset, &before.to(after)) < 0.0 {
        CurveClosure::Backwards
    } else {
        CurveClosure::Onwards
    };
    let is_other_arm = sense == CurveClosure::Backwards && condition == Condition::Multiplier(1.0);
    (lies_between(metric, origin, before, after) && !is_other_arm).then_some(sense)
}

/// True where the maximum of power merges with a minimum; adds the message.
fn maximum_merges(
    local: &ExtendedEvaluation,
    curve: &mut BifurcationCurve,
    parameter_2: f64,
) -> bool {
    let merges = local.power_curvature.is_some_and(|bend| bend >= 0.0);
    if merges {
        curve.failures.push(format!(
            "at {parameter_2} the maximum of power merges with a minimum"
        ));
    }
    merges
}

/// True for a curve that has reached the limit of points; adds the message.
fn exceeds_point_limit(curve: &mut BifurcationCurve, parameter_2: f64) -> bool {
    let is_long = curve.points.len() >= MAX_CURVE_POINTS;
    if is_long {
        curve.failures.push(format!(
            "after the limit of {MAX_CURVE_POINTS} points, at {parameter_2}"
        ));
    }
    is_long
}

/// True for a peak where its branch begins, within a fraction.
fn is_born(local: &ExtendedEvaluation, share: f64) -> bool {
    local.power_curvature.is_some()
        && local
            .share_of_branch()
            .is_some_and(|own_share| own_share < share)
}

/// Converts a position on a curve into a result.
fn point(
    tracking: &ExtendedProblem<KeyPlane>,
    position: &Position,
    local: &ExtendedEvaluation,
) -> BifurcationCurvePoint {
    BifurcationCurvePoint {
        parameter: tracking.parameter(&position.unknown),
        parameter_2: position.parameter,
        mean_power_w: local
            .shot
            .loads_w
            .iter()
            .fold(0.0, |sum, load_w| sum + load_w),
        stable: local
            .power_curvature
            .and_then(|_| Some(multipliers(&local.shot.block_map)?.first()?.norm() < 1.0)),
    }
}
