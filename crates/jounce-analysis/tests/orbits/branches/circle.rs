//! Steps of continuation along a circle.

use jounce_continuation::{
    Continuation, Corrector, Direction, Linearization, Position, Problem, StepControl,
};

/// A circle whose problem is not defined below parameter zero: steps become shorter before
/// continuation ends.
#[test]
fn a_step_into_nothing_is_made_shorter() {
    let at = |angle: f64| Position {
        unknown: vec![1.5 + angle.cos()],
        parameter: 1.0 + angle.sin(),
    };
    let tangent = |angle: f64| Direction {
        unknown: vec![-angle.sin()],
        parameter: angle.cos(),
    };
    let angle = -0.9;
    // The circle touches zero at its lowest point.
    let start_direction = Direction {
        unknown: vec![-tangent(angle).unknown[0]],
        parameter: -tangent(angle).parameter,
    };
    let continuation = Continuation::new(
        &Circle,
        Corrector {
            goal: 1e-12,
            most: 8,
        },
        StepControl {
            first: 0.3,
            ..StepControl::default()
        },
        1.0,
        at(angle),
        start_direction,
    );
    let last = continuation
        .take(200)
        .map(|step| step.map(|step| step.position))
        .take_while(|step| step.as_ref().is_ok_and(|at| at.parameter < 1.0))
        .last();
    let last = last.unwrap().unwrap();
    assert!(last.unknown[0] < 1.0, "{last:?}");
}

/// `(u - 1.5)^2 + (p - 1)^2 = 1`, for positive `p` only.
struct Circle;

struct Place {
    residual: [f64; 1],
    slopes: [f64; 2],
}

impl Problem for Circle {
    type Evaluation = Place;
    type Error = String;

    fn at(&self, unknown: &[f64], parameter: f64) -> Result<Place, String> {
        let (x, y) = (unknown[0] - 1.5, parameter - 1.0);
        if parameter < 0.0 {
            Err(format!("{parameter}"))
        } else {
            Ok(Place {
                residual: [x * x + y * y - 1.0],
                slopes: [2.0 * x, 2.0 * y],
            })
        }
    }
}

impl Linearization for Place {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn bordered(
        &self,
        row: &[f64],
        corner: f64,
        right: &[f64],
        last: f64,
    ) -> Option<(Vec<f64>, f64)> {
        let [a, b] = self.slopes;
        let below = a * corner - b * row[0];
        (below != 0.0).then(|| {
            (
                vec![(right[0] * corner - b * last) / below],
                (a * last - row[0] * right[0]) / below,
            )
        })
    }
}
