//! Exact derivatives of the results of an orbit.
//!
//! The derivative of a peak is the derivative at the instant of the peak, because the quantity is
//! stationary there.

use super::plant_derivatives::WeightedSystems;
use super::{Derivative, Failure};
use crate::{KeyLine, Model};
use jounce_model::plant::{Electrical, PlantDerivative, System};
use jounce_orbits::{
    InstantSensitivity, OrbitInstant, OrbitQuantity, OrbitSensitivity, Shooting, ShootingEvaluation,
};

/// Step along the derivative of a state, relative to the state, in the slope of a principal strain.
const STATE_STEP: f64 = 1e-6;

/// A key whose plant has a derivative.
pub struct ExactKey {
    /// Systems at changed values of the key.
    pub systems: WeightedSystems,
    /// Derivative of the plant.
    pub plant: PlantDerivative,
}

/// Returns the derivatives of the results, for each key.
pub fn derivatives(
    base: &Model,
    shooting: &Shooting<'_, KeyLine<'_>>,
    evaluation: &ShootingEvaluation,
    keys: &[ExactKey],
    quantities: &[OrbitQuantity],
) -> Result<Vec<Vec<f64>>, Failure> {
    let peaks: Vec<Option<OrbitInstant>> = quantities
        .iter()
        .map(|quantity| match quantity {
            OrbitQuantity::MeanPower => None,
            _ => Some(quantity.peak(evaluation).instant),
        })
        .collect();
    let mut instants: Vec<OrbitInstant> = peaks.iter().flatten().copied().collect();
    instants.sort_by(|a, b| a.cycle.cmp(&b.cycle).then(a.time_s.total_cmp(&b.time_s)));
    let plants: Vec<PlantDerivative> = keys.iter().map(|key| key.plant.clone()).collect();
    let found = shooting.sensitivity(evaluation, &plants, &instants)?;
    let place = |instant: &OrbitInstant| instants.iter().position(|one| one == instant);
    let at: Vec<Option<usize>> = peaks
        .iter()
        .map(|instant| instant.as_ref().and_then(place))
        .collect();
    let of_key = |(k, key): (usize, &ExactKey)| {
        let pairs = quantities.iter().zip(&at);
        pairs
            .map(|(quantity, at)| of_quantity(base, *quantity, &found, *at, (k, key)))
            .collect()
    };
    Ok(keys.iter().enumerate().map(of_key).collect())
}

/// Returns the derivative of a quantity by a key, given the index of its instant.
fn of_quantity(
    base: &Model,
    quantity: OrbitQuantity,
    found: &OrbitSensitivity,
    at: Option<usize>,
    (k, key): (usize, &ExactKey),
) -> f64 {
    let Some(instant) = at.map(|index| &found.instants[index]) else {
        return found.mean_power_w[k];
    };
    match quantity {
        OrbitQuantity::MeanPower => found.mean_power_w[k],
        OrbitQuantity::ContactForce(stop) => instant.forces_by[k][stop],
        OrbitQuantity::Displacement(stop) => {
            instant.displacements_m[stop].signum() * instant.displacements_by[k][stop]
        }
        OrbitQuantity::Voltage(_) | OrbitQuantity::Strain(_) => {
            of_state(&base.kernel.plant.system, quantity, instant, (k, key))
        }
    }
}

/// Returns the derivative of a function of the state.
fn of_state(
    system: &System,
    quantity: OrbitQuantity,
    instant: &InstantSensitivity,
    (k, key): (usize, &ExactKey),
) -> f64 {
    let (state, by) = (&instant.state, &instant.state_by[k]);
    let place = largest_place(system, quantity, state);
    let value = |system: &System, state: &[f64]| value(system, quantity, place, state);
    let size = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>().sqrt();
    let step = STATE_STEP * size(state) / size(by).max(f64::MIN_POSITIVE);
    let moved =
        |step: f64| -> Vec<f64> { state.iter().zip(by).map(|(x, by)| x + step * by).collect() };
    let along = (value(system, &moved(step)) - value(system, &moved(-step))) / (2.0 * step);
    let explicit = key.systems.derivative(|system| value(system, state));
    value(system, state).signum() * (along + explicit)
}

/// Returns the number of the place of a patch with the largest strain; 0 for other quantities.
fn largest_place(system: &System, quantity: OrbitQuantity, state: &[f64]) -> usize {
    let OrbitQuantity::Strain(patch) = quantity else {
        return 0;
    };
    let places = system
        .modes
        .patch
        .values()
        .nth(patch)
        .map_or(0, |patch| patch.strain.len());
    let size = |place: &usize| value(system, quantity, *place, state).abs();
    (0..places)
        .max_by(|a, b| size(a).total_cmp(&size(b)))
        .unwrap_or(0)
}

/// Returns a voltage, V, or the strain at a place, with its sign.
fn value(system: &System, quantity: OrbitQuantity, place: usize, state: &[f64]) -> f64 {
    match quantity {
        OrbitQuantity::Voltage(patch) => {
            let nodes = &state[2 * system.modes.len()..];
            let parts = &Electrical::of(system).patch[patch];
            parts
                .iter()
                .map(|(node, factor)| factor * nodes[*node])
                .sum()
        }
        OrbitQuantity::Strain(patch) => {
            let patch = system.modes.patch.values().nth(patch);
            patch
                .and_then(|patch| patch.strain.get(place))
                .map_or(0.0, |place| place.at(state))
        }
        _ => f64::NAN,
    }
}

/// Returns the derivatives at two accuracies as values with errors.
pub fn with_errors(fine: Vec<f64>, coarse: &[f64]) -> Vec<Derivative> {
    let pairs = fine.into_iter().zip(coarse);
    pairs
        .map(|(value, other)| Derivative {
            value,
            error: (value - other).abs(),
        })
        .collect()
}
