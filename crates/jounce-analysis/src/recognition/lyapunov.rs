//! Largest Lyapunov exponent of an integration, from the exact derivative of its flow.
//!
//! ```text
//! lambda = lim 1/t ln |D phi_t v|
//! ```
//!
//! It is computed cycle by cycle along one direction, which is normalised after each cycle. The
//! scatter of the means over blocks of cycles gives the error.

use super::attractor_kind::AttractorKind;
use jounce_dynamics::{FlowSensitivity, Kernel, ParameterSensitivity, SensitivityError};

/// Largest Lyapunov exponent with its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lyapunov {
    /// Largest exponent, 1/s.
    pub exponent_per_s: f64,
    /// Standard error, 1/s.
    pub error_per_s: f64,
    /// Mean power of all loads over the same cycles, W.
    pub mean_power_w: f64,
}

/// Blocks whose means are compared.
const EXPONENT_BLOCKS: usize = 16;

impl Lyapunov {
    /// Returns chaos for a positive exponent, torus for a zero one, undecided for a negative one;
    /// the limit is three times the error.
    pub fn kind(&self) -> AttractorKind {
        if self.exponent_per_s > 3.0 * self.error_per_s {
            AttractorKind::Chaos
        } else if self.exponent_per_s < -3.0 * self.error_per_s {
            AttractorKind::Undecided
        } else {
            AttractorKind::Torus
        }
    }
}

/// Computes the largest exponent over `cycles` drive cycles (rounded up to full blocks), from block
/// coordinates `y` at the start of a cycle.
///
/// # Errors
/// [`SensitivityError`].
pub fn largest_exponent(
    kernel: &Kernel,
    y: &[f64],
    cycles: usize,
    tolerance: f64,
) -> Result<Lyapunov, SensitivityError> {
    let cycle_s = kernel.plant.period_s().unwrap_or(1.0);
    let per_block = cycles.div_ceil(EXPONENT_BLOCKS).max(1);
    let mut y = y.to_vec();
    let mut direction = vec![1.0 / (y.len() as f64).sqrt(); y.len()];
    let (mut means, mut energy_j) = (Vec::with_capacity(EXPONENT_BLOCKS), 0.0);
    // In the first block the direction aligns with the fastest growth; it does not count.
    for block in 0..=EXPONENT_BLOCKS {
        let mut growth = 0.0;
        for _ in 0..per_block {
            let step = FlowSensitivity::integrate(
                kernel,
                &y,
                0.0,
                cycle_s,
                tolerance,
                &ParameterSensitivity::default(),
            )?;
            let n = y.len();
            let perturbed: Vec<f64> = (0..n)
                .map(|i| (0..n).map(|j| step.jacobian[(i, j)] * direction[j]).sum())
                .collect();
            let length = perturbed
                .iter()
                .map(|v| v * v)
                .sum::<f64>()
                .sqrt()
                .max(f64::MIN_POSITIVE);
            direction = perturbed.into_iter().map(|v| v / length).collect();
            growth += length.ln();
            y = step.end;
            energy_j += if block > 0 {
                step.delivered_j.iter().sum::<f64>()
            } else {
                0.0
            };
        }
        if block > 0 {
            means.push(growth / (per_block as f64 * cycle_s));
        }
    }
    let mean = means.iter().sum::<f64>() / EXPONENT_BLOCKS as f64;
    let variance =
        means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (EXPONENT_BLOCKS - 1) as f64;
    let mean_power_w = energy_j / (EXPONENT_BLOCKS * per_block) as f64 / cycle_s;
    Ok(Lyapunov {
        exponent_per_s: mean,
        error_per_s: (variance / EXPONENT_BLOCKS as f64).sqrt(),
        mean_power_w,
    })
}
