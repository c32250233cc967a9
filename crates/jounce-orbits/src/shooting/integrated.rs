//! Period integrated without its derivative.

use super::cycle_s;
use super::period_record::PeriodRecord;
use crate::{OrbitError, ParametricModel, Shooting, ShootingEvaluation};
use jounce_dynamics::{Integrator, Kernel, SensitivityError};

impl<H: ParametricModel> Shooting<'_, H> {
    /// Integrates the period of a harvester from `u`, without its derivative.
    ///
    /// # Errors
    /// The drives have no common period, or the integration fails.
    pub fn integrated(
        &self,
        kernel: Kernel,
        unknown: &[f64],
    ) -> Result<ShootingEvaluation, OrbitError<H::Error>> {
        let plant = &kernel.plant;
        let cycle_s = cycle_s(plant)?;
        let period_s = cycle_s * f64::from(self.cycles);
        let mut y = plant.from_physical(&self.physical(unknown), 0.0);
        let mut record = PeriodRecord::new(plant, unknown.to_vec());
        for _ in 0..self.cycles {
            let mut integrator = Integrator::new(&kernel, &y, 0.0, self.tolerance)
                .map_err(SensitivityError::Integration)?;
            integrator.start_record();
            integrator
                .advance_to(cycle_s)
                .map_err(SensitivityError::Integration)?;
            record.add_delivered(integrator.energies().delivered_per_element_j(), period_s);
            record.add_contacts(&integrator.statistics());
            y = integrator.state();
            let unknown = self.unknown(&plant.to_physical(&y, 0.0));
            record.strobe_states.push(unknown);
            record.trajectories.push(integrator.take_record());
        }
        let residual = record
            .end()
            .iter()
            .zip(unknown)
            .map(|(end, start)| end - start)
            .collect();
        Ok(self.evaluation(kernel, record, residual, period_s))
    }
}
