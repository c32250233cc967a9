//! Periodic motion that sticks to a rigid stop in every period.
//!
//! Where a point comes to rest, the derivative of the flow loses rank. The end of an infinite
//! sequence of impacts leaves no derivative that an integration could propagate. Such an orbit is
//! the motion that an integration has settled on.

use crate::{Orbit, OrbitError, ParametricModel, Shooting, ShootingEvaluation};
use faer::{ColRef, Mat};
use jounce_dynamics::{Integrator, SensitivityError};
use std::sync::OnceLock;

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
            .harvester
            .at(parameter)
            .map_err(OrbitError::Harvester)?
            .kernel;
        let plant = &kernel.plant;
        let Some(cycle_s) = plant.period_s() else {
            return Err(OrbitError::Frequencies {
                frequencies: plant.tones.len(),
            });
        };
        let period_s = cycle_s * f64::from(self.cycles);
        let mut y = plant.from_physical(physical, 0.0);
        // An integration that starts at rest may impact once by roundoff; its continuation does
        // not.
        let mut cycle_integrator = Integrator::new(&kernel, &y, 0.0, self.tolerance)
            .map_err(SensitivityError::Integration)?;
        cycle_integrator
            .advance_to(period_s)
            .map_err(SensitivityError::Integration)?;
        cycle_integrator.reset_statistics();
        cycle_integrator
            .advance_to(2.0 * period_s)
            .map_err(SensitivityError::Integration)?;
        let statistics = cycle_integrator.statistics();
        let (mut strobe_states, mut trajectories) = (vec![self.unknown(physical)], Vec::new());
        let mut loads_w = vec![0.0; plant.system.loads.len() + plant.system.bridges.len()];
        for _ in 0..self.cycles {
            let mut integrator = Integrator::new(&kernel, &y, 0.0, self.tolerance)
                .map_err(SensitivityError::Integration)?;
            integrator.start_record();
            integrator
                .advance_to(cycle_s)
                .map_err(SensitivityError::Integration)?;
            let energies = integrator.energies();
            let rectified = energies
                .rectified
                .iter()
                .map(|energy| energy.load_j + energy.battery_j);
            let delivered_j = energies.loads_j.iter().copied().chain(rectified);
            loads_w
                .iter_mut()
                .zip(delivered_j)
                .for_each(|(sum, j)| *sum += j / period_s);
            y = integrator.state();
            strobe_states.push(self.unknown(&plant.to_physical(&y, 0.0)));
            trajectories.push(integrator.take_record());
        }
        let residual: Vec<f64> = strobe_states[strobe_states.len() - 1]
            .iter()
            .zip(&strobe_states[0])
            .map(|(end, start)| end - start)
            .collect();
        let open = ColRef::from_slice(&residual).norm_l2();
        let evaluation = ShootingEvaluation {
            kernel,
            strobe_states,
            residual,
            block_map: Mat::new(),
            by_parameter: Vec::new(),
            scale: self.scale.clone(),
            map: OnceLock::new(),
            equations: OnceLock::new(),
            period_s,
            keeps_charge: false,
            trajectories,
            contacts: statistics.contacts,
            max_penetration_m: statistics.max_penetration_m,
            loads_w,
            tolerance: self.tolerance,
        };
        let mut orbit = evaluation.as_orbit(Vec::new());
        orbit.error_estimate = open / orbit.size().max(f64::MIN_POSITIVE);
        Ok(orbit)
    }
}
