//! Result of a run.

use super::History;
use jounce_analysis::run::{
    ChargeResult, DeviceResult, LeakResult, RectifiedResult, StartState, StopResult, Warning,
};
use jounce_dynamics::{Energies, WorkCount};
use serde::{Serialize, Serializer};

/// Means over the averaging window at the end of a run, and the energy balance of the complete run.
/// Its serialisation is the JSON of the command line.
#[derive(Debug, Clone, Serialize)]
pub struct RunResult {
    /// Mean power of all loads and rectified circuits together, W.
    pub mean_power_w: f64,
    /// Rms voltage of the first load, or of the storage of the first rectified circuit without a
    /// load, V.
    pub voltage_rms_v: Option<f64>,
    /// Largest voltage of the first load, or of the first patch without a load, V.
    pub voltage_peak_v: Option<f64>,
    /// Each load.
    pub loads: Vec<LoadResult>,
    /// Each patch.
    pub patches: Vec<PatchResult>,
    /// Each named point that moves.
    pub points: Vec<PointResult>,
    /// Each rectified circuit.
    pub rectified: Vec<RectifiedResult>,
    /// Operation of each device behind a regulator.
    pub devices: Vec<DeviceResult>,
    /// Charge balance of each circuit whose diodes feed a capacitor.
    pub charges: Vec<ChargeResult>,
    /// Each patch with leakage.
    pub leaks: Vec<LeakResult>,
    /// Largest penetration of any stop, m.
    pub max_penetration_m: f64,
    /// Largest contact force of any stop, N.
    pub max_contact_force_n: f64,
    /// Contacts that began, of all stops.
    pub contacts: u64,
    /// Share of the time in contact, summed over the stops.
    pub contact_duty: f64,
    /// Each stop.
    pub stops: Vec<StopResult>,
    /// Input minus all outputs and the stored energy, relative to the largest energy of the run.
    pub energy_residual_relative: f64,
    /// True where no contact began and no energy changed by more than roundoff, so that the
    /// residual has no meaning.
    pub is_trivial: bool,
    /// Energies of the complete run, J.
    #[serde(serialize_with = "energies")]
    pub energies: Energies,
    /// True where the run has settled; `None` where the drives have no common period.
    pub settled: Option<bool>,
    /// Period of the orbit, in drive cycles.
    pub period_cycles: Option<u32>,
    /// Relative change of the state over the last period.
    pub periodicity_change: Option<f64>,
    /// Estimated relative distance to the periodic orbit.
    pub distance_to_orbit: Option<f64>,
    /// Warnings.
    pub warnings: Vec<Warning>,
    /// Numbers of steps and iterations.
    pub work: WorkCount,
    /// Wall time of the call, with the model and the record, s.
    pub wall_time_s: f64,
    /// Wall time of the integration alone, s.
    pub integration_wall_time_s: f64,
    /// Length of the run, s.
    pub duration_s: f64,
    /// Length of the averaging window, s.
    pub average_over_s: f64,
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// State at the end, from which another run can start.
    #[serde(skip)]
    pub end: StartState,
    /// Stored end of the run; `None` unless [`super::RunOptions::record_s`] is greater than 0.
    #[serde(skip)]
    pub history: Option<History>,
}

/// One electrical load over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadResult {
    /// Name of the circuit.
    pub name: String,
    /// Mean power, W (paper eq. (7)).
    pub mean_power_w: f64,
    /// Voltage, rms, V.
    pub voltage_rms_v: f64,
    /// Largest magnitude of the voltage, V; `None` without a record of the averaging window.
    pub voltage_peak_v: Option<f64>,
}

/// One patch at the end of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PatchResult {
    /// Name of the patch.
    pub name: String,
    /// Largest magnitude of the voltage, V; `None` without a record of the averaging window.
    pub voltage_peak_v: Option<f64>,
    /// Largest magnitude of the strain of its outer face; `None` as for the voltage, and for a
    /// structure given by its modes.
    pub strain_peak: Option<f64>,
}

/// One named point at the end of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PointResult {
    /// Name of the point.
    pub name: String,
    /// Largest magnitude of the displacement relative to the base of its body, m; `None`
    /// without a record of the averaging window.
    pub displacement_peak_m: Option<f64>,
}

fn energies<S: Serializer>(of: &Energies, serializer: S) -> Result<S::Ok, S::Error> {
    let energies = serde_json::json!({
        "input_j": of.input_j,
        "loads_j": of.loads_j,
        "rectified": of.rectified,
        "leaks_j": of.leaks_j,
        "damping_j": of.damping_j,
        "contact_loss_j": of.contact_loss_j,
        "stored_j": of.stored_j,
    });
    energies.serialize(serializer)
}
