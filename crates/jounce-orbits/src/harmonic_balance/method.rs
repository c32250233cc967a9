//! Orbits by harmonic balance.

use super::contact::grid;
use super::evaluation::BalanceEvaluation;
use super::fourier_grid::FourierGrid;
use super::motion::real;
use super::quadrature::QuadratureRules;
use super::transfer_function::{TransferFunction, moves_without_end};
use crate::{
    ModelInstance, Orbit, OrbitError, OrbitMethod, ParametricModel, Shooting, ShootingEvaluation,
};
use jounce_continuation::{Linearization, Position, Problem};
use jounce_dynamics::{IntegrationError, Kernel, SensitivityError};
use jounce_linalg::c64;
use jounce_model::contact::Law;
use std::sync::Arc;

/// Largest number of harmonics of a drive cycle.
const MAX_HARMONICS: usize = 1024;

/// Smallest number of harmonics of a drive cycle after a reduction.
const MIN_HARMONICS: usize = 16;

/// Ratio of the allowed errors of the state and the mean power: most of the state error is in fast
/// modes without power.
const STATE_ERROR_FACTOR: f64 = 30.0;

/// Orbits of a harvester by harmonic balance.
#[derive(Debug)]
pub struct HarmonicBalance<'h, H> {
    /// Shooting problem of these harvesters, for stability and for the error.
    pub shooting: Shooting<'h, H>,
    /// Harmonics of the period.
    pub harmonics: usize,
    /// Relative error of the mean power above which the number of harmonics is too small.
    pub accuracy: f64,
    /// Number of stops; one without effect where the harvester has none.
    stops: usize,
    grid: FourierGrid,
    rules: Arc<QuadratureRules>,
}

impl<'h, H: ParametricModel> HarmonicBalance<'h, H> {
    /// Creates the problem with an initial number of harmonics of the period.
    ///
    /// # Errors
    /// [`OrbitError::Rectified`], [`OrbitError::Impulsive`] for a rigid stop, [`OrbitError::Free`].
    pub fn new(
        shooting: Shooting<'h, H>,
        kernel: &Kernel,
        harmonics: usize,
        accuracy: f64,
    ) -> Result<Self, OrbitError<H::Error>> {
        let stops = &kernel.plant.system.stops;
        if let Some(bridge) = kernel.plant.system.bridges.first() {
            return Err(OrbitError::Rectified {
                circuit: bridge.name.clone(),
            });
        }
        match stops.iter().find(|stop| matches!(stop.law, Law::Rigid(_))) {
            Some(stop) => Err(OrbitError::Impulsive {
                stop: stop.name.clone(),
            }),
            None if moves_without_end(&kernel.plant) => Err(OrbitError::Free),
            None => Ok(Self {
                shooting,
                harmonics,
                accuracy,
                stops: stops.len().max(1),
                grid: grid(harmonics),
                rules: Arc::default(),
            }),
        }
    }

    fn balance(
        &self,
        setting: ModelInstance,
        unknown: &[f64],
        parameter: f64,
    ) -> Result<BalanceEvaluation, OrbitError<H::Error>> {
        if setting.kernel.control.is_stopped() {
            return Err(OrbitError::Integration(SensitivityError::Integration(
                IntegrationError::Stopped { time_s: 0.0 },
            )));
        }
        match setting.kernel.plant.tones.len() {
            1 => Ok(BalanceEvaluation::new(
                setting.kernel,
                parameter,
                unknown,
                self.shooting.cycles,
                &self.grid,
                &self.rules,
            )),
            0 => Err(OrbitError::Frequencies { frequencies: 0 }),
            frequencies => Err(OrbitError::Summed { frequencies }),
        }
    }

    /// Returns this method with another number of harmonics.
    fn with(&self, harmonics: usize) -> Self {
        Self {
            shooting: self.shooting.with_tolerance(self.shooting.tolerance),
            harmonics,
            accuracy: self.accuracy,
            stops: self.stops,
            grid: grid(harmonics),
            rules: Arc::clone(&self.rules),
        }
    }

    /// Returns the larger of two errors: the error of the mean power relative to the accuracy, and
    /// the error of the state relative to `STATE_ERROR_FACTOR` times the accuracy.
    fn excess_of(
        &self,
        local: &BalanceEvaluation,
        parameter_scale: f64,
    ) -> Result<f64, OrbitError<H::Error>> {
        let evaluation = self.shot(local)?;
        let Some((across, length)) = evaluation.across(local.parameter, parameter_scale) else {
            return Ok(f64::INFINITY);
        };
        let state = length / (STATE_ERROR_FACTOR * self.accuracy);
        if state > 1.0 {
            return Ok(state);
        }
        let neighbour = Position {
            unknown: evaluation.strobe_states[0].clone(),
            parameter: local.parameter,
        }
        .offset_along(&across, 1.0);
        let exact_w = self
            .shooting
            .mean_power_w(&neighbour.unknown, neighbour.parameter)?;
        let difference_w = (self.loads_w(local).iter().sum::<f64>() - exact_w).abs();
        Ok(state.max(difference_w / (self.accuracy * exact_w.abs()).max(f64::MIN_POSITIVE)))
    }

    /// Returns the mean power of each load, W: `sum_n |V_n|^2 / R` over all harmonics of the
    /// voltage.
    fn loads_w(&self, local: &BalanceEvaluation) -> Vec<f64> {
        let plant = &local.kernel.plant;
        let cycles = self.shooting.cycles;
        (plant.system.loads.iter())
            .enumerate()
            .map(|(index, load)| {
                let row = plant.load_voltage_row(index);
                let mut voltage = vec![c64::new(0.0, 0.0); self.harmonics + 1];
                for (port, force) in plant.ports.iter().zip(&local.forces) {
                    let transfer = TransferFunction::new(
                        plant,
                        &row,
                        &port.force,
                        local.step_rad_s,
                        self.harmonics,
                    );
                    voltage
                        .iter_mut()
                        .zip(transfer.values.iter().zip(force))
                        .for_each(|(v, (g, f))| *v += g * f);
                }
                voltage[cycles as usize] += plant.steady_output(&row).iter().sum::<c64>();
                let square: f64 = voltage[1..].iter().map(|v| 0.5 * v.norm_sqr()).sum();
                (square + voltage[0].norm_sqr()) / load.resistance_ohm
            })
            .collect()
    }
}

impl<H: ParametricModel> Problem for HarmonicBalance<'_, H> {
    type Evaluation = BalanceEvaluation;
    type Error = OrbitError<H::Error>;

    fn at(&self, unknown: &[f64], parameter: f64) -> Result<BalanceEvaluation, Self::Error> {
        let mut setting = self
            .shooting
            .family
            .at(parameter)
            .map_err(OrbitError::Harvester)?;
        let change = setting.change.take();
        let mut local = self.balance(setting, unknown, parameter)?;
        if let Some(change) = change {
            local.changed(&change, self.shooting.cycles);
        } else {
            let step = self.shooting.family.difference();
            let perturbed = self
                .shooting
                .family
                .at(parameter + step)
                .map_err(OrbitError::Harvester)?;
            let perturbed = self.balance(perturbed, unknown, parameter + step)?;
            local.by_parameter = perturbed
                .residual()
                .iter()
                .zip(local.residual())
                .map(|(a, b)| (a - b) / step)
                .collect();
        }
        Ok(local)
    }
}

impl<H: ParametricModel> OrbitMethod for HarmonicBalance<'_, H> {
    type Fault = H::Error;

    fn cycles(&self) -> u32 {
        self.shooting.cycles
    }

    fn orbit(&self, local: &BalanceEvaluation, error: f64) -> Result<Orbit, Self::Error> {
        let evaluation = self.shot(local)?;
        let mut orbit = self.shooting.orbit_of(evaluation)?;
        let loads_w = self.loads_w(local);
        orbit.mean_power_w = loads_w.iter().sum::<f64>() + 0.0;
        let first = loads_w.first().zip(local.kernel.plant.system.loads.first());
        orbit.voltage_rms_v = first.map_or(f64::NAN, |(power_w, load)| {
            (power_w * load.resistance_ohm).sqrt()
        });
        orbit.error_estimate = error + self.shooting.estimate(evaluation, &orbit);
        Ok(orbit)
    }

    fn shot<'b>(
        &self,
        local: &'b BalanceEvaluation,
    ) -> Result<&'b ShootingEvaluation, Self::Error> {
        if let Some(evaluation) = local.shot.get() {
            return Ok(evaluation);
        }
        let state = local
            .kernel
            .plant
            .to_physical(&local.state(&self.rules), 0.0);
        let evaluation = self
            .shooting
            .at(&self.shooting.unknown(&state), local.parameter)?;
        Ok(local.shot.get_or_init(|| evaluation))
    }

    fn finer_shot(&self, state: &[f64], parameter: f64) -> Result<ShootingEvaluation, Self::Error> {
        self.shooting.finer_shot(state, parameter)
    }

    fn unknown_of(&self, state: &[f64], parameter: f64) -> Result<Vec<f64>, Self::Error> {
        let evaluation = self.shooting.at(state, parameter)?;
        let spectrum_of = |stop: usize| {
            let mut spectrum = self
                .grid
                .coefficients(&evaluation.displacements_m(stop, self.grid.samples));
            spectrum.truncate(self.harmonics + 1);
            spectrum[1..].iter_mut().for_each(|c| *c *= 2.0);
            real(&spectrum)
        };
        Ok((0..self.stops).flat_map(spectrum_of).collect())
    }

    fn error_ratio(
        &self,
        local: &BalanceEvaluation,
        parameter_scale: f64,
    ) -> Result<f64, Self::Error> {
        if let Some(excess) = local.excess.get() {
            return Ok(*excess);
        }
        let excess = self.excess_of(local, parameter_scale)?;
        Ok(*local.excess.get_or_init(|| excess))
    }

    fn finer(&self) -> Option<Self> {
        let harmonics = self.harmonics + self.harmonics / 2;
        (harmonics <= MAX_HARMONICS * self.shooting.cycles as usize).then(|| self.with(harmonics))
    }

    fn coarser(&self) -> Option<Self> {
        let harmonics = self.harmonics * 2 / 3;
        (harmonics >= MIN_HARMONICS * self.shooting.cycles as usize).then(|| self.with(harmonics))
    }

    fn resampled(&self, unknown: &[f64]) -> Vec<f64> {
        let resized = |block: &[f64]| {
            let mut block = block.to_vec();
            block.resize(2 * self.harmonics + 1, 0.0);
            block
        };
        unknown
            .chunks_exact(unknown.len() / self.stops)
            .flat_map(resized)
            .collect()
    }
}
