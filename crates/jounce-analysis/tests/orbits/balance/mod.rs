//! Orbits by harmonic balance.

mod equations;
mod open_patch;
mod several_stops;
mod shooting;

use crate::harvesters::bench;
use jounce_continuation::{
    CorrectedPoint, Corrector, Linearization, Metric, Position, Problem, correct_at,
};
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::System;
use jounce_orbits::{BalanceEvaluation, HarmonicBalance, Orbit, OrbitMethod, ParametricModel};

const HERTZ: Hertz = Hertz {
    stiffness: 1000.0,
    exponent: 1.5,
};

const CORRECTOR: Corrector = Corrector {
    goal: 1e-10,
    most: 20,
};

fn norm(values: &mut dyn Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}

fn system(frequency_hz: f64, law: Law) -> System {
    let spec = bench().spec().unwrap();
    let mut system =
        System::assemble(&spec, jounce_model::structure::modes(&spec).unwrap()).unwrap();
    system.drives[0].frequency_hz = frequency_hz;
    system.stops[0].law = law;
    system
}

/// Distance of the first states of two orbits.
fn state_difference(one: &Orbit, other: &Orbit) -> f64 {
    norm(&mut one.start().iter().zip(other.start()).map(|(a, b)| a - b))
}

/// Corrects an orbit near a state, with as many harmonics as the accuracy needs.
fn refined<'h, H: ParametricModel>(
    mut method: HarmonicBalance<'h, H>,
    start: &[f64],
    parameter: f64,
) -> (HarmonicBalance<'h, H>, CorrectedPoint<BalanceEvaluation>) {
    loop {
        let position = Position {
            unknown: method.unknown_of(start, parameter).unwrap(),
            parameter,
        };
        let solution =
            correct_at(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
        match method
            .finer()
            .filter(|_| method.error_ratio(&solution.local, 0.8).unwrap() > 1.0)
        {
            Some(finer) => method = finer,
            None => break (method, solution),
        }
    }
}

/// Relative error of the change with the parameter in closed form against that of differences.
fn parameter_change_error<H: ParametricModel>(
    method: &HarmonicBalance<H>,
    unknown: &[f64],
    value: f64,
) -> f64 {
    let none = vec![0.0; unknown.len()];
    let local = method.at(unknown, value).unwrap();
    // At fixed parameter the bordered solution is `-R_u^-1 R_p`.
    let (along, _) = local.bordered(&none, 1.0, &none, 1.0).unwrap();
    let step = 1e-6 * value;
    let residual = |parameter: f64| method.at(unknown, parameter).unwrap().residual().to_vec();
    let change: Vec<f64> = residual(value + step)
        .iter()
        .zip(&residual(value - step))
        .map(|(a, b)| (b - a) / (2.0 * step))
        .collect();
    let (by_difference, _) = local.bordered(&none, 1.0, &change, 0.0).unwrap();
    norm(&mut along.iter().zip(&by_difference).map(|(a, b)| a - b))
        / norm(&mut along.iter().copied())
}
