//! One point of a sweep.

use crate::run::{ExceededLimit, StartState};
use serde::{Deserialize, Serialize};

/// How a point was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepDirection {
    /// From the point below it.
    Up,
    /// From the point above it.
    Down,
    /// From the start of the spec.
    Independent,
}

impl SweepDirection {
    /// `up`, `down` or `independent`.
    pub fn name(self) -> &'static str {
        match self {
            SweepDirection::Up => "up",
            SweepDirection::Down => "down",
            SweepDirection::Independent => "independent",
        }
    }
}

/// Answers at one value of the swept key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepPoint {
    /// Place in the sweep, from 0.
    pub index: usize,
    /// Value of the key, SI.
    pub parameter: f64,
    /// How it was reached.
    pub direction: SweepDirection,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Voltage of the first load or, without one, of the storage of the first rectified circuit, rms, V; NaN where nothing takes power.
    #[serde(deserialize_with = "nan_for_null")]
    pub voltage_rms_v: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Contacts per second.
    pub contact_rate_hz: f64,
    /// Whether the response had settled when it was averaged.
    pub settled: bool,
    /// Period of the response in drive cycles.
    pub period_cycles: u32,
    /// Relative energy residual of the march.
    pub energy_residual_relative: f64,
    /// Time marched, s.
    pub simulated_time_s: f64,
    /// Limits of patches that it passes.
    #[serde(default)]
    pub exceeded: Vec<ExceededLimit>,
    /// State at the end.
    pub end: StartState,
}

/// JSON has no NaN: it is written as null.
fn nan_for_null<'de, D: serde::Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}
