//! Free keys that change neither a goal nor a limit at the best design, such as the gap of a stop
//! that no orbit reaches.

use crate::evaluation::{Effort, Evaluation, Evaluator};
use crate::problem::{FreeKey, FreeValues, Goal, Problem};
use crate::search::{Candidate, Followed};
use crate::{DesignError, Size};
use jounce_analysis::{DerivativeAccuracy, DerivativeKey, orbit_derivatives};

/// Relative change below which a result is unchanged.
const UNCHANGED: f64 = 1e-6;

/// Returns a sentence where the run of the best design had not settled, so that its power counts as 0.
pub fn unsettled(problem: &Problem, evaluation: &Evaluation) -> Option<String> {
    let mut goals = problem.goals.iter().zip(&evaluation.goals);
    let is_transient = goals.any(|(goal, value)| *goal == Goal::MeanPower && *value == 0.0);
    let duration_s = problem.spec.run.duration_s;
    is_transient.then(|| {
        format!(
            "no design was found whose run settles within run.duration = {duration_s} s, and the power of a transient counts as 0; increase run.duration, or maximise \"expected-power\" or \"stable-power\", which search for the orbits"
        )
    })
}

/// Returns a sentence for each free key without an effect. Where the main orbit has a derivative by
/// the key, that is its effect; the other keys are set to both ends of their ranges, or to each
/// other choice.
pub fn warnings(
    evaluator: &Evaluator<'_>,
    best: &Candidate,
    followed: Option<&Followed>,
) -> Result<Vec<String>, DesignError> {
    let problem = evaluator.problem;
    let (place, mut all) = (&best.place, Vec::new());
    let moved = |index: usize, free: &FreeKey, coordinate: f64| {
        let with = |other: f64| {
            let mut moved = place.clone();
            moved[index] = other;
            moved
        };
        others(free, coordinate).into_iter().map(with).collect()
    };
    for (index, free, coordinate) in problem.applying(place) {
        let has_slope = followed.is_some_and(|followed| has_slope(problem, followed, index, place));
        if evaluator.control.is_stopped() || has_slope {
            continue;
        }
        let moved: Vec<Vec<f64>> = moved(index, free, coordinate);
        let mut is_unchanged = true;
        let here = evaluator.evaluate(place, Effort::Screening)?;
        for other in moved {
            let there = evaluator.evaluate(&other, Effort::Screening)?;
            is_unchanged = is_same(&here, &there);
            if !is_unchanged {
                break;
            }
        }
        if is_unchanged {
            all.push(match &free.values {
                FreeValues::Range(_) => format!(
                    "{}: the best design has the same goals and limits at both ends of its range; its value does not matter",
                    free.path
                ),
                FreeValues::Choice(_) => format!(
                    "{}: the best design has the same goals and limits with every choice",
                    free.path
                ),
            });
        }
    }
    Ok(all)
}

/// Returns the coordinates of the ends of a range, or of the other choices.
fn others(free: &FreeKey, coordinate: f64) -> Vec<f64> {
    match free.values {
        FreeValues::Range(_) => vec![0.0, 1.0],
        FreeValues::Choice(_) => {
            let (own, count) = (free.choice(coordinate), free.choice_count());
            let others = (0..count).filter(|choice| *choice != own);
            others
                .map(|choice| (choice as f64 + 0.5) / count as f64)
                .collect()
        }
    }
}

/// True where the power, a limited peak or a limited size has a derivative by a key.
fn has_slope(problem: &Problem, followed: &Followed, index: usize, place: &[f64]) -> bool {
    let keys = problem.derivative_keys(&[index], place);
    let [key] = &keys[..] else {
        return false;
    };
    let quantities = problem.orbit_quantities();
    let accuracy = DerivativeAccuracy::Rough;
    let found = orbit_derivatives(
        &followed.model,
        &followed.orbit,
        &keys,
        &quantities,
        accuracy,
    );
    let of_orbit = found.is_ok_and(|found| {
        let slopes = found.by_key.into_iter().flatten().flatten();
        let mut pairs = slopes.zip(&found.values);
        pairs.any(|(slope, value)| (slope.value * key.scale).abs() > UNCHANGED * value.abs())
    });
    of_orbit
        || problem
            .sizes()
            .iter()
            .any(|(_, size)| size_changes(*size, followed, key))
}

fn size_changes(size: Size, followed: &Followed, key: &DerivativeKey<'_>) -> bool {
    let spec = &followed.model.spec;
    let slope = size.derivative(spec, key);
    slope.is_some_and(|slope| (slope * key.scale).abs() > UNCHANGED * size.of(spec))
}

/// True where two designs have the same goals and limits.
fn is_same(one: &Evaluation, other: &Evaluation) -> bool {
    let values = |evaluation: &Evaluation| {
        let goals = evaluation.goals.iter().chain(&evaluation.limits);
        goals.copied().collect::<Vec<f64>>()
    };
    let near = |(a, b): (f64, f64)| {
        a == b || (a.is_nan() && b.is_nan()) || (a - b).abs() <= UNCHANGED * a.abs().max(b.abs())
    };
    let mut pairs = values(one).into_iter().zip(values(other));
    one.failure == other.failure && pairs.all(near)
}
