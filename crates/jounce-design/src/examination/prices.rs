//! Price of a limit: the gain of power per unit of it.
//!
//! At the best design the derivative of the power by the free keys is a combination of those of the
//! limits that bind (Karush, Kuhn and Tucker),
//!
//! ```text
//! dP/dx = sum_i price_i dc_i/dx,   price_i >= 0
//! ```
//!
//! over the keys that are not at an end of their range. The prices solve it in the least squares;
//! a limit with a negative price does not bind, and is left out. So is one that no key affects.

use crate::problem::Problem;
use crate::search::Followed;
use jounce_analysis::{Derivative, DerivativeAccuracy, DerivativeKey, orbit_derivatives};
use jounce_linalg::Mat;

/// Returns the price of each limit, W per SI unit; `None` for one that does not bind.
pub fn prices(
    problem: &Problem,
    place: &[f64],
    followed: &Followed,
    active: &[bool],
) -> Vec<Option<f64>> {
    let mut prices = vec![None; active.len()];
    let mut peaks = problem.peaks();
    peaks.retain(|(index, _)| active[*index]);
    let mut sizes = problem.sizes();
    sizes.retain(|(index, _)| active[*index]);
    let inner: Vec<usize> = (0..place.len())
        .filter(|k| (super::AT_END..=1.0 - super::AT_END).contains(&place[*k]))
        .collect();
    let keys = problem.derivative_keys(&inner, place);
    let quantities = problem.orbit_quantities();
    let binding: Vec<usize> = peaks
        .iter()
        .map(|(index, _)| *index)
        .chain(sizes.iter().map(|(index, _)| *index))
        .collect();
    if binding.is_empty() || keys.is_empty() {
        return prices;
    }
    let accuracy = DerivativeAccuracy::Estimated;
    let found = orbit_derivatives(
        &followed.model,
        &followed.orbit,
        &keys,
        &quantities,
        accuracy,
    );
    let Ok(found) = found else { return prices };
    let spec = &followed.model.spec;
    let row = |(row, key): (Result<Vec<Derivative>, _>, &DerivativeKey<'_>)| {
        let of_orbit = row.ok()?.into_iter().map(|slope| Some(slope.value));
        let of_size = sizes.iter().map(|(_, size)| size.derivative(spec, key));
        let scaled = of_orbit.chain(of_size);
        scaled
            .map(|slope| Some(slope? * key.scale))
            .collect::<Option<Vec<f64>>>()
    };
    let by_key: Option<Vec<Vec<f64>>> = found.by_key.into_iter().zip(&keys).map(row).collect();
    let Some(by_key) = by_key else { return prices };
    let mut values = found.values;
    values.extend(sizes.iter().map(|(_, size)| size.of(spec)));
    let is_affected = |column: &usize| by_key.iter().any(|row| row[*column] != 0.0);
    let mut columns: Vec<usize> = (1..=binding.len()).filter(is_affected).collect();
    while !columns.is_empty() {
        let Some(solved) = least_squares(&values, &by_key, &columns) else {
            return prices;
        };
        let Some(worst) = (0..solved.len())
            .filter(|k| solved[*k] < 0.0)
            .min_by(|a, b| solved[*a].total_cmp(&solved[*b]))
        else {
            for (column, price) in columns.iter().zip(solved) {
                prices[binding[column - 1]] = Some(price);
            }
            return prices;
        };
        columns.remove(worst);
    }
    prices
}

/// Solves for the prices of some limits in the least squares, in relative units. `by_key` has the
/// derivatives of the values by the place of each key.
fn least_squares(values: &[f64], by_key: &[Vec<f64>], columns: &[usize]) -> Option<Vec<f64>> {
    let entry = |key: usize, quantity: usize| by_key[key][quantity] / values[quantity];
    let keys = by_key.len();
    let matrix = Mat::from_fn(keys, columns.len(), |key, j| entry(key, columns[j]));
    let right = Mat::from_fn(keys, 1, |key, _| entry(key, 0));
    let solved = jounce_linalg::pseudoinverse(&matrix)? * right;
    let power_w = values[0];
    let price = |(j, column): (usize, &usize)| solved[(j, 0)] * power_w / values[*column];
    Some(columns.iter().enumerate().map(price).collect())
}
