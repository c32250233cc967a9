//! Continuation through the cusp of a curve of folds, where two folds of one branch meet.
//!
//! ```text
//! x^3 + b x + a = 0,   3 x^2 + b = 0:   b = -3 x^2,   a = 2 x^3
//! ```
//!
//! As a function of the state `x` along the critical eigenvector the curve is smooth. At the cusp
//! its tangent is that direction alone, and the keys turn back. Where the plane is narrow, they
//! turn over so small a change of state that every step along the tangent fails. From a point near
//! the cusp the curve is therefore searched by `x`: first past the turn, then where the keys are
//! stationary.
//!
//! Source: V. I. Arnold, Catastrophe Theory (Springer, 1992), ch. 2.

use super::key_plane::KeyPlane;
use jounce_continuation::{
    Bracket, CorrectedPoint, Corrector, Direction, Metric, Position, correct, tangent,
};
use jounce_linalg::Mat;
use jounce_orbits::{Condition, ExtendedEvaluation, ExtendedProblem, null_vector};

/// Distances along the eigenvector of the search past the turn, as lengths in the metric.
const SEARCH_DISTANCES: [f64; 7] = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];

/// Largest distance of a point past the turn.
const MAX_RESTART_DISTANCE: f64 = 0.2;

/// Smallest speed of the keys over `x` past the turn: the tangent is along the keys again.
const MIN_KEY_SPEED: f64 = 1.0;

/// Speed of the keys below which they are stationary.
const MAX_CUSP_KEY_SPEED: f64 = 0.1;

/// Largest deviation of the keys from their parabola at a cusp, relative to the distance given by
/// their last speed.
const MAX_PARABOLA_DISTANCE: f64 = 0.1;

/// Largest number of iterations of the search for the cusp.
const MAX_TRIALS: u32 = 12;

/// Smallest distance from an end of the bracket, relative to the bracket.
const MIN_END_DISTANCE: f64 = 1e-3;

/// Restart point of a continuation whose step failed.
#[derive(Debug)]
pub struct RestartPoint {
    /// Corrected point.
    pub found: CorrectedPoint<ExtendedEvaluation>,
    /// Tangent in the direction of the continuation.
    pub tangent: Direction,
    /// Length of the first step from there.
    pub step: f64,
}

/// Returns the cusp ahead of a position on the curve, or a point beyond a cusp just behind; `None`
/// where there is no cusp within the limit.
pub fn restart_beyond(
    tracking: &ExtendedProblem<KeyPlane>,
    corrector: &Corrector,
    scale_2: f64,
    (position, local, direction): (&Position, &ExtendedEvaluation, &Direction),
) -> Option<RestartPoint> {
    if tracking.condition != Condition::Multiplier(1.0) {
        return None;
    }
    let metric = Metric::at(position, scale_2);
    let search = EigenvectorSearch {
        across: eigenvector(&metric, local, direction),
        tracking,
        corrector,
        position,
        metric,
    };
    let before = search.key_speeds(direction);
    let (beyond, (corrected, tangent)) = SEARCH_DISTANCES.into_iter().find_map(|step| {
        let point = search
            .corrected_at(step)
            .filter(|point| search.is_past(before, step, point))?;
        Some((step, point))
    })?;
    // Speed in the direction of the keys before the turn.
    let forward_speed =
        |speeds: [f64; 2]| (speeds[0] * before[0] + speeds[1] * before[1]) / length(before);
    let after = forward_speed(search.key_speeds(&tangent));
    if length(before) < MAX_CUSP_KEY_SPEED || after > 0.0 {
        return Some(RestartPoint {
            found: corrected,
            tangent,
            step: beyond,
        });
    }
    let mut turn = Bracket::between((0.0, length(before)), (beyond, after));
    for _ in 0..MAX_TRIALS {
        let step = turn.next(MIN_END_DISTANCE * beyond);
        let (corrected, tangent) = search.corrected_at(step)?;
        let key_speeds = search.key_speeds(&tangent);
        if length(key_speeds) < MAX_CUSP_KEY_SPEED {
            return Some(RestartPoint {
                found: corrected,
                tangent,
                step: beyond - step,
            });
        }
        turn.put(step, forward_speed(key_speeds));
    }
    Some(RestartPoint {
        found: corrected,
        tangent,
        step: beyond,
    })
}

/// Search along the critical eigenvector from a position on the curve.
struct EigenvectorSearch<'a> {
    tracking: &'a ExtendedProblem<'a, KeyPlane<'a>>,
    corrector: &'a Corrector,
    position: &'a Position,
    metric: Metric,
    /// Unit direction of the state along the eigenvector.
    across: Direction,
}

impl EigenvectorSearch<'_> {
    /// Returns the change of both keys in a direction, in the metric.
    fn keys(&self, direction: &Direction) -> [f64; 2] {
        [
            direction.unknown[self.tracking.parameter_index()] / self.metric.unknown,
            direction.parameter / self.metric.parameter,
        ]
    }

    /// Returns the speeds of both keys over the distance along the eigenvector.
    fn key_speeds(&self, tangent: &Direction) -> [f64; 2] {
        self.keys(tangent)
            .map(|key| key / self.metric.inner(tangent, &self.across))
    }

    /// Returns the point at a distance along the eigenvector, with its tangent.
    fn corrected_at(&self, step: f64) -> Option<(CorrectedPoint<ExtendedEvaluation>, Direction)> {
        let corrected = correct(
            self.tracking,
            self.corrector,
            &self.metric,
            &self.across,
            self.position.offset_along(&self.across, step),
        )
        .ok()?;
        let tangent = tangent(&corrected.local, &self.metric, &self.across)?;
        Some((corrected, tangent))
    }

    /// True for a point past the turn; `before` are the speeds of the keys at the start.
    fn is_past(
        &self,
        before: [f64; 2],
        step: f64,
        (corrected, tangent): &(CorrectedPoint<ExtendedEvaluation>, Direction),
    ) -> bool {
        let displacement = self.position.to(&corrected.position);
        let (key_change, after) = (self.keys(&displacement), self.key_speeds(tangent));
        let residual = [0, 1].map(|k| key_change[k] - 0.5 * step * (before[k] + after[k]));
        let is_fast = length(after) > length(before).max(MIN_KEY_SPEED);
        is_fast
            && self.metric.length(&displacement) < MAX_RESTART_DISTANCE
            && length(residual) < MAX_PARABOLA_DISTANCE * step * length(after)
    }
}

fn length([first, second]: [f64; 2]) -> f64 {
    first.hypot(second)
}

/// Returns the unit direction of the state alone along the critical eigenvector, in the direction
/// of the curve.
fn eigenvector(metric: &Metric, local: &ExtendedEvaluation, direction: &Direction) -> Direction {
    let map = local.shot.map();
    let mut unknown = null_vector(&Mat::from_fn(map.nrows(), map.ncols(), |i, j| {
        map[(i, j)] - f64::from(u8::from(i == j))
    }));
    unknown.resize(direction.unknown.len(), 0.0);
    let mut vector = metric.unit(Direction {
        unknown,
        parameter: 0.0,
    });
    if metric.inner(&vector, direction) < 0.0 {
        vector.unknown.iter_mut().for_each(|d| *d = -*d);
    }
    vector
}
