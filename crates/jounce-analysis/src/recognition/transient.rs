//! Motion integrated drive cycle by drive cycle.

use super::return_times::ReturnTimes;
use super::weighted_average::half_difference;
use jounce_dynamics::{IntegrationError, Integrator, Kernel};
use jounce_linalg::norm;

/// Drive cycles after which the integration restarts at time 0, so that the phase of a drive loses
/// no digits over a long run.
const RESTART_CYCLES: u32 = 256;

/// Difference of two weighted averages, relative to the deviation of the samples, below which a
/// motion is quasi-periodic. For chaos the difference scatters like the inverse square root of the
/// number of samples, 1e-2 for all that are used: one in a thousand is below the limit by chance,
/// so two quantities must be.
const CONVERGED_DIFFERENCE: f64 = 1e-5;

/// Motion from a start.
pub struct Transient<'k> {
    kernel: &'k Kernel,
    integrator: Integrator<'k>,
    cycle_s: f64,
    scale: Vec<f64>,
    /// Drive cycles so far.
    pub cycles: u32,
    /// Cost of searches for orbits so far, drive cycles.
    pub search_cost_cycles: u32,
    /// Drive cycles since the last restart.
    since: u32,
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// Energy delivered since the last restart, J.
    delivered_j: f64,
    /// Energy delivered in each drive cycle after the first restart, J: few starts take longer, and
    /// reading the energies has a cost.
    energies_j: Vec<f64>,
    /// Length of the state (energy coordinates) at the end of the same cycles.
    lengths: Vec<f64>,
    /// States at the start of the last drive cycles, energy coordinates.
    pub returns: ReturnTimes,
    /// Present state.
    pub state: Vec<f64>,
}

impl<'k> Transient<'k> {
    /// Starts from a physical state; `scale` converts physical states to energy coordinates.
    pub fn from(
        kernel: &'k Kernel,
        physical: &[f64],
        (scale, cycle_s): (&[f64], f64),
        (tolerance, longest): (f64, u32),
    ) -> Result<Self, IntegrationError> {
        let integrator = Integrator::new(
            kernel,
            &kernel.plant.from_physical(physical, 0.0),
            0.0,
            tolerance,
        )?;
        Ok(Self {
            kernel,
            integrator,
            cycle_s,
            scale: scale.to_vec(),
            cycles: 0,
            search_cost_cycles: 0,
            since: 0,
            tolerance,
            delivered_j: 0.0,
            energies_j: Vec::new(),
            lengths: Vec::new(),
            returns: ReturnTimes::up_to(longest),
            state: Vec::new(),
        })
    }

    /// Integrates a drive cycle.
    pub fn advance(&mut self) -> Result<(), IntegrationError> {
        if self.since == RESTART_CYCLES {
            self.restart(self.tolerance)?;
        }
        self.since += 1;
        self.cycles += 1;
        self.integrator
            .advance_to(f64::from(self.since) * self.cycle_s)?;
        self.state = self
            .physical()
            .iter()
            .zip(&self.scale)
            .map(|(x, w)| x * w)
            .collect();
        if self.cycles > RESTART_CYCLES {
            let delivered_j = self.integrator.energies().delivered_j();
            self.energies_j.push(delivered_j - self.delivered_j);
            self.delivered_j = delivered_j;
            self.lengths.push(norm(&self.state));
        }
        self.returns.push(self.state.clone());
        Ok(())
    }

    /// Continues at another tolerance.
    pub fn restart(&mut self, tolerance: f64) -> Result<(), IntegrationError> {
        self.integrator = Integrator::new(self.kernel, &self.integrator.state(), 0.0, tolerance)?;
        (self.since, self.tolerance) = (0, tolerance);
        self.delivered_j = 0.0;
        Ok(())
    }

    /// Returns the state in block coordinates.
    pub fn block_state(&self) -> Vec<f64> {
        self.integrator.state()
    }

    /// Returns the physical state.
    pub fn physical(&self) -> Vec<f64> {
        self.kernel.plant.to_physical(&self.integrator.state(), 0.0)
    }

    /// Returns the mean power, W, over the second half of the cycles after the first restart, or
    /// over all cycles before it.
    pub fn mean_power_w(&self) -> f64 {
        let late = &self.energies_j[self.energies_j.len() / 2..];
        match late.len() {
            0 => self.integrator.energies().delivered_j() / self.integrator.time_s(),
            count => late.iter().sum::<f64>() / (count as f64 * self.cycle_s),
        }
    }

    /// True when the averages of the power and of the length of the state over the second half of the
    /// cycles have converged as for a quasi-periodic motion.
    pub fn is_quasi_periodic(&self) -> bool {
        [&self.energies_j, &self.lengths].iter().all(|samples| {
            half_difference(&samples[samples.len() / 2..])
                .is_some_and(|difference| difference < CONVERGED_DIFFERENCE)
        })
    }
}
