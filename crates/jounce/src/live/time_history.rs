//! Time histories of a run in pairs of extremes, and a spectral density in bands.

use crate::error::Error;
use jounce_analysis::run::RunResult;
use jounce_dynamics::Kernel;
use jounce_signal::{Samples, Window};
use serde::Serialize;

/// Samples per second; fewer in a long run.
const RATE_HZ: f64 = 1000.0;
/// Largest number of samples.
const MAX_SAMPLES: f64 = 120_000.0;
/// Largest number of pairs of the smallest and the largest value in a history.
const HISTORY_PAIRS: usize = 900;
/// Frequency bands of a density.
const DENSITY_BANDS: usize = 300;

/// Smallest and largest value of each short interval of a time history: two values per interval at
/// its first time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Extremes {
    /// Time, s.
    pub time_s: Vec<f64>,
    /// Smallest and largest value, in the unit of the quantity.
    pub value: Vec<f64>,
}

/// One-sided spectral density, averaged over bands of equal width.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpectralDensity {
    /// Middle of each band, Hz.
    pub frequency_hz: Vec<f64>,
    /// Density, in the square of the unit of the quantity per Hz.
    pub value: Vec<f64>,
}

/// Histories of a run.
pub struct Histories {
    /// Voltage of the first patch.
    pub voltage: Extremes,
    /// Displacement towards the first stop.
    pub displacement: Option<Extremes>,
    /// Spectral density of the voltage.
    pub density: Option<SpectralDensity>,
}

/// Returns the histories of a run from its begin.
pub fn of_run(kernel: &Kernel, result: &RunResult, duration_s: f64) -> Result<Histories, Error> {
    let plant = &kernel.plant;
    let rate_hz = RATE_HZ.min(MAX_SAMPLES / duration_s);
    let count = (duration_s * rate_hz) as usize;
    let time_s: Vec<f64> = (0..count).map(|k| k as f64 / rate_hz).collect();
    let instants = result.trajectory.at(kernel, &time_s);
    let states: Vec<Vec<f64>> = instants
        .iter()
        .map(|instant| plant.to_physical(&instant.state, instant.time_s))
        .collect();
    let first_voltage = |state: &Vec<f64>| plant.patch_voltages_v(state).first().copied();
    let voltage: Vec<f64> = states
        .iter()
        .map(|state| first_voltage(state).unwrap_or(0.0))
        .collect();
    let displacement = plant.system.stops.first().map(|stop| {
        let sum = |state: &Vec<f64>| stop.shape.iter().zip(state).map(|(s, x)| s * x).sum();
        let values: Vec<f64> = states.iter().map(sum).collect();
        Extremes::new(&time_s, &values)
    });
    let density = (count > 2 * DENSITY_BANDS)
        .then(|| SpectralDensity::new(&voltage, rate_hz, duration_s))
        .transpose()?;
    Ok(Histories {
        voltage: Extremes::new(&time_s, &voltage),
        displacement,
        density,
    })
}

impl Extremes {
    fn new(time_s: &[f64], values: &[f64]) -> Self {
        let length = values.len().div_ceil(HISTORY_PAIRS).max(1);
        let extremes = |chunk: &[f64]| {
            let ends = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = chunk
                .iter()
                .fold(ends, |(low, high), v| (low.min(*v), high.max(*v)));
            [low, high]
        };
        let first_twice = |chunk: &[f64]| [chunk[0], chunk[0]];
        Self {
            time_s: time_s.chunks(length).flat_map(first_twice).collect(),
            value: values.chunks(length).flat_map(extremes).collect(),
        }
    }
}

impl SpectralDensity {
    fn new(values: &[f64], rate_hz: f64, duration_s: f64) -> Result<Self, Error> {
        let density = Samples::new(values, rate_hz)?.density(Window::Hann);
        let length = density.len() / DENSITY_BANDS;
        let mean = |band: &[f64]| band.iter().sum::<f64>() / length as f64;
        let middle = |k: usize| (k as f64 + 0.5) * length as f64 / duration_s;
        Ok(Self {
            frequency_hz: (0..density.len() / length).map(middle).collect(),
            value: density.chunks_exact(length).map(mean).collect(),
        })
    }
}
