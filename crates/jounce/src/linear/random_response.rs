//! What is told of a linear answer to noise.

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
    /// Difference of the two over the first.
    pub difference_relative: f64,
    /// Voltage across the resistor, rms, V.
    pub voltage_rms_v: f64,
    /// Noise bandwidth of its voltage per unit of each drive of noise, Hz.
    pub noise_bandwidth_hz: Vec<f64>,
    /// Statistical bandwidth of its voltage, Hz.
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
    /// Displacement, rms about its mean, m; relative to the base where that moves.
    pub displacement_rms_m: f64,
    /// Velocity, rms, m/s.
    pub velocity_rms_m_s: f64,
}

/// One stop that the answer does not know of.
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
    /// How often the gap would be reached, Hz; none where a noise carries one side away.
    pub reached_hz: Option<f64>,
    /// Share of the time beyond the gap, 0 to 1; none likewise.
    pub share_beyond: Option<f64>,
    /// The noise that moves the base of one side and not that of the other: the displacement of an acceleration drifts without end.
    pub carried_by: Option<String>,
}

/// What a spec answers to its noises without its stops.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RandomResponse {
    /// Names of the drives of noise.
    pub drives: Vec<String>,
    /// Names of the drives that are no noise: left out.
    pub left_out: Vec<String>,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Each circuit.
    pub loads: Vec<RandomLoad>,
    /// Each patch.
    pub patches: Vec<RandomPatch>,
    /// Each point.
    pub points: Vec<RandomPoint>,
    /// Each stop.
    pub stops: Vec<RandomStop>,
}

/// Power spectral density of one output.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    /// What it is of.
    pub name: String,
    /// Unit.
    pub unit: &'static str,
    /// One-sided, at each frequency.
    pub value: Vec<f64>,
}
