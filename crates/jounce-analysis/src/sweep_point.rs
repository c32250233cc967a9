//! One point of a sweep.

use crate::run::{StartState, Warning};
use serde::{Deserialize, Serialize};

/// Direction from which a point was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepDirection {
    /// From the point below it.
    Up,
    /// From the point above it.
    Down,
    /// From the start state of the spec.
    Independent,
}

impl SweepDirection {
    /// Returns `up`, `down` or `independent`.
    pub fn name(self) -> &'static str {
        match self {
            SweepDirection::Up => "up",
            SweepDirection::Down => "down",
            SweepDirection::Independent => "independent",
        }
    }
}

/// Results at one value of the swept key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepPoint {
    /// Index in the sweep, from 0.
    pub index: usize,
    /// Value of the key, SI.
    pub parameter: f64,
    /// Direction from which it was reached.
    pub direction: SweepDirection,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// RMS voltage of the first load, V. Without a load: of the storage of the first rectified
    /// circuit. NaN where no circuit takes power.
    #[serde(deserialize_with = "nan_for_null")]
    pub voltage_rms_v: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Contacts per second.
    pub contact_rate_hz: f64,
    /// True if the response had settled at the end of the average, which may contain a transient.
    pub settled: bool,
    /// Period of the response in drive cycles.
    pub period_cycles: u32,
    /// Relative energy residual of the integration.
    pub energy_residual_relative: f64,
    /// Simulated time, s.
    pub simulated_time_s: f64,
    /// Warnings, without those of recordings.
    #[serde(default)]
    pub warnings: Vec<Warning>,
    /// State at the end.
    pub end: StartState,
}

/// Reads null as NaN: JSON has no NaN.
fn nan_for_null<'de, D: serde::Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}
