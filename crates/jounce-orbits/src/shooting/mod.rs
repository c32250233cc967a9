//! Shooting: an orbit of `n` drive cycles is a fixed point of the exact flow over them.
//!
//! ```text
//! R(u, p) = W (x(n T) - x(0)),   u = W x(0),   x = (q, q', V),   W = (w, 1, sqrt(C))
//! ```
//!
//! `u` are coordinates whose squares are energies. They remain meaningful when a load, stop or
//! drive changes, and their size at a peak is the size of the motion. The derivative follows from
//! the derivative of the flow (see [`jounce_dynamics::FlowSensitivity`]), cycle by cycle. With
//! respect to the parameter it is exact for drive, gap and stiffness, and a difference quotient
//! otherwise.

mod charges;
mod derivatives;
mod estimate;
pub(crate) mod evaluation;
mod integrated;
mod period_record;
mod sticking_orbit;

use super::{
    Orbit, OrbitError, OrbitMethod, ParameterDerivatives, ParametricModel, ShootingEvaluation,
};
use charges::{conserved_charges, without_conserved};
pub use derivatives::{InstantSensitivity, OrbitInstant, OrbitSensitivity};
use jounce_continuation::Problem;
use jounce_dynamics::{FlowSensitivity, Kernel};
use jounce_linalg::Mat;
use jounce_model::plant::{Plant, product};
use period_record::PeriodRecord;
use std::sync::OnceLock;

/// Tolerance of an integration that shows the error of another, relative to that of the other.
pub const FINER_TOLERANCE: f64 = 0.1;

/// Shooting method for the orbits of a harvester.
#[derive(Debug)]
pub struct Shooting<'h, H> {
    /// Family of harvesters.
    pub family: &'h H,
    /// Drive cycles in the period.
    pub cycles: u32,
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// `W`.
    pub scale: Vec<f64>,
    /// `u` that fixes the charges conserved over a period; if empty, these charges are zero.
    pub charged: Vec<f64>,
}

impl<'h, H: ParametricModel> Shooting<'h, H> {
    /// Creates the problem for orbits of `cycles` drive cycles; `kernel` is the harvester at any
    /// value of its parameter.
    pub fn new(family: &'h H, kernel: &Kernel, cycles: u32, tolerance: f64) -> Self {
        let modes = &kernel.plant.system.modes;
        let drive = kernel
            .plant
            .tones
            .first()
            .map_or(1.0, |tone| tone.angular_frequency_rad_s);
        let stiff = modes
            .frequency_rad_s
            .iter()
            .map(|w| if *w > 0.0 { *w } else { drive });
        let scale = stiff
            .chain(std::iter::repeat_n(1.0, modes.len()))
            .chain(kernel.plant.electrical.energy_scale());
        Self {
            family,
            cycles,
            tolerance,
            scale: scale.collect(),
            charged: Vec::new(),
        }
    }

    /// Returns this problem with another tolerance of the integration.
    #[must_use]
    pub fn with_tolerance(&self, tolerance: f64) -> Self {
        Self {
            family: self.family,
            cycles: self.cycles,
            tolerance,
            scale: self.scale.clone(),
            charged: self.charged.clone(),
        }
    }

    /// Fixes the conserved charges at the charges of a physical state.
    #[must_use]
    pub fn charged_as(mut self, physical: &[f64]) -> Self {
        self.charged = self.unknown(physical);
        self
    }

    /// Returns `u` of a physical state.
    pub fn unknown(&self, physical: &[f64]) -> Vec<f64> {
        physical
            .iter()
            .zip(&self.scale)
            .map(|(x, w)| x * w)
            .collect()
    }

    /// Returns the physical state of `u`.
    pub fn physical(&self, unknown: &[f64]) -> Vec<f64> {
        unknown
            .iter()
            .zip(&self.scale)
            .map(|(u, w)| u / w)
            .collect()
    }

    /// Integrates the period; true when the derivative with respect to the parameter is exact.
    pub fn shoot(
        &self,
        unknown: &[f64],
        parameter: f64,
    ) -> Result<(ShootingEvaluation, bool), OrbitError<H::Error>> {
        let setting = self.family.at(parameter).map_err(OrbitError::Harvester)?;
        let kernel = setting.kernel;
        let plant = &kernel.plant;
        let cycle_s = cycle_s(plant)?;
        let period_s = cycle_s * f64::from(self.cycles);
        let exact = setting.change.is_some();
        let change = setting.change;
        let change = change.unwrap_or_else(|| ParameterDerivatives::zero(plant.len()));
        let mut y = plant.from_physical(&self.physical(unknown), 0.0);
        let steady = plant.steady_at(0.0);
        let mut record = PeriodRecord::new(plant, unknown.to_vec());
        let mut map: Option<Mat<f64>> = None;
        // d y / dp: the state is fixed, so its difference from the steady part moves opposite to
        // the steady part.
        let mut by_parameter: Vec<f64> = change.steady.iter().map(|s| -s).collect();
        for _ in 0..self.cycles {
            let (tolerance, drift) = (self.tolerance, &change.drift);
            let cycle = FlowSensitivity::integrate(&kernel, &y, 0.0, cycle_s, tolerance, drift)?;
            by_parameter =
                propagated_derivative(&cycle, &by_parameter, cycle_s * change.period_relative);
            map = Some(map.map_or_else(
                || cycle.jacobian.clone(),
                |before| &cycle.jacobian * &before,
            ));
            y = cycle.end;
            let full: Vec<f64> = y.iter().zip(&steady).map(|(y, s)| y + s).collect();
            let unknown = self.unknown(&product(&plant.diagonal.to_physical, &full));
            record.strobe_states.push(unknown);
            record.add_contacts(&cycle.statistics);
            record.add_delivered(cycle.delivered_j.iter().copied(), period_s);
            record.trajectories.push(cycle.trajectory);
        }
        by_parameter
            .iter_mut()
            .zip(&change.steady)
            .for_each(|(y, s)| *y += s);
        let by_parameter = self.unknown(&product(&plant.diagonal.to_physical, &by_parameter));
        let conserved = conserved_charges(plant, &self.scale, &record.trajectories);
        let full_map = map.unwrap_or_else(|| Mat::identity(plant.len(), plant.len()));
        let block_map = if conserved.is_empty() {
            full_map
        } else {
            self.without_conserved_charges(plant, &full_map, &conserved)
        };
        let residual = self.residual(unknown, record.end(), &conserved);
        let mut evaluation = self.evaluation(kernel, record, residual, period_s);
        evaluation.block_map = block_map;
        evaluation.by_parameter = by_parameter;
        evaluation.keeps_charge = !conserved.is_empty();
        Ok((evaluation, exact))
    }
}

impl<H> Shooting<'_, H> {
    /// Returns the evaluation of a recorded period, without derivatives.
    fn evaluation(
        &self,
        kernel: Kernel,
        record: PeriodRecord,
        residual: Vec<f64>,
        period_s: f64,
    ) -> ShootingEvaluation {
        ShootingEvaluation {
            kernel,
            strobe_states: record.strobe_states,
            residual,
            block_map: Mat::zeros(0, 0),
            by_parameter: Vec::new(),
            scale: self.scale.clone(),
            map: OnceLock::new(),
            eigenbasis: OnceLock::new(),
            equations: OnceLock::new(),
            period_s,
            keeps_charge: false,
            trajectories: record.trajectories,
            contacts: record.contacts,
            max_penetration_m: record.max_penetration_m,
            max_contact_force_n: record.max_contact_force_n,
            max_impact_velocity_m_s: record.max_impact_velocity_m_s,
            loads_w: record.loads_w,
            tolerance: self.tolerance,
        }
    }

    /// Returns a period map in block coordinates with 0 in place of the unit multipliers of
    /// conserved charges.
    fn without_conserved_charges(
        &self,
        plant: &Plant,
        full_map: &Mat<f64>,
        conserved: &[Vec<f64>],
    ) -> Mat<f64> {
        let (into, out) = (&plant.diagonal.from_physical, &plant.diagonal.to_physical);
        let to_scaled = Mat::from_fn(plant.len(), plant.len(), |i, j| self.scale[i] * out[(i, j)]);
        let right = Mat::from_fn(plant.len(), plant.len(), |i, j| {
            into[(i, j)] / self.scale[j]
        });
        &right * without_conserved(&to_scaled * full_map * &right, conserved) * &to_scaled
    }

    /// Returns `R`; conserved charges are fixed at the prescribed values.
    fn residual(&self, unknown: &[f64], end: &[f64], conserved: &[Vec<f64>]) -> Vec<f64> {
        let mut residual: Vec<f64> = end
            .iter()
            .zip(unknown)
            .map(|(end, start)| end - start)
            .collect();
        for row in conserved {
            let missing: f64 = row
                .iter()
                .enumerate()
                .map(|(i, l)| l * (self.charged.get(i).copied().unwrap_or(0.0) - unknown[i]))
                .sum();
            residual
                .iter_mut()
                .zip(row)
                .for_each(|(r, l)| *r += l * missing);
        }
        residual
    }
}

impl<H: ParametricModel> Problem for Shooting<'_, H> {
    type Evaluation = ShootingEvaluation;
    type Error = OrbitError<H::Error>;

    fn at(&self, unknown: &[f64], parameter: f64) -> Result<ShootingEvaluation, Self::Error> {
        let (mut evaluation, exact) = self.shoot(unknown, parameter)?;
        if !exact {
            let step = self.family.difference();
            let (perturbed, _) = self.shoot(unknown, parameter + step)?;
            evaluation.by_parameter = perturbed
                .residual
                .iter()
                .zip(&evaluation.residual)
                .map(|(a, b)| (a - b) / step)
                .collect();
        }
        Ok(evaluation)
    }
}

impl<H: ParametricModel> OrbitMethod for Shooting<'_, H> {
    type Fault = H::Error;

    fn cycles(&self) -> u32 {
        self.cycles
    }

    fn orbit(&self, evaluation: &ShootingEvaluation, error: f64) -> Result<Orbit, Self::Error> {
        let mut orbit = self.orbit_of(evaluation)?;
        orbit.error_estimate = error + self.estimate(evaluation, &orbit);
        Ok(orbit)
    }

    fn shot<'l>(
        &self,
        evaluation: &'l ShootingEvaluation,
    ) -> Result<&'l ShootingEvaluation, Self::Error> {
        Ok(evaluation)
    }

    fn finer_shot(&self, state: &[f64], parameter: f64) -> Result<ShootingEvaluation, Self::Error> {
        self.with_tolerance(FINER_TOLERANCE * self.tolerance)
            .at(state, parameter)
    }

    fn unknown_of(&self, state: &[f64], _parameter: f64) -> Result<Vec<f64>, Self::Error> {
        Ok(state.to_vec())
    }
}

/// Returns `d y / dp` after a cycle whose length changes by `longer_s` per unit of the parameter.
fn propagated_derivative(cycle: &FlowSensitivity, before: &[f64], longer_s: f64) -> Vec<f64> {
    let propagated = product(&cycle.jacobian, before);
    (0..before.len())
        .map(|i| propagated[i] + cycle.drift[i] + cycle.rate[i] * longer_s)
        .collect()
}

/// Returns the length of the drive cycle, s.
///
/// # Errors
/// [`OrbitError::Frequencies`].
pub fn cycle_s<F: std::error::Error>(plant: &Plant) -> Result<f64, OrbitError<F>> {
    plant.period_s().ok_or(OrbitError::Frequencies {
        frequencies: plant.tones.len(),
    })
}
