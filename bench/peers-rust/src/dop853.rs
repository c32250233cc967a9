//! Explicit Runge-Kutta methods of the crate `differential-equations`.

use crate::{Outcome, plant::Plant};
use differential_equations::prelude::*;
use std::cell::Cell;

struct Counted<'a, const M: usize> {
    plant: &'a Plant<M>,
    evaluations: Cell<u64>,
}

impl<const M: usize, const N: usize> ODE<f64, [f64; N]> for Counted<'_, M> {
    fn diff(&self, t: f64, y: &[f64; N], dydt: &mut [f64; N]) {
        self.evaluations.set(self.evaluations.get() + 1);
        self.plant.rate(t, y, dydt);
    }
}

/// Marches with DOP853 to relative tolerance `tolerance` and absolute tolerance `absolute`.
pub fn march<const M: usize, const N: usize>(
    plant: &Plant<M>,
    tolerance: f64,
    absolute: f64,
) -> Result<Outcome, String> {
    let system = Counted {
        plant,
        evaluations: Cell::new(0),
    };
    let middle_s = plant.duration_s - plant.average_over_s;
    let mut y = [0.0; N];
    for (from, to) in [(0.0, middle_s), (middle_s, plant.duration_s)] {
        y[2 * M + 1] = 0.0;
        let method = ExplicitRungeKutta::dop853()
            .rtol(tolerance)
            .atol(absolute)
            .max_steps(usize::MAX);
        let solution = IVP::ode(&system, from, to, y)
            .method(method)
            .t_eval([to])
            .solve()
            .map_err(|e| format!("{e:?}"))?;
        y = *solution.y.last().ok_or("no state at the end")?;
    }
    Ok(Outcome {
        mean_power_w: y[2 * M + 1] / plant.average_over_s,
        evaluations: system.evaluations.get(),
    })
}
