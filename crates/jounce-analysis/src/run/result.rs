//! Results of a run.

use super::{DeviceResult, Settlement, StartState};
use jounce_dynamics::{Energies, Trajectory, WorkCount};
use serde::Serialize;

/// Results of one electrical load over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadResult {
    /// Name of the circuit.
    pub name: String,
    /// Mean power, W (paper eq. (7)).
    pub mean_power_w: f64,
    /// Voltage across the resistor, rms, V.
    pub voltage_rms_v: f64,
}

/// Results of one rectified circuit over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RectifiedResult {
    /// Name of the circuit.
    pub name: String,
    /// Mean power into the load, the battery, or the device behind the regulator, W.
    pub mean_power_w: f64,
    /// Voltage of the storage, rms, V.
    pub voltage_rms_v: f64,
    /// Mean current through the diodes, A; 0 for SECE, which transfers energy instead.
    pub mean_current_a: f64,
    /// Mean power that charges the storage capacitor, W; 0 at steady state. It is not part of
    /// `mean_power_w`.
    pub storage_w: f64,
    /// Mean power lost in diodes, W.
    pub diode_loss_w: f64,
    /// Mean power lost in the switch and its inductor, W.
    pub switch_loss_w: f64,
    /// Mean power lost by leakage of the storage, W.
    pub leakage_w: f64,
    /// Mean power lost in the regulator, W.
    pub regulator_loss_w: f64,
}

/// Results of one leaking patch over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeakResult {
    /// Name of the patch.
    pub name: String,
    /// Mean power lost in the leakage, W.
    pub mean_power_w: f64,
}

/// Results of one stop over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StopResult {
    /// Name of the stop.
    pub name: String,
    /// Number of contacts that began in the window.
    pub contacts: u64,
    /// Contacts per second, Hz.
    pub contact_rate_hz: f64,
    /// Mean impact velocity, m/s.
    pub mean_impact_velocity_m_s: f64,
    /// Largest impact velocity, m/s.
    pub max_impact_velocity_m_s: f64,
    /// True for a rigid stop. Its impacts have no duration; its time in contact is rest on the stop.
    #[serde(skip)]
    pub is_rigid: bool,
    /// Mean contact duration, s: time in contact over number of contacts that began.
    pub mean_contact_duration_s: f64,
    /// Longest contact duration within the window, s.
    pub max_contact_duration_s: f64,
    /// Fraction of the time in contact, 0 to 1.
    pub contact_duty: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Largest contact force, N; 0 for impacts on a rigid stop.
    pub max_contact_force_n: f64,
    /// Time integral of the contact force, N s.
    pub impulse_n_s: f64,
}

/// Results over the averaging window, and checks of the complete run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunResult {
    /// Total mean power of all loads and rectified circuits, W.
    pub mean_power_w: f64,
    /// Results of each load.
    pub loads: Vec<LoadResult>,
    /// Results of each rectified circuit.
    pub rectified: Vec<RectifiedResult>,
    /// Operation of each device behind a regulator.
    pub devices: Vec<DeviceResult>,
    /// Charge drawn by the held current of each regulator, by rectified circuit, C.
    pub drawn_c: Vec<f64>,
    /// Results of each leaking patch.
    pub leaks: Vec<LeakResult>,
    /// Results of each stop.
    pub stops: Vec<StopResult>,
    /// Largest penetration of any stop, m.
    pub max_penetration_m: f64,
    /// Largest contact force of any stop, N.
    pub max_contact_force_n: f64,
    /// Number of contacts of all stops that began in the window.
    pub contacts: u64,
    /// Number of contacts of all stops that began in the complete run.
    pub contacts_in_all: u64,
    /// Sum over the stops of the fraction of time in contact, each 0 to 1.
    pub contact_duty: f64,
    /// Steady-state test; `None` if the drives are not periodic.
    pub settlement: Option<Settlement>,
    /// Length of the part at the end of the run that has the peaks of the averaging window, s.
    pub peak_window_s: f64,
    /// Energies of the complete run, J.
    pub energies: Energies,
    /// Steps and iterations of the complete run.
    pub work: WorkCount,
    /// Final state.
    pub end: StartState,
    /// Wall time of the integration alone, s.
    pub wall_time_s: f64,
    /// Record of the last part of the run, of the length that the plan requests.
    pub trajectory: Trajectory,
}

impl RunResult {
    /// True where no contact began and no energy changed by more than roundoff; the energy residual
    /// is then meaningless.
    pub fn is_trivial(&self) -> bool {
        self.contacts_in_all == 0 && self.energies.are_still()
    }

    /// Returns the voltage, rms, V, of the first load or, without a load, of the storage of the
    /// first rectified circuit; `None` without either.
    pub fn voltage_rms_v(&self) -> Option<f64> {
        let storage = || self.rectified.first().map(|circuit| circuit.voltage_rms_v);
        self.loads
            .first()
            .map(|load| load.voltage_rms_v)
            .or_else(storage)
    }
}
