//! Periodic motion that sticks to a rigid stop in every period.
//!
//! Where a point comes to rest, the derivative of the flow loses rank. The end of an infinite
//! sequence of impacts leaves no derivative that an integration could propagate. Such an orbit is
//! the motion that an integration has settled on.

use super::cycle_s;
use crate::{Orbit, OrbitError, ParametricModel, Shooting};
use jounce_dynamics::{ContactStatistics, Integrator, Kernel, SensitivityError};
use jounce_linalg::norm;

impl<H: ParametricModel> Shooting<'_, H> {
    /// Returns the periodic orbit through a physical state, integrated without its derivative. It
    /// has no multipliers, and its error estimate is the closure error relative to its size.
    ///
    /// # Errors
    /// The harvester cannot be built, its drives have no common period, or the integration fails.
    pub fn integrated_orbit(
        &self,
        physical: &[f64],
        parameter: f64,
    ) -> Result<Orbit, OrbitError<H::Error>> {
        let kernel = self
            .family
            .at(parameter)
            .map_err(OrbitError::Harvester)?
            .kernel;
        let y = kernel.plant.from_physical(physical, 0.0);
        let period_s = cycle_s(&kernel.plant)? * f64::from(self.cycles);
        let statistics = self.settled_statistics(&kernel, &y, period_s)?;
        let mut evaluation = self.integrated(kernel, &self.unknown(physical))?;
        evaluation.contacts = statistics.contacts;
        evaluation.max_penetration_m = statistics.max_penetration_m;
        evaluation.max_contact_force_n = statistics.max_force_n;
        evaluation.max_impact_velocity_m_s = statistics.max_impact_velocity_m_s;
        let open = norm(&evaluation.residual);
        let mut orbit = evaluation.as_orbit(Vec::new());
        orbit.error_estimate = open / orbit.size().max(f64::MIN_POSITIVE);
        Ok(orbit)
    }

    /// Returns the contacts of the second of two periods. An integration that starts at rest may
    /// impact once by roundoff; its continuation does not.
    fn settled_statistics(
        &self,
        kernel: &Kernel,
        y: &[f64],
        period_s: f64,
    ) -> Result<ContactStatistics, SensitivityError> {
        let mut integrator = Integrator::new(kernel, y, 0.0, self.tolerance)?;
        integrator.advance_to(period_s)?;
        integrator.reset_statistics();
        integrator.advance_to(2.0 * period_s)?;
        Ok(integrator.statistics())
    }
}
