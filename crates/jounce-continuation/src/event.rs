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
/// the smallest value is returned if it is close enough, and likewise where a trial point has no
/// value. Otherwise, as between points of different pieces or without a value at an end, it returns
/// `None`.
pub fn locate<F: Problem>(
    family: &F,
    corrector: &Corrector,
    parameter_scale: f64,
    (before, after): (&CurvePoint<F::Evaluation>, &CurvePoint<F::Evaluation>),
    resolution: f64,
    value: impl Fn(&CurvePoint<F::Evaluation>) -> Option<f64>,
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
    let (at_low, at_high) = (value(before)?, value(after)?);
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
        let trial = point_near(family, corrector, &metric, &unit, guess);
        let Some((step, value_here)) = trial.and_then(|step| value(&step).map(|here| (step, here)))
        else {
            let is_narrow = bracket.length() <= NARROW_BRACKET * resolution;
            return best
                .filter(|(magnitude, _)| is_narrow || *magnitude <= SMALL_VALUE * size)
                .map(|(_, step)| step);
        };
        let distance = metric.inner(&unit, &before.position.to(&step.position));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Linearization;

    /// The line `u = p`.
    struct Line;

    struct Residual([f64; 1]);

    impl Linearization for Residual {
        fn residual(&self) -> &[f64] {
            &self.0
        }

        /// Solves `[1 -1; row corner] (du, dp) = (right, last)`.
        fn bordered(
            &self,
            row: &[f64],
            corner: f64,
            right: &[f64],
            last: f64,
        ) -> Option<(Vec<f64>, f64)> {
            let dp = (last - row[0] * right[0]) / (row[0] + corner);
            Some((vec![right[0] + dp], dp))
        }
    }

    impl Problem for Line {
        type Evaluation = Residual;
        type Error = std::convert::Infallible;

        fn at(&self, unknown: &[f64], parameter: f64) -> Result<Residual, Self::Error> {
            Ok(Residual([unknown[0] - parameter]))
        }
    }

    fn point(parameter: f64) -> CurvePoint<Residual> {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        CurvePoint {
            position: Position {
                unknown: vec![parameter],
                parameter,
            },
            tangent: Direction {
                unknown: vec![half],
                parameter: half,
            },
            local: Residual([0.0]),
            error: 0.0,
        }
    }

    /// A test function without a value at a trial point or at an end has no proved zero.
    #[test]
    fn a_point_without_a_value_is_no_zero() {
        let corrector = Corrector {
            goal: 1e-12,
            most: 10,
        };
        let (before, after) = (point(0.0), point(1.0));
        let zero = |value: &dyn Fn(f64) -> Option<f64>| {
            let value = |step: &CurvePoint<Residual>| value(step.position.parameter);
            locate(&Line, &corrector, 1.0, (&before, &after), 1e-9, value)
        };
        let found = zero(&|p| Some(p - 0.3)).map_or(f64::NAN, |step| step.position.parameter);
        assert!((found - 0.3).abs() < 1e-8, "{found}");
        assert!(zero(&|p| [0.0, 1.0].contains(&p).then_some(p - 0.3)).is_none());
        assert!(zero(&|p| (p < 1.0).then_some(p - 0.3)).is_none());
    }
}
