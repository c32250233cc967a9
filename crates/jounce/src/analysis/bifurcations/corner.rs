//! Round the corner that a curve has where a contact appears or goes.
//!
//! ```text
//! R = 0,   g = 0,   grad h . (x - x0) = e,   h the distance of the nearest turning point past the surface
//! ```
//!
//! The derivative of the flow is continuous there, but its own derivative is not, and with it the tangent of a curve on which a multiplier is
//! critical, or the slope of power zero. Steps along the old tangent lead nowhere, however short. On the other side of the grazing the
//! curve goes on at another angle, which may be sharp: it is sought at a given distance past the grazing, not along any direction.

use super::key_plane::KeyPlane;
use crate::continuation::{
    CorrectedPoint, Corrector, Direction, Metric, Position, correct, tangent,
};
use crate::orbit::{Condition, ExtendedEvaluation, ExtendedProblem};

/// Distances past the grazing at which the curve is sought, as lengths along the old tangent in the metric. The differences that give the new
/// tangent must not see the old side, which along a curve that crosses the grazing at a small angle is long near.
const SEARCH_DISTANCES: [f64; 4] = [1e-2, 3e-2, 3e-3, 1e-3];

/// Way along the old tangent up to which a grazing counts as the reason why no step is short enough.
const MAX_GRAZING_DISTANCE: f64 = 0.03;

/// Farthest that the place beyond may lie.
const MAX_RESTART_DISTANCE: f64 = 0.2;

/// A place of the curve beyond the grazing that lies ahead of another one, with the tangent there; `None` where there is no grazing so near.
pub fn round(
    tracking: &ExtendedProblem<KeyPlane>,
    corrector: &Corrector,
    scale_2: f64,
    (position, ahead): (&Position, &Direction),
) -> Option<(CorrectedPoint<ExtendedEvaluation>, Direction)> {
    if matches!(tracking.condition, Condition::Touching(_)) {
        return None;
    }
    let metric = Metric::at(position, scale_2);
    let ahead = metric.unit(ahead.clone());
    let past = tracking
        .past(&position.unknown, position.parameter)
        .ok()??;
    let own = tracking.place_of_parameter();
    let along = |direction: &Direction| {
        let by_state: f64 = past
            .by_unknown
            .iter()
            .zip(&direction.unknown)
            .map(|(a, b)| a * b)
            .sum();
        by_state
            + past.by_parameters[0] * tracking.unit * direction.unknown[own]
            + past.by_parameters[1] * direction.parameter
    };
    let (way, sense) = (-past.value / along(&ahead), along(&ahead).signum());
    if way.is_nan() || way.abs() > MAX_GRAZING_DISTANCE {
        return None;
    }
    // Just behind a grazing it is no way at all.
    let to_grazing = way.max(0.0);
    let mut by_unknown = past.by_unknown.clone();
    by_unknown.push(tracking.unit * past.by_parameters[0]);
    by_unknown.resize(position.unknown.len(), 0.0);
    // Its row in the metric is the gradient.
    let across = Direction {
        unknown: by_unknown
            .iter()
            .map(|by| sense * by * metric.unknown * metric.unknown)
            .collect(),
        parameter: sense * past.by_parameters[1] * metric.parameter * metric.parameter,
    };
    SEARCH_DISTANCES.into_iter().find_map(|beyond| {
        let guess = position.moved(&ahead, to_grazing + beyond);
        let found = correct(tracking, corrector, &metric, &across, guess).ok()?;
        let tangent = tangent(&found.local, &metric, &across)?;
        let way = position.to(&found.position);
        (metric.length(&way) < MAX_RESTART_DISTANCE && along(&way) * sense > 0.0)
            .then_some((found, tangent))
    })
}
