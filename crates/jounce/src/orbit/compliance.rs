//! The plant between its port and itself, at the harmonics of an orbit.
//!
//! ```text
//! d(t) = Re(S e^{i w t}) + sum_n G(i n w / p) f_n e^{i n w t / p},   G(s) = c (s I - A)^-1 b
//! ```
//!
//! `d` is the displacement of the port (m), `f` the contact force (N), `p` the drive cycles of the period. The diagonal form makes
//! `G` exact at a cost that grows with the number of modes times the number of harmonics, and with nothing else.

use crate::march::Kernel;
use crate::plant::Plant;
use faer::c64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::f64::consts::SQRT_2;
use std::sync::Arc;

/// Transforms of one length.
#[derive(Clone)]
pub struct Grid {
    /// Samples per period.
    pub samples: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
}

impl std::fmt::Debug for Grid {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "Grid({})", self.samples)
    }
}

impl Grid {
    /// A grid of an even number of samples.
    pub fn new(samples: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        Self { samples, forward: planner.plan_fft_forward(samples), backward: planner.plan_fft_inverse(samples) }
    }

    /// Coefficients `f_n`, `n = 0..=samples / 2`, of `sum_n f_n e^{i n x}` over all integers, those below zero being conjugate.
    pub fn coefficients(&self, values: &[f64]) -> Vec<c64> {
        let mut input = values.to_vec();
        let mut output = self.forward.make_output_vec();
        // The lengths come from the plan itself: no error is possible.
        let _ = self.forward.process(&mut input, &mut output);
        output.iter().map(|value| *value / self.samples as f64).collect()
    }

    /// Values of such a sum on the grid.
    pub fn values(&self, coefficients: &[c64]) -> Vec<f64> {
        let mut input = coefficients.to_vec();
        // Only cosines live at both ends of the spectrum.
        let last = input.len() - 1;
        input[0].im = 0.0;
        input[last].im = 0.0;
        let mut output = self.backward.make_output_vec();
        let _ = self.backward.process(&mut input, &mut output);
        output
    }
}

/// `row (s I - A)^-1 b` at `s = i n w / p`, `n = 0..=harmonics`; `b` is the column of the contact force.
pub fn transfer(kernel: &Kernel, row: &[f64], cycles: u32, harmonics: usize) -> Vec<c64> {
    let plant = &kernel.plant;
    let (Some(tone), Some(port)) = (plant.tones.first(), plant.ports.first()) else { return vec![c64::new(0.0, 0.0); harmonics + 1] };
    let column: Vec<c64> = port.force.iter().map(|b| c64::new(*b, 0.0)).collect();
    let step = tone.angular_frequency_rad_s / f64::from(cycles);
    (0..=harmonics)
        .map(|n| {
            let response = plant.diagonal.block.resolve(c64::new(0.0, n as f64 * step), &column);
            response.iter().zip(row).map(|(y, c)| *y * *c).sum()
        })
        .collect()
}

/// Adds the steady displacement of the port, m, to its harmonics over a period of `cycles` of the drive.
pub fn steady(plant: &Plant, cycles: u32, harmonics: &mut [f64]) {
    if let Some(port) = plant.ports.first().filter(|_| !plant.tones.is_empty()) {
        let n = cycles as usize;
        harmonics[2 * n - 1] += port.steady_m[0].re / SQRT_2;
        harmonics[2 * n] -= port.steady_m[0].im / SQRT_2;
    }
}
