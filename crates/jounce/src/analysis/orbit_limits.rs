//! What periodic orbits do to patches, against what those bear.

use super::{AnalysisError, Branch, Parameter};
use crate::integrate::{IntegrationError, Integrator, Kernel};
use crate::orbit::{Orbit, ParametricModel, Shooting};
use crate::run::{ExceededLimit, Limits, RunError};
use rayon::prelude::*;

/// The limits that a march of some drive cycles passes, from a physical state at time 0.
///
/// # Errors
/// A march that fails.
pub fn passed_over(
    limits: &Limits,
    kernel: &Kernel,
    physical: &[f64],
    cycles: u32,
    tolerance: f64,
) -> Result<Vec<ExceededLimit>, IntegrationError> {
    let Some(cycle_s) = kernel.plant.period_s().filter(|_| !limits.is_empty()) else {
        return Ok(Vec::new());
    };
    let mut integrator = Integrator::new(
        kernel,
        &kernel.plant.from_physical(physical, 0.0),
        0.0,
        tolerance,
    )?;
    integrator.start_record();
    integrator.advance_to(f64::from(cycles) * cycle_s)?;
    Ok(limits.exceeded(kernel, &integrator.take_record()))
}

/// The limits that an orbit passes over its period.
///
/// # Errors
/// A march that fails.
pub fn passed_by_orbit<H: ParametricModel>(
    limits: &Limits,
    (harvester, kernel): (&H, &Kernel),
    orbit: &Orbit,
    tolerance: f64,
) -> Result<Vec<ExceededLimit>, IntegrationError> {
    let physical =
        Shooting::new(harvester, kernel, orbit.period_cycles, tolerance).physical(orbit.start());
    passed_over(limits, kernel, &physical, orbit.period_cycles, tolerance)
}

impl Branch {
    /// The limits that each point passes over its period, point by point.
    ///
    /// # Errors
    /// A point that cannot be marched.
    pub fn exceeded(
        &self,
        parameter: &Parameter<'_>,
        limits: &Limits,
        tolerance: f64,
    ) -> Result<Vec<Vec<ExceededLimit>>, AnalysisError> {
        if limits.is_empty() {
            return Ok(vec![Vec::new(); self.points.len()]);
        }
        let of_point = |point: &super::BranchPoint| {
            let kernel = parameter.at(point.parameter)?.kernel;
            passed_by_orbit(limits, (parameter, &kernel), &point.orbit, tolerance)
                .map_err(|error| RunError::from(error).into())
        };
        self.points.par_iter().map(of_point).collect()
    }
}
