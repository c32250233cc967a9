//! The methods of the crate `diffsol`: variable-order BDF, TR-BDF2, ESDIRK34, and its explicit TSIT45.

use crate::{Outcome, plant::Plant};
use diffsol::{
    NalgebraLU, NalgebraMat, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason,
};
use std::cell::Cell;

type Lu = NalgebraLU<f64>;

/// Marches with the named method to relative tolerance `tolerance` and absolute tolerance `absolute`.
pub fn march<const M: usize>(
    plant: &Plant<M>,
    method: &str,
    tolerance: f64,
    absolute: f64,
) -> Result<Outcome, String> {
    let evaluations = Cell::new(0);
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol(vec![absolute; 2 * M + 2])
        .rhs_implicit(
            |y, _p, t, dy| {
                evaluations.set(evaluations.get() + 1);
                plant.rate(t, y, dy);
            },
            |y, _p, _t, x, dy| plant.rate_slope(y, x, dy),
        )
        .init(|_p, _t, y| y.fill(0.0), 2 * M + 2)
        .build()
        .map_err(text)?;
    let window = (plant.duration_s - plant.average_over_s, plant.duration_s);
    let energy_j = match method {
        "bdf" => energy_between(&mut problem.bdf::<Lu>().map_err(text)?, window, 2 * M + 1),
        "tr-bdf2" => energy_between(
            &mut problem.tr_bdf2::<Lu>().map_err(text)?,
            window,
            2 * M + 1,
        ),
        "esdirk34" => energy_between(
            &mut problem.esdirk34::<Lu>().map_err(text)?,
            window,
            2 * M + 1,
        ),
        "tsit45" => energy_between(&mut problem.tsit45().map_err(text)?, window, 2 * M + 1),
        other => Err(format!("unknown method '{other}'")),
    }?;
    Ok(Outcome {
        mean_power_w: energy_j / plant.average_over_s,
        evaluations: evaluations.get(),
    })
}

fn energy_between<'a, E, S>(
    solver: &mut S,
    (from_s, to_s): (f64, f64),
    index: usize,
) -> Result<f64, String>
where
    E: OdeEquations<T = f64, V = diffsol::NalgebraVec<f64>> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    let mut energies_j = [0.0; 2];
    for (energy_j, stop_s) in energies_j.iter_mut().zip([from_s, to_s]) {
        solver.set_stop_time(stop_s).map_err(text)?;
        while !matches!(
            solver.step().map_err(text)?,
            OdeSolverStopReason::TstopReached
        ) {}
        *energy_j = solver.state().y[index];
    }
    Ok(energies_j[1] - energies_j[0])
}

fn text(error: diffsol::error::DiffsolError) -> String {
    error.to_string()
}
