//! What is known of the best design: its values, the price of its limits, the nearest fold, its
//! robustness, and free keys without an effect.

mod effects;
mod noise;
mod prices;

use crate::DesignError;
use crate::evaluation::{Evaluation, Evaluator, examined_fold};
use crate::problem::{FreeKey, FreeValues, Goal, Limit, Problem};
use crate::result::{
    BestDesign, DesignBefore, DesignOutcome, FreeValue, Improvement, LimitResult, NearestFold,
    NoisePower, SearchEnd, TracePoint,
};
use crate::robustness::robustness;
use crate::search::{Candidate, Followed};
use noise::Noise;
use std::collections::BTreeMap;

/// Share of a limit above which it binds.
const ACTIVE_SHARE: f64 = 0.99;

/// Distance from an end of the unit cube below which a key is at the end of its range.
const AT_END: f64 = 1e-3;

/// Examines the best design.
pub fn examine(
    evaluator: &Evaluator<'_>,
    best: &Candidate,
    ended_by: SearchEnd,
) -> Result<DesignOutcome, DesignError> {
    let problem = evaluator.problem;
    let evaluation = &best.evaluation;
    let followed = evaluation
        .orbit
        .as_ref()
        .and_then(|orbit| Followed::start(evaluator, &best.place, orbit));
    let orbit = followed.as_ref().zip(evaluation.orbit.as_ref());
    let (nearest_fold, nearer) = orbit.map_or((None, None), |(followed, orbit)| {
        examined_fold(&followed.model, orbit, &problem.tolerances)
    });
    let noise = Noise::of(evaluator, &best.place)?;
    let mut warnings = effects::warnings(evaluator, best, followed.as_ref())?;
    warnings.extend(effects::unsettled(problem, evaluation));
    warnings.extend(nearer);
    Ok(DesignOutcome {
        warnings,
        limits: limits(problem, best, followed.as_ref(), noise.as_ref()),
        robust: robustness(evaluator, best)?,
        front: Vec::new(),
        before: before(evaluator),
        feasible: evaluation.is_feasible(),
        violation: evaluation.violation,
        ended_by,
        trace: Vec::new(),
        evaluations: 0,
        seed: problem.seed,
        wall_time_s: 0.0,
        best: best_design(
            problem,
            best,
            nearest_fold,
            noise.and_then(|noise| noise.power()),
        ),
    })
}

/// Returns what is known of a better design before its examination.
pub fn improvement(problem: &Problem, design: &Candidate, point: TracePoint) -> Improvement {
    Improvement {
        point,
        set: settings(problem, &design.place),
        limits: limits(problem, design, None, None),
    }
}

/// Returns the value of each limit, with its price where it binds.
fn limits(
    problem: &Problem,
    best: &Candidate,
    followed: Option<&Followed>,
    noise: Option<&Noise<'_>>,
) -> Vec<LimitResult> {
    let limit = |(index, (limit, value)): (usize, (&Limit, &f64))| LimitResult {
        name: limit.name.clone(),
        value: *value,
        limit: limit.value,
        is_lower: limit.is_lower(),
        violation: limit.violation(*value),
        active: match limit.is_lower() {
            true => value * ACTIVE_SHARE <= limit.value,
            false => *value >= ACTIVE_SHARE * limit.value,
        },
        price: None,
        noise: noise.and_then(|noise| noise.limit(index)),
    };
    let pairs = problem.limits.iter().zip(&best.evaluation.limits);
    let mut limits: Vec<LimitResult> = pairs.enumerate().map(limit).collect();
    if let Some(followed) = followed {
        let binds = |limit: &LimitResult| limit.active && limit.violation == 0.0;
        let active: Vec<bool> = limits.iter().map(binds).collect();
        let prices = prices::prices(problem, &best.place, followed, &active);
        for (limit, price) in limits.iter_mut().zip(prices) {
            limit.price = price;
        }
    }
    limits
}

fn best_design(
    problem: &Problem,
    best: &Candidate,
    nearest_fold: Option<NearestFold>,
    noise: Option<NoisePower>,
) -> BestDesign {
    let evaluation = &best.evaluation;
    let orbit = evaluation.orbit.as_ref();
    let [expected, expected_low, expected_high] = evaluation.expected_power_w;
    let [fraction, fraction_low, fraction_high] = evaluation.basin_fraction;
    let mut goals_of_runs = problem.goals.iter().zip(&evaluation.goals);
    let of_run = || {
        goals_of_runs
            .find(|(goal, _)| **goal == Goal::MeanPower)
            .map_or(f64::NAN, |(_, power_w)| *power_w)
    };
    BestDesign {
        set: settings(problem, &best.place),
        keys: keys(problem, &best.place),
        goals: goals(problem, evaluation),
        mean_power_w: orbit.map_or_else(of_run, |orbit| orbit.mean_power_w),
        expected_power_w: expected,
        expected_power_low_w: expected_low,
        expected_power_high_w: expected_high,
        basin_fraction: fraction,
        basin_fraction_low: fraction_low,
        basin_fraction_high: fraction_high,
        stable: orbit.is_some(),
        period_cycles: orbit.map_or(0, |orbit| orbit.period_cycles),
        nearest_fold,
        noise,
    }
}

/// Returns the values of the free keys at a place, as text.
pub fn settings(problem: &Problem, place: &[f64]) -> BTreeMap<String, String> {
    let applying = problem.applying(place);
    applying
        .flat_map(|(_, free, coordinate)| free.settings(coordinate))
        .collect()
}

fn goals(problem: &Problem, evaluation: &Evaluation) -> BTreeMap<String, f64> {
    let names = problem.goals.iter().map(|goal| goal.name().to_owned());
    names.zip(evaluation.goals.iter().copied()).collect()
}

fn keys(problem: &Problem, place: &[f64]) -> Vec<FreeValue> {
    let value = |(_, free, place): (usize, &FreeKey, f64)| {
        let is_range = matches!(free.values, FreeValues::Range(_));
        FreeValue {
            key: free.path.clone(),
            value: free.text(place),
            before: free.given(&problem.spec),
            at_end: match place {
                _ if !is_range => None,
                place if place < AT_END => Some("lower"),
                place if place > 1.0 - AT_END => Some("upper"),
                _ => None,
            },
        }
    };
    problem.applying(place).map(value).collect()
}

/// Evaluates the spec as given.
fn before(evaluator: &Evaluator<'_>) -> DesignBefore {
    let problem = evaluator.problem;
    let evaluation = evaluator.given();
    if evaluation.failure.is_some() {
        return DesignBefore {
            goals: BTreeMap::new(),
            expected_power_w: f64::NAN,
            violation: None,
        };
    }
    DesignBefore {
        goals: goals(problem, &evaluation),
        expected_power_w: evaluation.expected_power_w[0],
        violation: Some(evaluation.violation).filter(|violation| violation.is_finite()),
    }
}
