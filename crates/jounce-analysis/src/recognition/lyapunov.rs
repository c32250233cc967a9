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

/// Motion with one direction of its tangent space, cycle by cycle.
#[derive(Debug)]
pub(super) struct TangentMotion<'k> {
    kernel: &'k Kernel,
    tolerance: f64,
    cycle_s: f64,
    /// State in block coordinates.
    state: Vec<f64>,
    /// Direction, of length 1.
    direction: Vec<f64>,
    /// Logarithm of the growth of the direction, and delivered energy, J, in each cycle.
    cycles: Vec<[f64; 2]>,
}

impl<'k> TangentMotion<'k> {
    /// Starts from block coordinates at the start of a cycle.
    pub fn from(kernel: &'k Kernel, y: &[f64], (cycle_s, tolerance): (f64, f64)) -> Self {
        Self {
            kernel,
            tolerance,
            cycle_s,
            state: y.to_vec(),
            direction: vec![1.0 / (y.len() as f64).sqrt(); y.len()],
            cycles: Vec::new(),
        }
    }

    /// Integrates a cycle.
    fn advance(&mut self) -> Result<(), SensitivityError> {
        let step = FlowSensitivity::integrate(
            self.kernel,
            &self.state,
            0.0,
            self.cycle_s,
            self.tolerance,
            &ParameterSensitivity::default(),
        )?;
        let n = self.state.len();
        let perturbed: Vec<f64> = (0..n)
            .map(|i| {
                (0..n)
                    .map(|j| step.jacobian[(i, j)] * self.direction[j])
                    .sum()
            })
            .collect();
        let length = perturbed
            .iter()
            .map(|v| v * v)
            .sum::<f64>()
            .sqrt()
            .max(f64::MIN_POSITIVE);
        self.direction = perturbed.into_iter().map(|v| v / length).collect();
        let delivered_j = step.delivered_j.iter().sum::<f64>();
        self.cycles.push([length.ln(), delivered_j]);
        self.state = step.end;
        Ok(())
    }

    /// Returns the largest exponent over the first `cycles` drive cycles (rounded up to full
    /// blocks) after a first block. Cycles that are not integrated yet are integrated.
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn exponent(&mut self, cycles: usize) -> Result<Lyapunov, SensitivityError> {
        let per_block = cycles.div_ceil(EXPONENT_BLOCKS).max(1);
        // In the first block the direction aligns with the fastest growth; it does not count.
        let count = (EXPONENT_BLOCKS + 1) * per_block;
        while self.cycles.len() < count {
            self.advance()?;
        }
        let counted = &self.cycles[per_block..count];
        let block_s = per_block as f64 * self.cycle_s;
        let means: Vec<f64> = counted
            .chunks(per_block)
            .map(|block| block.iter().map(|[growth, _]| growth).sum::<f64>() / block_s)
            .collect();
        let mean = means.iter().sum::<f64>() / EXPONENT_BLOCKS as f64;
        let variance =
            means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (EXPONENT_BLOCKS - 1) as f64;
        let energy_j: f64 = counted.iter().map(|[_, delivered_j]| delivered_j).sum();
        Ok(Lyapunov {
            exponent_per_s: mean,
            error_per_s: (variance / EXPONENT_BLOCKS as f64).sqrt(),
            mean_power_w: energy_j / counted.len() as f64 / self.cycle_s,
        })
    }
}

/// Computes the largest exponent over `cycles` drive cycles of a length (rounded up to full blocks),
/// from block coordinates `y` at the start of a cycle.
///
/// # Errors
/// [`SensitivityError`].
pub fn largest_exponent(
    kernel: &Kernel,
    y: &[f64],
    (cycles, cycle_s): (usize, f64),
    tolerance: f64,
) -> Result<Lyapunov, SensitivityError> {
    TangentMotion::from(kernel, y, (cycle_s, tolerance)).exponent(cycles)
}
