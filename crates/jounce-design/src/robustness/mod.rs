//! Distribution of the power of a design under the tolerances of the workshop.
//!
//! The main orbit is followed from the design to each drawn one. Where it is lost, the power is the
//! expected power of the starts there.

mod power_band;
mod sobol_indices;

pub use power_band::PowerBandSearch;

use crate::DesignError;
use crate::evaluation::{Effort, Evaluator};
use crate::result::{Quantile, Robustness, SobolIndex};
use crate::search::{Followed, Places};
use jounce_spec::NumericKey;
use rayon::prelude::*;
use sobol_indices::{Values, indices};

/// Shares of the reported quantiles.
const SHARES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Power of a drawn design, W, and whether the main orbit is lost.
type Drawn = (f64, bool);

/// Draws the design under its tolerances; `None` without tolerances.
pub fn robustness(
    evaluator: &Evaluator<'_>,
    followed: &Followed,
) -> Result<Option<Robustness>, DesignError> {
    let problem = evaluator.problem;
    let keys = problem.tolerances.len();
    if keys == 0 || evaluator.control.is_stopped() {
        return Ok(None);
    }
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
        .map(|row| drawn(evaluator, followed, row))
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

/// Evaluates a drawn design.
fn drawn(
    evaluator: &Evaluator<'_>,
    followed: &Followed,
    row: &[f64],
) -> Result<Drawn, DesignError> {
    evaluator.control.count();
    let tolerances = &evaluator.problem.tolerances;
    let mut values: Vec<(&NumericKey, f64)> = Vec::with_capacity(row.len());
    for (tolerance, place) in tolerances.iter().zip(row) {
        let nominal = tolerance.key.get(&followed.model.spec);
        let nominal = nominal.map_err(jounce_analysis::AnalysisError::from)?;
        values.push((&tolerance.key, nominal + tolerance.deviation(*place)));
    }
    if let Some(there) = followed.to(&values) {
        return Ok((there.orbit.mean_power_w, false));
    }
    let evaluation = evaluator.at(&followed.model, &values, Effort::Screening);
    Ok((evaluation.map_or(0.0, |one| one.expected_power_w[0]), true))
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
