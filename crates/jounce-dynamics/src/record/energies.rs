//! Energy balance of an integration, from exact integrals (see
//! [`jounce_model::plant::EnergyMeter`]).

use crate::excitation::Excitation;
use crate::integrator::{FullState, Integrator};
use crate::ports::state::ContactState;
use crate::rectifier::energies::RectifiedEnergies;
use jounce_linalg::{Mat, c64};
use jounce_model::drive::Wave;
use jounce_model::plant::{SignalIntegrals, Tone};

/// Energies since the start of an integration, J.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Energies {
    /// Input by the drives.
    pub input_j: f64,
    /// Delivered to each load, in the order of `system.loads`.
    pub loads_j: Vec<f64>,
    /// Lost in modal damping.
    pub damping_j: f64,
    /// Lost in contact.
    pub contact_loss_j: f64,
    /// Energies of each rectified circuit, in the order of `system.bridges`.
    pub rectified: Vec<RectifiedEnergies>,
    /// Lost by leakage of each leaking patch, in the order of `electrical.leaks`.
    pub leaks_j: Vec<f64>,
    /// Change of the energy stored in the structure, the patches and the compressed contact.
    pub stored_j: f64,
    /// Largest energy stored or transferred at any evaluation, including the potential energy of
    /// constant drives: the scale of the residual.
    pub scale_j: f64,
}

/// Fraction of the largest energy below which an energy is roundoff.
const ENERGY_ROUNDOFF: f64 = 1e-13;

impl Energies {
    /// Returns the energy delivered to all loads, batteries and loads behind rectifiers, J.
    pub fn delivered_j(&self) -> f64 {
        self.loads_j.iter().sum::<f64>()
            + self
                .rectified
                .iter()
                .map(RectifiedEnergies::delivered_j)
                .sum::<f64>()
    }

    /// Returns the energy delivered to each load, then to each rectified circuit, J.
    pub fn delivered_per_element_j(&self) -> impl Iterator<Item = f64> {
        let rectified = self.rectified.iter().map(RectifiedEnergies::delivered_j);
        self.loads_j.iter().copied().chain(rectified)
    }

    /// True where no energy flowed or changed by more than roundoff, so that the residual has no
    /// meaning.
    pub fn are_still(&self) -> bool {
        let loads = self
            .loads_j
            .iter()
            .chain(&self.leaks_j)
            .copied()
            .chain(self.rectified.iter().map(RectifiedEnergies::sum_j));
        let flows = loads.chain([
            self.input_j,
            self.damping_j,
            self.contact_loss_j,
            self.stored_j,
        ]);
        flows.fold(0.0_f64, |max, flow| max.max(flow.abs())) <= ENERGY_ROUNDOFF * self.scale_j
    }

    /// Returns `input - loads - rectified - leaks - damping - contact loss - stored`, J: zero
    /// except for roundoff and the error of the contact integration.
    pub fn residual_j(&self) -> f64 {
        let delivered = self.loads_j.iter().chain(&self.leaks_j).sum::<f64>();
        let circuits = delivered
            + self
                .rectified
                .iter()
                .map(RectifiedEnergies::sum_j)
                .sum::<f64>();
        self.input_j - circuits - self.damping_j - self.contact_loss_j - self.stored_j
    }

    /// Returns the residual relative to the largest energy of the run.
    pub fn residual_relative(&self) -> f64 {
        if self.scale_j > 0.0 {
            self.residual_j() / self.scale_j
        } else {
            0.0
        }
    }
}

/// Meter readings at the start of an integration.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct MeterReadings {
    pub input_j: f64,
    pub loads_j: Vec<f64>,
    pub damping_j: f64,
    pub stored_j: f64,
}

impl Integrator<'_> {
    /// Returns the energies from the start of the integration to the current time.
    pub fn energies(&self) -> Energies {
        let (system, state) = (&self.kernel.plant.system, self.full_state());
        if !system.bridges.is_empty() {
            return self.energies_of_all(&state, &self.signal_integrals(&state));
        }
        let mut energies =
            self.energies_in_conduction_state(&state, &self.signal_integrals(&state));
        energies.leaks_j = energies.loads_j.split_off(system.loads.len());
        energies
    }

    /// Returns the energies since the start of the current conduction state; the outlets of bridges
    /// and then the leaks of patches follow the loads.
    pub(crate) fn energies_in_conduction_state(
        &self,
        state: &FullState,
        (sums, works_j): &(SignalIntegrals, Vec<f64>),
    ) -> Energies {
        let now = self.readings(state);
        let open = &self.opening;
        let meters = self.kernel.meters();
        let ports = self.kernel.plant.ports.len();
        // The work includes all ports: it enters once.
        let contact = |meter: &jounce_model::plant::EnergyMeter, work_j: f64| -> f64 {
            let impulses = self.integrals.tones_n_s.iter().enumerate().take(ports);
            impulses
                .map(|(port, tones)| {
                    meter.contact_j(port, if port == 0 { work_j } else { 0.0 }, tones)
                })
                .sum()
        };
        let count = meters.loads.len();
        let loads_j: Vec<f64> = (0..count)
            .map(|k| {
                let (meter, work_j) = (&meters.loads[k], self.integrals.loads_j[k] + works_j[k]);
                now.loads_j[k] - open.loads_j[k]
                    + contact(meter, work_j)
                    + meter.signals().energy_j(sums)
            })
            .collect();
        let loss_j = contact(&meters.damping, self.integrals.damping_j + works_j[count]);
        let damping_j =
            now.damping_j - open.damping_j + loss_j + meters.damping.signals().energy_j(sums);
        let input_j = now.input_j - open.input_j
            + contact(&meters.input, 0.0)
            + meters.input.signals().energy_j(sums)
            + self.excitation.base_work_j;
        let stored_j = now.stored_j - open.stored_j;
        let flows = input_j
            .abs()
            .max(damping_j.abs())
            .max(loads_j.iter().map(|j| j.abs()).sum());
        let scale_j = flows
            .max(now.stored_j.abs())
            .max(open.stored_j.abs())
            .max(self.potential_j(&state.physical));
        Energies {
            input_j,
            loads_j,
            damping_j,
            contact_loss_j: self.integrals.loss_j,
            stored_j,
            scale_j,
            ..Energies::default()
        }
    }

    /// Returns the integrals of the signals since the start of the current conduction state, and the
    /// work of the contact forces on their forced motion (see [`crate::excitation::signal_work`]).
    pub(crate) fn signal_integrals(&self, state: &FullState) -> (SignalIntegrals, Vec<f64>) {
        let excitation = &self.excitation;
        let (sizes, mut signal_work) = (&excitation.sizes, excitation.signal_work.clone());
        signal_work.end(self.kernel, sizes, &state.lanes, self.time_s)
    }

    /// Returns these integrals at the end of a conduction state, and empties the sums.
    pub(crate) fn take_signal_integrals(
        &mut self,
        state: &FullState,
    ) -> (SignalIntegrals, Vec<f64>) {
        let Excitation {
            sizes, signal_work, ..
        } = &mut self.excitation;
        signal_work.end(self.kernel, sizes, &state.lanes, self.time_s)
    }

    pub(crate) fn readings(&self, state: &FullState) -> MeterReadings {
        let (y, t) = (&state.block, self.time_s);
        let meters = self.kernel.meters();
        MeterReadings {
            input_j: meters.input.boundary_j(y, t),
            loads_j: meters
                .loads
                .iter()
                .map(|meter| meter.boundary_j(y, t))
                .collect(),
            damping_j: meters.damping.boundary_j(y, t),
            stored_j: self.stored_j(&state.physical),
        }
    }

    /// Returns the magnitude of the potential energy of constant drives, J, including the
    /// displacement of the free plant under sinusoids: a ball at rest on a shaken table has no
    /// other scale.
    fn potential_j(&self, x: &[f64]) -> f64 {
        let plant = &self.kernel.plant;
        let signals = || plant.system.signals.iter();
        if !signals().any(|signal| matches!(signal.wave, Wave::Constant(_))) {
            return 0.0;
        }
        let driven = |i: usize| -> f64 {
            let amplitude =
                |tone: &Tone| dot_row(&plant.diagonal.to_physical, i, &tone.steady).norm();
            plant.tones.iter().map(amplitude).sum()
        };
        let of = |signal: &jounce_model::plant::Signal| match signal.wave {
            Wave::Constant(size) => {
                let terms = signal
                    .shape
                    .iter()
                    .zip(x)
                    .enumerate()
                    .filter(|(_, (s, _))| **s != 0.0);
                size.abs()
                    * terms
                        .map(|(i, (s, q))| s.abs() * (q.abs() + driven(i)))
                        .sum::<f64>()
            }
            _ => 0.0,
        };
        signals().map(of).sum()
    }

    /// Returns `sum (q'^2 + w^2 q^2) / 2 + sum C V^2 / 2 + energy of the compressed contact`, J.
    fn stored_j(&self, x: &[f64]) -> f64 {
        let plant = &self.kernel.plant;
        let modes = &plant.system.modes;
        let n = modes.len();
        let mechanical: f64 = (0..n)
            .map(|i| 0.5 * (x[n + i].powi(2) + (modes.frequency_rad_s[i] * x[i]).powi(2)))
            .sum();
        let electrical: f64 = plant
            .electrical
            .energy_scale()
            .zip(&x[2 * n..])
            .map(|(scale, x)| 0.5 * (scale * x).powi(2))
            .sum();
        let pressed = self
            .ports
            .iter()
            .zip(&plant.system.stops)
            .filter(|(port, _)| port.contact_state == ContactState::Contact);
        let compressed: f64 = pressed
            .map(|(port, stop)| stop.law.energy_j(port.penetration_m))
            .sum();
        mechanical + electrical + compressed
    }
}

/// Returns a row of a real matrix times a complex vector.
fn dot_row(matrix: &Mat<f64>, row: usize, vector: &[c64]) -> c64 {
    vector
        .iter()
        .enumerate()
        .map(|(j, v)| *v * matrix[(row, j)])
        .sum()
}
