//! Orbit near a shooting evaluation, and its estimated error.

use crate::{
    Orbit, OrbitError, ParametricModel, Shooting, ShootingEvaluation, cycle_s, displacement_peak_m,
};
use jounce_continuation::Linearization;
use jounce_dynamics::{Integrator, Kernel, SensitivityError};
use jounce_linalg::{c64, norm};
use jounce_model::plant::{Storage, System};

/// Fraction of the energy of the motion in a period above which the error of the power of rectified
/// circuits is relative to that power.
const MIN_ENERGY_SHARE: f64 = 1e-6;

impl<H: ParametricModel> Shooting<'_, H> {
    /// Returns the orbit of a shooting evaluation without its error estimate.
    pub(crate) fn orbit_of(
        &self,
        evaluation: &ShootingEvaluation,
    ) -> Result<Orbit, OrbitError<H::Error>> {
        let Some(basis) = evaluation.eigenbasis() else {
            return Err(OrbitError::Multipliers {
                frequency_hz: f64::from(self.cycles) / evaluation.period_s,
            });
        };
        Ok(evaluation.as_orbit(basis.multipliers.clone()))
    }

    /// Estimates the error of an orbit near a shooting evaluation at its parameter: the larger
    /// relative error of the state and of the mean power. The state error is the length of the next
    /// Newton step; the power error is the difference to the power integrated there.
    ///
    /// An integration defect over one period reaches the orbit multiplied by `(I - M)^-1`. The
    /// Newton step therefore also corrects a defect of the size of the tolerance.
    pub(crate) fn estimate(&self, evaluation: &ShootingEvaluation, orbit: &Orbit) -> f64 {
        let nearest = orbit
            .multipliers
            .iter()
            .map(|value| (*value - 1.0).norm())
            .fold(1.0, f64::min);
        let defect = evaluation.tolerance / nearest.max(f64::EPSILON);
        let Some(correction) = evaluation.correction() else {
            return f64::INFINITY;
        };
        let state = norm(&correction) / norm(&evaluation.strobe_states[0]).max(f64::MIN_POSITIVE);
        let corrected_start: Vec<f64> = evaluation.strobe_states[0]
            .iter()
            .zip(&correction)
            .map(|(u, d)| u + d)
            .collect();
        // Near a fold the correction can lead to a state that cannot be integrated: its length is
        // then the only estimate.
        let least_w = evaluation.least_power_w();
        let power = self
            .integrated_power_w(&evaluation.kernel, &corrected_start)
            .map_or(state, |exact_w| {
                (orbit.mean_power_w - exact_w).abs() / exact_w.abs().max(least_w)
            });
        defect + state.max(power)
    }

    /// Returns the mean power of all loads, W, over a period from a state, integrated without its
    /// derivative.
    ///
    /// # Errors
    /// The integration fails.
    pub fn mean_power_w(
        &self,
        unknown: &[f64],
        parameter: f64,
    ) -> Result<f64, OrbitError<H::Error>> {
        self.integrated_power_w(
            &self
                .family
                .at(parameter)
                .map_err(OrbitError::Harvester)?
                .kernel,
            unknown,
        )
    }

    fn integrated_power_w(
        &self,
        kernel: &Kernel,
        unknown: &[f64],
    ) -> Result<f64, OrbitError<H::Error>> {
        let cycle_s = cycle_s(&kernel.plant)?;
        let mut y = kernel.plant.from_physical(&self.physical(unknown), 0.0);
        let mut sum_j = 0.0;
        for _ in 0..self.cycles {
            let mut integrator = Integrator::new(kernel, &y, 0.0, self.tolerance)
                .map_err(SensitivityError::Integration)?;
            integrator
                .advance_to(cycle_s)
                .map_err(SensitivityError::Integration)?;
            sum_j += integrator.energies().delivered_j();
            y = integrator.state();
        }
        Ok(sum_j / (cycle_s * f64::from(self.cycles)))
    }
}

/// Returns the rms voltage at the first element that takes power, V; NaN without one.
fn voltage_rms_v(system: &System, power_w: f64) -> f64 {
    let across = |resistance_ohm: f64| (power_w * resistance_ohm).max(0.0).sqrt();
    match (
        system.loads.first(),
        system.bridges.first().map(|bridge| bridge.storage),
    ) {
        (Some(load), _) => across(load.resistance_ohm),
        (None, Some(Storage::Capacitor { load_ohm, .. })) => across(load_ohm),
        (None, Some(Storage::Battery { voltage_v })) => voltage_v,
        // A regulator has no periodic orbits.
        (None, Some(Storage::Regulated { .. }) | None) => f64::NAN,
    }
}

impl ShootingEvaluation {
    /// Returns the power below which the relative error of a power is not known, W. Diodes may pass
    /// arbitrarily little power: the error is relative to at least a small fraction of the energy
    /// of the motion.
    pub fn least_power_w(&self) -> f64 {
        if self.kernel.plant.system.bridges.is_empty() {
            f64::MIN_POSITIVE
        } else {
            MIN_ENERGY_SHARE * 0.5 * norm(&self.strobe_states[0]).powi(2) / self.period_s
        }
    }

    /// Returns the integrated period as an orbit with these multipliers.
    pub(super) fn as_orbit(&self, multipliers: Vec<c64>) -> Orbit {
        Orbit {
            period_cycles: self.trajectories.len() as u32,
            strobe_states: self.strobe_states.clone(),
            // An empty sum is -0.
            mean_power_w: self.loads_w.iter().sum::<f64>() + 0.0,
            voltage_rms_v: self.loads_w.first().map_or(f64::NAN, |power_w| {
                voltage_rms_v(&self.kernel.plant.system, *power_w)
            }),
            contacts: self.contacts,
            switches: self
                .trajectories
                .iter()
                .map(|trajectory| trajectory.changes().len() as u64)
                .sum(),
            max_penetration_m: self.max_penetration_m,
            max_contact_force_n: self.max_contact_force_n,
            max_impact_velocity_m_s: self.max_impact_velocity_m_s,
            displacement_peak_m: displacement_peak_m(self),
            multipliers,
            error_estimate: 0.0,
        }
    }

    /// Returns Newton's correction at a fixed parameter, of the residual and of an added defect of
    /// the size of the tolerance.
    fn correction(&self) -> Option<Vec<f64>> {
        let size = norm(&self.strobe_states[0]);
        let defect = self.tolerance * size / (self.residual.len() as f64).sqrt();
        let right: Vec<f64> = self
            .residual
            .iter()
            .map(|r| -r - defect.copysign(*r))
            .collect();
        let fixed = vec![0.0; right.len()];
        self.bordered(&fixed, 1.0, &right, 0.0)
            .map(|(change, _)| change)
    }
}
