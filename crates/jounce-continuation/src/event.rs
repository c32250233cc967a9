//! Location of the zero of a test function between two points of a curve.

use super::{
    Bracket, Corrector, CurvePoint, Direction, HermiteSegment, Metric, Position, Problem, correct,
    tangent,
};

/// Largest number of trial points.
const MAX_TRIALS: u32 = 40;

/// Where Newton fails: bracket length relative to the resolution below which any trial point is
/// accepted.
const NARROW_BRACKET: f64 = 10.0;

/// Where Newton fails: value of an acceptable trial point relative to the values at the two ends.
const SMALL_VALUE: f64 = 0.01;

/// One side of the zero.
#[derive(Debug, Clone)]
struct BracketEnd {
    position: Position,
    tangent: Direction,
    /// Distance along the chord.
    distance: f64,
}

/// Locates the zero of `value`, which has different signs at `before` and `after`.
///
/// A [`Bracket`] gives trial points along the chord. Each starts from the cubic between the two
/// sides, whose error falls with the fourth power of its length. The search ends when the bracket
/// or the last move is shorter than `resolution` (in the metric), or a value is as small relative
/// to those at the two ends. Newton may fail within roundoff of a kink. Then the trial point with
/// the smallest value is returned if it is close enough. Otherwise, as between points of different
/// pieces, it returns `None`.
pub fn locate<F: Problem>(
    family: &F,
    corrector: &Corrector,
    parameter_scale: f64,
    (before, after): (&CurvePoint<F::Evaluation>, &CurvePoint<F::Evaluation>),
    resolution: f64,
    value: impl Fn(&CurvePoint<F::Evaluation>) -> f64,
) -> Option<CurvePoint<F::Evaluation>> {
    let metric = Metric::at(&before.position, parameter_scale);
    let chord = before.position.to(&after.position);
    let length = metric.length(&chord);
    let unit = metric.unit(chord);
    let side = |step: &CurvePoint<F::Evaluation>, distance: f64| BracketEnd {
        position: step.position.clone(),
        tangent: step.tangent.clone(),
        distance,
    };
    let (at_low, at_high) = (value(before), value(after));
    let size = at_low.abs().max(at_high.abs());
    let mut bracket = Bracket::between((0.0, at_low), (length, at_high));
    let (mut low, mut high) = (side(before, 0.0), side(after, length));
    let mut best: Option<(f64, CurvePoint<F::Evaluation>)> = None;
    for _ in 0..MAX_TRIALS {
        let segment = HermiteSegment::between(
            &metric,
            (&low.position, &low.tangent),
            (&high.position, &high.tangent),
        );
        let share = (bracket.next(resolution) - low.distance) / (high.distance - low.distance);
        let guess = segment.at(share * segment.length);
        let Some(step) = point_near(family, corrector, &metric, &unit, guess) else {
            let is_narrow = bracket.length() <= NARROW_BRACKET * resolution;
            return best
                .filter(|(magnitude, _)| is_narrow || *magnitude <= SMALL_VALUE * size)
                .map(|(_, step)| step);
        };
        let (distance, value_here) = (
            metric.inner(&unit, &before.position.to(&step.position)),
            value(&step),
        );
        let progress = bracket.put(distance, value_here);
        *(if (value_here > 0.0) == (at_high > 0.0) {
            &mut high
        } else {
            &mut low
        }) = side(&step, distance);
        if value_here.abs() <= resolution * size || progress.min(bracket.length()) <= resolution {
            return Some(step);
        }
        if best
            .as_ref()
            .is_none_or(|(least, _)| value_here.abs() < *least)
        {
            best = Some((value_here.abs(), step));
        }
    }
    None
}

/// Returns the point of the curve near a guess, in the plane normal to a direction, with its
/// tangent; `None` where Newton fails.
fn point_near<F: Problem>(
    family: &F,
    corrector: &Corrector,
    metric: &Metric,
    normal: &Direction,
    guess: Position,
) -> Option<CurvePoint<F::Evaluation>> {
    let corrected = correct(family, corrector, metric, normal, guess).ok()?;
    Some(CurvePoint {
        tangent: tangent(&corrected.local, metric, normal)?,
        position: corrected.position,
        local: corrected.local,
        error: corrected.error,
    })
}
