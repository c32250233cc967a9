//! An orbit followed from one design to another.

use crate::evaluation::{Evaluator, MainOrbit};
use crate::problem::Condition;
use jounce_analysis::{KeyLine, Model};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_orbits::{Orbit, OrbitMethod, Shooting};
use jounce_spec::NumericKey;

/// Tolerance of the integrations, and goal of Newton's method relative to the state.
const TOLERANCE: f64 = 1e-8;
const NEWTON_GOAL: f64 = 1e-7;

/// Largest number of evaluations of Newton's method.
const MAX_EVALUATIONS: u32 = 8;

/// Smallest part of the way from one design to the other that is taken at once.
const SHORTEST: f64 = 1.0 / 64.0;

/// A stable orbit of a model.
#[derive(Debug)]
pub struct Followed {
    /// Model.
    pub model: Model,
    /// Orbit.
    pub orbit: Orbit,
}

impl Followed {
    /// Returns the orbit of an evaluation in the first condition, computed anew at the tolerance of
    /// this search.
    pub fn start(evaluator: &Evaluator<'_>, place: &[f64], orbit: &MainOrbit) -> Option<Self> {
        Self::in_condition(
            evaluator,
            place,
            (evaluator.problem.conditions.first()?, orbit),
        )
    }

    /// Returns the orbit of an evaluation in a condition.
    pub fn in_condition(
        evaluator: &Evaluator<'_>,
        place: &[f64],
        (condition, orbit): (&Condition, &MainOrbit),
    ) -> Option<Self> {
        let model = evaluator.model(place, condition).ok()?;
        Self::near(model, orbit.period_cycles, &orbit.state)
    }

    /// Returns the stable orbit of a model near a state in energy coordinates.
    pub fn near(model: Model, period_cycles: u32, state: &[f64]) -> Option<Self> {
        let line = KeyLine::at(&model);
        let physical = shooting(&line, period_cycles).physical(state);
        let orbit = corrected(&line, period_cycles, &physical)?;
        Some(Self { model, orbit })
    }

    /// Returns the stable orbit at other values of some keys, SI, that continues this one; `None`
    /// where it is lost on the straight line between both.
    pub fn to(&self, values: &[(&NumericKey, f64)]) -> Option<Self> {
        let ends = values.iter().map(|(key, to)| {
            let value = key.get(&self.model.spec).ok()?;
            Some((*key, [value, *to]))
        });
        let line = KeyLine {
            base: &self.model,
            ends: ends.collect::<Option<Vec<_>>>()?,
        };
        let period = self.orbit.period_cycles;
        let mut physical = shooting(&KeyLine::at(&self.model), period).physical(self.orbit.start());
        let (mut place, mut step) = (0.0, 1.0_f64);
        loop {
            let next = (place + step).min(1.0);
            let model = line.model(next).ok()?;
            let here = KeyLine::at(&model);
            let Some(orbit) = corrected(&here, period, &physical) else {
                step *= 0.5;
                if step < SHORTEST {
                    return None;
                }
                continue;
            };
            if next >= 1.0 {
                return Some(Self { model, orbit });
            }
            physical = shooting(&here, period).physical(orbit.start());
            (place, step) = (next, 2.0 * step);
        }
    }
}

fn shooting<'l>(line: &'l KeyLine<'l>, cycles: u32) -> Shooting<'l, KeyLine<'l>> {
    Shooting::new(line, &line.base.kernel, cycles, TOLERANCE)
}

/// Returns the stable orbit near a physical state.
fn corrected(line: &KeyLine<'_>, cycles: u32, physical: &[f64]) -> Option<Orbit> {
    let shooting = shooting(line, cycles);
    if shooting.scale.len() != physical.len() {
        return None;
    }
    let shooting = shooting.charged_as(physical);
    let position = Position {
        unknown: shooting.unknown(physical),
        parameter: 0.0,
    };
    let corrector = Corrector {
        goal: NEWTON_GOAL,
        most: MAX_EVALUATIONS,
    };
    let metric = Metric::at(&position, 1.0);
    let found = correct_at(&shooting, &corrector, &metric, position).ok()?;
    let orbit = shooting.orbit(&found.local, found.error).ok()?;
    orbit.is_stable().then_some(orbit)
}
