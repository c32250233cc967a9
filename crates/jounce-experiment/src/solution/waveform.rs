//! Voltage of an orbit as a Fourier series.

use jounce_analysis::run::{RunError, RunPlan, StartState, simulate};
use jounce_dynamics::Kernel;
use jounce_linalg::c64;
use jounce_spec::Spec;
use std::f64::consts::TAU;

use super::{SensorOutput, outputs};

/// Highest drive order used.
pub const MAX_ORDER: u32 = 8;
/// Samples per drive cycle: orders above 56 are aliased.
const SAMPLES_PER_CYCLE: u32 = 64;

/// Periodic voltage.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// Drive cycles of its period.
    pub period_cycles: u32,
    /// Line `k` has the order `(k + 1) / period_cycles`, V peak, up to order [`MAX_ORDER`].
    pub lines_v: Vec<c64>,
}

impl Waveform {
    /// Integrates one period from a state on the orbit and transforms the voltage across a load.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn of(
        kernel: &Kernel,
        start: &StartState,
        period_cycles: u32,
        drive_hz: f64,
        load: usize,
        tolerance: f64,
    ) -> Result<Self, RunError> {
        let period_s = f64::from(period_cycles) / drive_hz;
        let plan = RunPlan {
            duration_s: period_s,
            average_over_s: period_s,
            tolerance,
            record_s: period_s,
        };
        let run = simulate(kernel, start, &plan)?;
        let count = (SAMPLES_PER_CYCLE * period_cycles) as usize;
        let times_s: Vec<f64> = (0..count)
            .map(|k| period_s * k as f64 / count as f64)
            .collect();
        // Only outputs of the structure are read, so an empty spec without base motion suffices.
        let voltage = outputs(
            &Spec::default(),
            kernel,
            &run.trajectory,
            &times_s,
            &[SensorOutput::LoadVoltage(load)],
        )
        .swap_remove(0);
        Ok(Self {
            period_cycles,
            lines_v: (1..=(MAX_ORDER * period_cycles) as usize)
                .map(|k| line(&voltage, k))
                .collect(),
        })
    }

    /// Line of order `order / cycles`; 0 where the waveform has no such line.
    pub fn at(&self, order: u32, cycles: u32) -> c64 {
        let index = order * self.period_cycles;
        if !index.is_multiple_of(cycles) || index == 0 {
            return c64::new(0.0, 0.0);
        }
        self.lines_v
            .get((index / cycles) as usize - 1)
            .copied()
            .unwrap_or(c64::new(0.0, 0.0))
    }
}

/// Line `k` of a complete period.
fn line(samples: &[f64], k: usize) -> c64 {
    let term = |(n, x): (usize, &f64)| {
        c64::cis(-TAU * ((k * n) % samples.len()) as f64 / samples.len() as f64) * *x
    };
    samples.iter().enumerate().map(term).sum::<c64>() * (2.0 / samples.len() as f64)
}
