//! Linear response to noise.

use serde::Serialize;

/// One circuit under noise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RandomLoad {
    /// Name of the circuit.
    pub name: String,
    /// Mean power by the Lyapunov equation, W.
    pub mean_power_w: f64,
    /// Mean power by the integral over frequency, W.
    pub spectral_power_w: f64,
    /// Difference of the two powers relative to the first.
    pub difference_relative: f64,
    /// Voltage across the resistor, rms, V.
    pub voltage_rms_v: f64,
    /// Noise bandwidth of the voltage per unit of each noise drive, Hz.
    pub noise_bandwidth_hz: Vec<f64>,
    /// Statistical bandwidth of the voltage, Hz.
    pub statistical_bandwidth_hz: f64,
}

/// One patch under noise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RandomPatch {
    /// Name of the patch.
    pub name: String,
    /// Voltage, rms, V.
    pub voltage_rms_v: f64,
}

/// One point under noise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RandomPoint {
    /// Name of the point.
    pub name: String,
    /// Displacement, rms about its mean, m; relative to the base if it moves.
    pub displacement_rms_m: f64,
    /// Velocity, rms, m/s.
    pub velocity_rms_m_s: f64,
}

/// One stop, which the linear response does not include.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RandomStop {
    /// Name of the stop.
    pub name: String,
    /// Gap, m.
    pub gap_m: f64,
    /// Mean displacement towards the stop, m.
    pub mean_m: f64,
    /// Displacement towards the stop, rms about its mean, m.
    pub displacement_rms_m: f64,
    /// Rate at which the gap would be reached, Hz; `None` where a noise carries one side away.
    pub reached_hz: Option<f64>,
    /// Fraction of the time beyond the gap, 0 to 1; `None` in the same case.
    pub share_beyond: Option<f64>,
    /// Noise that moves the base of only one side: the displacement of an acceleration drifts
    /// without limit.
    pub carried_by: Option<String>,
}

/// Response of a spec to its noises without its stops.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RandomResponse {
    /// Names of the noise drives.
    pub drives: Vec<String>,
    /// Names of the omitted drives, which are not noise.
    pub left_out: Vec<String>,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Loads.
    pub loads: Vec<RandomLoad>,
    /// Patches.
    pub patches: Vec<RandomPatch>,
    /// Points.
    pub points: Vec<RandomPoint>,
    /// Stops.
    pub stops: Vec<RandomStop>,
}

/// Power spectral density of one output.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    /// Name of the output.
    pub name: String,
    /// Unit.
    pub unit: &'static str,
    /// One-sided density at each frequency.
    pub value: Vec<f64>,
}
