//! Distribution of the power of a design under the tolerances of the workshop.
//!
//! The power of a drawn design is that of the main orbits, the mean over the conditions by their
//! weights. Each main orbit is followed from the design to the drawn one; where it is lost, its power is
//! the expected power of the starts there.

mod power_band;
mod sobol_indices;

pub use power_band::PowerBandSearch;

use crate::DesignError;
use crate::evaluation::{Evaluator, MainOrbit};
use crate::problem::Condition;
use crate::result::{Quantile, Robustness, SobolIndex};
use crate::search::{Candidate, Followed, Places};
use jounce_spec::NumericKey;
use rayon::prelude::*;
use sobol_indices::{Values, indices};

/// Shares of the reported quantiles.
const SHARES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Power of a drawn design, W, and whether a main orbit is lost.
type Drawn = (f64, bool);

/// Main orbit of a condition with the weight of this one, relative to the sum of all.
type Weighted = (Followed, f64);

/// Draws the design under its tolerances; `None` without tolerances or without an orbit in each
/// condition.
pub fn robustness(
    evaluator: &Evaluator<'_>,
    best: &Candidate,
) -> Result<Option<Robustness>, DesignError> {
    let problem = evaluator.problem;
    let keys = problem.tolerances.len();
    if keys == 0 || evaluator.control.is_stopped() {
        return Ok(None);
    }
    let Some(followed) = main_orbits(evaluator, best) else {
        return Ok(None);
    };
    // Two independent draws side by side, and the first with one column of the second.
    let pairs = Places::new(2 * keys, problem.seed).take(problem.draws);
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(problem.draws * (keys + 2));
    rows.extend(pairs.iter().map(|pair| pair[..keys].to_vec()));
    rows.extend(pairs.iter().map(|pair| pair[keys..].to_vec()));
    for key in 0..keys {
        rows.extend(pairs.iter().map(|pair| {
            let mut row = pair[..keys].to_vec();
            row[key] = pair[keys + key];
            row
        }));
    }
    let drawn: Result<Vec<Drawn>, DesignError> = rows
        .par_iter()
        .map(|row| drawn(evaluator, &followed, row))
        .collect();
    let drawn = drawn?;
    if evaluator.control.is_stopped() {
        return Ok(None);
    }
    let powers_w: Vec<f64> = drawn.iter().map(|(power_w, _)| *power_w).collect();
    let independent = 2 * problem.draws;
    let lost = drawn[..independent].iter().filter(|(_, lost)| *lost);
    let lost_fraction = lost.count() as f64 / independent as f64;
    let (a, rest) = powers_w.split_at(problem.draws);
    let (b, mixed) = rest.split_at(problem.draws);
    let index = |key: usize| {
        let values = Values {
            a,
            b,
            mixed: &mixed[key * problem.draws..(key + 1) * problem.draws],
        };
        let [first, total] = indices(&values, problem.seed);
        SobolIndex {
            key: problem.tolerances[key].key.path().to_owned(),
            first: first.value,
            first_low: first.low,
            first_high: first.high,
            total: total.value,
            total_low: total.low,
            total_high: total.high,
        }
    };
    Ok(Some(Robustness {
        quantiles: quantiles(&powers_w[..independent]),
        sobol: (0..keys).map(index).collect(),
        draws: independent,
        lost_fraction,
    }))
}

/// Returns the main orbit of each condition.
fn main_orbits(evaluator: &Evaluator<'_>, best: &Candidate) -> Option<Vec<Weighted>> {
    let conditions = &evaluator.problem.conditions;
    let total: f64 = conditions.iter().map(|condition| condition.weight).sum();
    let evaluation = &best.evaluation;
    let orbits = std::iter::once(&evaluation.orbit).chain(&evaluation.further_orbits);
    let main = |(condition, orbit): (&Condition, &Option<MainOrbit>)| {
        let orbit = (condition, orbit.as_ref()?);
        let followed = Followed::in_condition(evaluator, &best.place, orbit)?;
        Some((followed, condition.weight / total))
    };
    conditions.iter().zip(orbits).map(main).collect()
}

/// Evaluates a drawn design.
fn drawn(
    evaluator: &Evaluator<'_>,
    followed: &[Weighted],
    row: &[f64],
) -> Result<Drawn, DesignError> {
    let (mut mean_w, mut is_lost) = (0.0, false);
    for (followed, weight) in followed {
        let mut values: Vec<(&NumericKey, f64)> = Vec::with_capacity(row.len());
        for (tolerance, place) in evaluator.problem.tolerances.iter().zip(row) {
            let nominal = tolerance.key.get(&followed.model.spec);
            let nominal = nominal.map_err(jounce_analysis::AnalysisError::from)?;
            values.push((&tolerance.key, nominal + tolerance.deviation(*place)));
        }
        let there = followed.to(&values);
        is_lost |= there.is_none();
        let power_w = match there {
            Some(there) => there.orbit.mean_power_w,
            None => evaluator.expected_power_w(&followed.model, &values),
        };
        mean_w += weight * power_w;
    }
    Ok((mean_w, is_lost))
}

/// Returns the quantiles of some powers.
fn quantiles(powers_w: &[f64]) -> Vec<Quantile> {
    let mut sorted = powers_w.to_vec();
    sorted.sort_by(f64::total_cmp);
    SHARES
        .iter()
        .map(|share| Quantile {
            share: *share,
            mean_power_w: quantile(&sorted, *share),
        })
        .collect()
}

/// Returns the quantile of a share of some powers in order, linear between them; NaN without any.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let position = share * last as f64;
    let index = position as usize;
    let next = sorted[(index + 1).min(last)];
    sorted[index] + (position - index as f64) * (next - sorted[index])
}
