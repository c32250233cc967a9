//! Time integrals of the physical state along a record, in closed form, for example the flux of a
//! voltage.
//!
//! Each step contributes the integrals of its free flow, of the forced part of signals, of the
//! sinusoids, and of the response to its contact forces. The Legendre series of that response has
//! `int_0^x P_n = (P_{n+1} - P_{n-1}) / (2 (2 n + 1))`. Only the state at the start of a step
//! enters, so that a step that does not end where the next one begins shows as a gap.
//!
//! Validation: `tests/integrate/time_integral.rs`.

use super::trajectory::{ResponseCache, Trajectory, TrajectorySegment};
use crate::force_response::basis::legendre;
use crate::kernel::Kernel;
use jounce_model::plant::BlockDiagonal;

impl Trajectory {
    /// Returns the integral of one component of the physical state `(q, q', V, i)` over an interval
    /// within the record.
    pub fn integral(&self, kernel: &Kernel, from_s: f64, to_s: f64, state_index: usize) -> f64 {
        let mut cache = ResponseCache::default();
        let mut sum = 0.0;
        for segment in self.segments() {
            let within = [from_s, to_s]
                .map(|time_s| (time_s - segment.start_s).clamp(0.0, segment.length_s));
            // The kernel of a conduction state in the record exists.
            let Ok(state_kernel) = kernel.in_conduction_state(segment.conduction_state) else {
                continue;
            };
            if within[1] > within[0] {
                let state = segment.integral(state_kernel, within, &mut cache);
                sum += state_kernel
                    .plant
                    .integral_of(&state, within[1] - within[0], state_index);
            }
        }
        sum
    }
}

impl TrajectorySegment {
    /// Returns the integral of the state in block coordinates, between two times after its start.
    fn integral(
        &self,
        kernel: &Kernel,
        [from_s, to_s]: [f64; 2],
        cache: &mut ResponseCache,
    ) -> Vec<f64> {
        let (plant, length_s) = (&kernel.plant, to_s - from_s);
        let block: &BlockDiagonal = &plant.diagonal.block;
        let mut state = block.integral(length_s, &block.flow(from_s, &self.state));
        let mut add = |more: Vec<f64>, sign: f64| {
            state
                .iter_mut()
                .zip(more)
                .for_each(|(sum, more)| *sum += sign * more)
        };
        add(plant.steady_integral(self.start_s + from_s, length_s), 1.0);
        if !self.sizes.is_empty() {
            add(plant.forced_integral(&self.sizes, to_s), 1.0);
            add(plant.forced_integral(&self.sizes, from_s), -1.0);
        }
        let [from, to] = [from_s, to_s].map(|time_s| time_s / self.length_s);
        let weights = |count: usize| -> Vec<f64> {
            let [before, after] = [from, to].map(|x| summed(x, count));
            after
                .iter()
                .zip(before)
                .map(|(after, before)| (after - before) * self.length_s)
                .collect()
        };
        for force in &self.forces {
            self.add_response(kernel, force, cache, &weights, &mut state);
        }
        state
    }
}

/// Returns `int_0^x P_n` of the shifted Legendre polynomials.
fn summed(x: f64, count: usize) -> Vec<f64> {
    let powers = legendre(x, count + 1);
    let of = |n: usize| {
        if n == 0 {
            x
        } else {
            (powers[n + 1] - powers[n - 1]) / (2 * (2 * n + 1)) as f64
        }
    };
    (0..count).map(of).collect()
}
