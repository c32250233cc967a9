//! Limits of patches that periodic orbits exceed.

use super::{AnalysisError, Branch, Parameter};
use crate::run::{ExceededLimit, Limits, RunError};
use jounce_dynamics::{IntegrationError, Integrator, Kernel};
use jounce_orbits::{Orbit, ParametricModel, Shooting};
use rayon::prelude::*;

/// Returns the limits exceeded in an integration of some drive cycles from a physical state at time
/// 0.
///
/// # Errors
/// The integration fails.
pub fn exceeded_over_cycles(
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
    let length_s = f64::from(cycles) * cycle_s;
    integrator.advance_to(length_s)?;
    Ok(limits.exceeded(kernel, &integrator.take_record(), length_s))
}

/// Returns the limits that an orbit exceeds over its period.
///
/// # Errors
/// The integration fails.
pub fn exceeded_by_orbit<H: ParametricModel>(
    limits: &Limits,
    (harvester, kernel): (&H, &Kernel),
    orbit: &Orbit,
    tolerance: f64,
) -> Result<Vec<ExceededLimit>, IntegrationError> {
    let physical =
        Shooting::new(harvester, kernel, orbit.period_cycles, tolerance).physical(orbit.start());
    exceeded_over_cycles(limits, kernel, &physical, orbit.period_cycles, tolerance)
}

impl Branch {
    /// Returns for each point the limits that it exceeds over its period.
    ///
    /// # Errors
    /// A point cannot be integrated.
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
            exceeded_by_orbit(limits, (parameter, &kernel), &point.orbit, tolerance)
                .map_err(|error| RunError::from(error).into())
        };
        self.points.par_iter().map(of_point).collect()
    }
}
