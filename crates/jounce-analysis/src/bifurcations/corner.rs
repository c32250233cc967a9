//! Restart beyond the corner of a curve where a contact appears or disappears.
//!
//! ```text
//! R = 0,   g = 0,   grad h . (x - x0) = e,   h the distance of the nearest turning point past the surface
//! ```
//!
//! At grazing the derivative of the flow is continuous, but its own derivative is not. So the
//! tangent has a jump on a curve of critical multipliers or of zero slope of power. Steps along the
//! old tangent then fail for any length. Beyond the grazing the curve continues at another angle,
//! possibly sharp. It is therefore searched at a given distance past the grazing, in any direction.

use super::key_plane::KeyPlane;
use jounce_continuation::{
    CorrectedPoint, Corrector, Direction, Metric, Position, correct, tangent,
};
use jounce_orbits::{Condition, ExtendedEvaluation, ExtendedProblem};

/// Distances past the grazing of the search, as lengths along the old tangent in the metric. The
/// differences for the new tangent must not reach the old side. That side is near for long where a
/// curve crosses the grazing at a small angle.
const SEARCH_DISTANCES: [f64; 4] = [1e-2, 3e-2, 3e-3, 1e-3];

/// Distance along the old tangent within which a grazing counts as the cause of a failed step.
const MAX_GRAZING_DISTANCE: f64 = 0.03;

/// Largest distance of the restart point.
const MAX_RESTART_DISTANCE: f64 = 0.2;

/// Returns a point of the curve beyond the grazing, ahead of `position`, with its tangent; `None`
/// where there is no grazing within the limit.
pub fn beyond_grazing(
    tracking: &ExtendedProblem<KeyPlane>,
    corrector: &Corrector,
    scale_2: f64,
    (position, heading): (&Position, &Direction),
) -> Option<(CorrectedPoint<ExtendedEvaluation>, Direction)> {
    if matches!(tracking.condition, Condition::Touching(_)) {
        return None;
    }
    let metric = Metric::at(position, scale_2);
    let heading = metric.unit(heading.clone());
    let past = tracking
        .past(&position.unknown, position.parameter)
        .ok()??;
    let parameter_index = tracking.parameter_index();
    let along = |direction: &Direction| {
        let by_state: f64 = past
            .by_unknown
            .iter()
            .zip(&direction.unknown)
            .map(|(a, b)| a * b)
            .sum();
        by_state
            + past.by_parameters[0] * tracking.unit * direction.unknown[parameter_index]
            + past.by_parameters[1] * direction.parameter
    };
    let (step, sense) = (-past.value / along(&heading), along(&heading).signum());
    if step.is_nan() || step.abs() > MAX_GRAZING_DISTANCE {
        return None;
    }
    // Just past a grazing the distance is zero.
    let to_grazing = step.max(0.0);
    let mut by_unknown = past.by_unknown.clone();
    by_unknown.push(tracking.unit * past.by_parameters[0]);
    by_unknown.resize(position.unknown.len(), 0.0);
    // The row of `across` in the metric is the gradient.
    let across = Direction {
        unknown: by_unknown
            .iter()
            .map(|by| sense * by * metric.unknown * metric.unknown)
            .collect(),
        parameter: sense * past.by_parameters[1] * metric.parameter * metric.parameter,
    };
    SEARCH_DISTANCES.into_iter().find_map(|beyond| {
        let guess = position.offset_along(&heading, to_grazing + beyond);
        let corrected = correct(tracking, corrector, &metric, &across, guess).ok()?;
        let tangent = tangent(&corrected.local, &metric, &across)?;
        let step = position.to(&corrected.position);
        (metric.length(&step) < MAX_RESTART_DISTANCE && along(&step) * sense > 0.0)
            .then_some((corrected, tangent))
    })
}
