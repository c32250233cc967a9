//! What periodic orbits do to patches, against what those bear.

use super::{Branch, Parameter, StudyError};
use crate::march::{Kernel, MarchError, Marcher};
use crate::orbit::{Harvester, Orbit, Shooting};
use crate::run::{Exceeded, Limits, RunError};
use rayon::prelude::*;

/// The limits that a march of some drive cycles passes, from a physical state at time 0.
///
/// # Errors
/// A march that fails.
pub fn passed_over(limits: &Limits, kernel: &Kernel, physical: &[f64], cycles: u32, tolerance: f64) -> Result<Vec<Exceeded>, MarchError> {
    let Some(cycle_s) = kernel.plant.period_s().filter(|_| !limits.is_empty()) else { return Ok(Vec::new()) };
    let mut marcher = Marcher::new(kernel, &kernel.plant.from_physical(physical, 0.0), 0.0, tolerance)?;
    marcher.start_record();
    marcher.advance_to(f64::from(cycles) * cycle_s)?;
    Ok(limits.exceeded(kernel, &marcher.take_record()))
}

/// The limits that an orbit passes over its period.
///
/// # Errors
/// A march that fails.
pub fn passed_by_orbit<H: Harvester>(
    limits: &Limits,
    (harvester, kernel): (&H, &Kernel),
    orbit: &Orbit,
    tolerance: f64,
) -> Result<Vec<Exceeded>, MarchError> {
    let physical = Shooting::new(harvester, kernel, orbit.period_cycles, tolerance).physical(orbit.start());
    passed_over(limits, kernel, &physical, orbit.period_cycles, tolerance)
}

impl Branch {
    /// The limits that each point passes over its period, point by point.
    ///
    /// # Errors
    /// A point that cannot be marched.
    pub fn exceeded(&self, parameter: &Parameter<'_>, limits: &Limits, tolerance: f64) -> Result<Vec<Vec<Exceeded>>, StudyError> {
        if limits.is_empty() {
            return Ok(vec![Vec::new(); self.points.len()]);
        }
        let of_point = |point: &super::BranchPoint| {
            let kernel = parameter.at(point.parameter)?.kernel;
            passed_by_orbit(limits, (parameter, &kernel), &point.orbit, tolerance).map_err(|error| RunError::from(error).into())
        };
        self.points.par_iter().map(of_point).collect()
    }
}
