//! Derivatives of the results of a periodic orbit with respect to keys of the spec.
//!
//! A key changes the coefficients of the equations; these changes follow from the coefficients at a
//! few values of the key ([`plant_derivatives`]). The derivatives of the motion are exact, for all
//! keys at once, at the cost of one more integration of the period ([`exact`]). Their error is
//! estimated by the difference from a second integration with a larger tolerance. With rectified
//! circuits, differences of integrations take their place ([`differences`]).

mod differences;
mod exact;
mod fold;
mod grazing;
mod plant_derivatives;

use super::{AnalysisError, KeyLine, Model};
use differences::Differences;
use exact::ExactKey;
pub use fold::fold_derivatives;
pub use grazing::{AcrossGrazing, NearestGrazing, nearest_grazing};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_model::plant::PlantError;
use jounce_orbits::{Orbit, OrbitError, OrbitQuantity, Shooting, ShootingEvaluation};
use jounce_spec::NumericKey;
use plant_derivatives::WeightedSystems;
use rayon::prelude::*;

/// Tolerance of the integrations.
const TOLERANCE: f64 = 1e-12;

/// Tolerance of derivatives that only guide a search, and of those that show the error of others.
const ROUGH_TOLERANCE: f64 = 1e-10;

/// Goal of Newton's method, relative to the tolerance of the integrations: near a fold the corrections
/// are larger than the residuals.
const GOAL_PER_TOLERANCE: f64 = 10.0;

/// Largest number of evaluations of Newton's method.
const MOST_CORRECTIONS: u32 = 6;

/// Derivative of a result with respect to a key, with its estimated error, in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Derivative {
    /// Value.
    pub value: f64,
    /// Estimated error.
    pub error: f64,
}

/// A key whose derivatives are wanted.
#[derive(Debug, Clone, Copy)]
pub struct DerivativeKey<'k> {
    /// The key.
    pub key: &'k NumericKey,
    /// Size of a change over which results change noticeably, SI: the value, or the width of its
    /// range.
    pub scale: f64,
}

/// Accuracy of derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DerivativeAccuracy {
    /// Without an estimate of the error: for a search.
    Rough,
    /// With an estimate of the error.
    Estimated,
}

/// Results of an orbit with their derivatives.
#[derive(Debug)]
pub struct OrbitDerivatives {
    /// Results, SI.
    pub values: Vec<f64>,
    /// Derivatives of the results, per key; an error where a model with a changed key cannot be
    /// built or integrated.
    pub by_key: Vec<Result<Vec<Derivative>, OrbitError<AnalysisError>>>,
}

type Failure = OrbitError<AnalysisError>;

/// Derivative of the plant by a key, or `None` where it is not known in closed form.
type Prepared = Result<Option<ExactKey>, Failure>;

/// Returns results of an orbit of a model, and their derivatives.
///
/// # Errors
/// The integration of the orbit fails.
pub fn orbit_derivatives(
    base: &Model,
    orbit: &Orbit,
    keys: &[DerivativeKey<'_>],
    quantities: &[OrbitQuantity],
    accuracy: DerivativeAccuracy,
) -> Result<OrbitDerivatives, Failure> {
    let line = KeyLine::at(base);
    let tolerance = match accuracy {
        DerivativeAccuracy::Rough => ROUGH_TOLERANCE,
        DerivativeAccuracy::Estimated => TOLERANCE,
    };
    let shooting = Shooting::new(&line, &base.kernel, orbit.period_cycles, tolerance);
    let evaluation = corrected(&shooting, orbit.start())?;
    let differences = Differences {
        base,
        shooting: &shooting,
        evaluation: &evaluation,
        quantities,
        accuracy,
    };
    let prepared: Vec<Prepared> = keys.par_iter().map(|key| prepared(base, *key)).collect();
    let mut exact = Vec::new();
    let places: Vec<Result<Option<usize>, Failure>> = prepared
        .into_iter()
        .map(|one| {
            Ok(one?.map(|key| {
                exact.push(key);
                exact.len() - 1
            }))
        })
        .collect();
    let rows = rows(&differences, orbit, &exact)?;
    let of_key = |(key, place): (&DerivativeKey<'_>, Result<Option<usize>, Failure>)| match place? {
        Some(index) => Ok(rows[index].clone()),
        None => differences.derivatives(*key),
    };
    Ok(OrbitDerivatives {
        values: differences.values(&evaluation),
        by_key: keys.par_iter().zip(places).map(of_key).collect(),
    })
}

/// Integrates an orbit, corrected to the tolerance of the integration where Newton converges.
fn corrected(
    shooting: &Shooting<'_, KeyLine<'_>>,
    start: &[f64],
) -> Result<ShootingEvaluation, Failure> {
    let position = Position {
        unknown: start.to_vec(),
        parameter: 0.0,
    };
    let corrector = Corrector {
        goal: GOAL_PER_TOLERANCE * shooting.tolerance,
        most: MOST_CORRECTIONS,
    };
    match correct_at(shooting, &corrector, &Metric::at(&position, 1.0), position) {
        Ok(found) => Ok(found.local),
        Err(_) => Ok(shooting.shoot(start, 0.0)?.0),
    }
}

/// Returns the derivative of the plant by a key.
fn prepared(base: &Model, key: DerivativeKey<'_>) -> Prepared {
    let of = || -> Result<Option<ExactKey>, AnalysisError> {
        let systems = WeightedSystems::of(base, key.key, key.scale)?;
        match systems.plant_derivative(base) {
            Ok(plant) => Ok(Some(ExactKey { systems, plant })),
            Err(PlantError::NoDerivative { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    };
    of().map_err(OrbitError::Harvester)
}

/// Returns the derivatives of the results by the keys whose plants have one.
fn rows(
    differences: &Differences<'_, '_>,
    orbit: &Orbit,
    keys: &[ExactKey],
) -> Result<Vec<Vec<Derivative>>, Failure> {
    if keys.is_empty() {
        return Ok(Vec::new());
    }
    let Differences {
        base,
        shooting,
        evaluation,
        quantities,
        accuracy,
    } = *differences;
    let fine = exact::derivatives(base, shooting, evaluation, keys, quantities)?;
    let coarse = match accuracy {
        DerivativeAccuracy::Rough => fine.clone(),
        DerivativeAccuracy::Estimated => {
            let coarse = shooting.with_tolerance(ROUGH_TOLERANCE);
            let evaluation = corrected(&coarse, orbit.start())?;
            exact::derivatives(base, &coarse, &evaluation, keys, quantities)?
        }
    };
    let pairs = fine.into_iter().zip(&coarse);
    Ok(pairs
        .map(|(fine, coarse)| exact::with_errors(fine, coarse))
        .collect())
}
