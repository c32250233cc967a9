//! Derivatives of the place of a fold by keys of the spec.
//!
//! At a fold over the key `f` the derivative of the residual has a left null vector `l`,
//! `l dR/du = 0`. Along the curve of folds `l (R_f df + R_p dp) = 0`, so that
//!
//! ```text
//! df/dp = -(l . R_p) / (l . R_f)
//! ```
//!
//! Source: Kuznetsov, Elements of Applied Bifurcation Theory, section 10.3 (continuation of folds).

use super::{Derivative, DerivativeKey, Failure, ROUGH_TOLERANCE, TOLERANCE, prepared};
use crate::{AnalysisError, KeyLine, Model};
use jounce_linalg::{Mat, norm};
use jounce_model::plant::{PlantDerivative, product};
use jounce_orbits::{Orbit, OrbitError, Shooting, null_vector};
use rayon::prelude::*;

/// Returns the derivatives of the place of a fold over a key by other keys, each in the unit of the
/// first per unit of the other; `model` and `orbit` are those at the fold.
///
/// The error is the difference from an integration with a larger tolerance, plus the derivative times
/// the length of `l dR/du`, which is 0 at an exact fold.
///
/// # Errors
/// The derivative of the plant by a key is not known, or the integration fails.
pub fn fold_derivatives(
    model: &Model,
    orbit: &Orbit,
    over: DerivativeKey<'_>,
    keys: &[DerivativeKey<'_>],
) -> Result<Vec<Derivative>, Failure> {
    let line = KeyLine::at(model);
    let shooting = Shooting::new(&line, &model.kernel, orbit.period_cycles, TOLERANCE);
    let all: Vec<DerivativeKey<'_>> = std::iter::once(over).chain(keys.iter().copied()).collect();
    let plants = all.par_iter().map(|key| match prepared(model, *key)? {
        Some(exact) => Ok(exact.plant),
        None => Err(OrbitError::Harvester(AnalysisError::NoFoldDerivative {
            key: key.key.path().to_owned(),
        })),
    });
    let plants = plants.collect::<Result<Vec<_>, Failure>>()?;
    let (fine, open) = slopes(&shooting, orbit, &plants)?;
    let (coarse, _) = slopes(&shooting.with_tolerance(ROUGH_TOLERANCE), orbit, &plants)?;
    let pairs = fine.into_iter().zip(coarse);
    let derivative = |(value, coarse): (f64, f64)| Derivative {
        value,
        error: (value - coarse).abs() + open * value.abs(),
    };
    Ok(pairs.map(derivative).collect())
}

/// Returns the derivatives by the parameters after the first, over which the fold is, and the length
/// of `l dR/du`.
fn slopes(
    shooting: &Shooting<'_, KeyLine<'_>>,
    orbit: &Orbit,
    plants: &[PlantDerivative],
) -> Result<(Vec<f64>, f64), Failure> {
    let (evaluation, _) = shooting.shoot(orbit.start(), 0.0)?;
    let residuals = shooting.residual_derivatives(&evaluation, plants)?;
    let map = evaluation.map();
    let transposed = Mat::from_fn(map.nrows(), map.nrows(), |i, j| {
        map[(j, i)] - if i == j { 1.0 } else { 0.0 }
    });
    let left = null_vector(&transposed);
    let along =
        |residual: &Vec<f64>| -> f64 { left.iter().zip(residual).map(|(l, r)| l * r).sum() };
    let by_first = along(&residuals[0]);
    let slopes = residuals[1..]
        .iter()
        .map(|residual| -along(residual) / by_first);
    Ok((slopes.collect(), norm(&product(&transposed, &left))))
}
