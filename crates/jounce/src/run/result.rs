//! What a run answers.

use super::{Settlement, StartState};
use crate::integrate::{Energies, Trajectory, WorkCount};
use serde::Serialize;

/// One electrical load over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadResult {
    /// Name of the circuit.
    pub name: String,
    /// Mean power, W (paper eq. (7)).
    pub mean_power_w: f64,
    /// Voltage, rms, V.
    pub voltage_rms_v: f64,
}

/// One rectified circuit over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RectifiedResult {
    /// Name of the circuit.
    pub name: String,
    /// Mean power into the load or the battery, W.
    pub mean_power_w: f64,
    /// Voltage of the storage, rms, V.
    pub voltage_rms_v: f64,
    /// Mean current that the diodes pass, A; 0 for SECE, which hands over energy instead.
    pub mean_current_a: f64,
    /// Mean power that fills the storage capacitor, W: what is delivered besides, 0 once its voltage has settled.
    pub storage_w: f64,
    /// Mean power lost in diodes, W.
    pub diode_loss_w: f64,
    /// Mean power lost in the switch and its inductor, W.
    pub switch_loss_w: f64,
    /// Mean power lost by leakage of the storage, W.
    pub leakage_w: f64,
}

/// One patch that leaks over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeakResult {
    /// Name of the patch.
    pub patch: String,
    /// Mean power that its leakage takes, W.
    pub mean_power_w: f64,
}

/// One stop over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StopResult {
    /// Name of the stop.
    pub name: String,
    /// Contacts that began.
    pub contacts: u64,
    /// Contacts per second, Hz.
    pub contact_rate_hz: f64,
    /// Mean speed at which they began, m/s.
    pub mean_impact_velocity_m_s: f64,
    /// Largest of these speeds, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean time that one lasts, s: time in contact over contacts that began.
    pub mean_contact_duration_s: f64,
    /// Longest time that one lasted within the window, s.
    pub max_contact_duration_s: f64,
    /// Share of the time in contact, 0 to 1.
    pub contact_duty: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Largest contact force, N; 0 for impacts on a rigid stop.
    pub max_contact_force_n: f64,
    /// Time integral of the contact force, N s.
    pub impulse_n_s: f64,
}

/// Answers over the averaging window, and the audit of the whole run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunResult {
    /// Mean power of all loads and rectified circuits together, W.
    pub mean_power_w: f64,
    /// Each load.
    pub loads: Vec<LoadResult>,
    /// Each rectified circuit.
    pub rectified: Vec<RectifiedResult>,
    /// Each patch that leaks.
    pub leaks: Vec<LeakResult>,
    /// Each stop.
    pub stops: Vec<StopResult>,
    /// Largest penetration of any stop, m.
    pub max_penetration_m: f64,
    /// Largest contact force of any stop, N.
    pub max_contact_force_n: f64,
    /// Contacts that began, of all stops.
    pub contacts: u64,
    /// Contacts that began in the whole run, of all stops.
    pub contacts_in_all: u64,
    /// Share of the time in contact, 0 to 1, summed over the stops.
    pub contact_duty: f64,
    /// Has the run settled? `None` where the drives do not repeat themselves, so that there is no period to settle to.
    pub settlement: Option<Settlement>,
    /// Energies of the whole run, J.
    pub energies: Energies,
    /// Steps and iterations of the whole run.
    pub work: WorkCount,
    /// State at the end.
    pub end: StartState,
    /// Wall time of the marching alone, s.
    pub wall_time_s: f64,
    /// The last part of the run, as long as the plan asked for.
    pub trajectory: Trajectory,
}

impl RunResult {
    /// True where nothing struck and no energy flowed or changed by more than roundoff, so that the energy residual says nothing.
    pub fn is_trivial(&self) -> bool {
        self.contacts_in_all == 0 && self.energies.are_still()
    }

    /// Voltage of the first load or, without one, of the storage of the first rectified circuit, rms, V; `None` where nothing takes power.
    pub fn voltage_rms_v(&self) -> Option<f64> {
        let storage = || self.rectified.first().map(|circuit| circuit.voltage_rms_v);
        self.loads
            .first()
            .map(|load| load.voltage_rms_v)
            .or_else(storage)
    }
}
