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
use crate::excitation::row::ExcitationRow;
use crate::force_response::basis::legendre;
use crate::kernel::Kernel;
use jounce_model::plant::{BlockDiagonal, Plant};

impl Trajectory {
    /// Returns the integral of one component of the physical state `(q, q', V, i)` over an interval
    /// within the record.
    pub fn integral(&self, kernel: &Kernel, from_s: f64, to_s: f64, state_index: usize) -> f64 {
        let mut cache = ResponseCache::default();
        let mut forced_rows: Vec<(usize, ExcitationRow)> = Vec::new();
        let mut free_row = FreeRow::default();
        let mut sum = 0.0;
        for segment in self.segments() {
            let within = [from_s, to_s]
                .map(|time_s| (time_s - segment.start_s).clamp(0.0, segment.length_s));
            // The kernel of a conduction state in the record exists.
            let Ok(state_kernel) = kernel.in_conduction_state(segment.conduction_state) else {
                continue;
            };
            let length_s = within[1] - within[0];
            if length_s <= 0.0 {
                continue;
            }
            let plant = &state_kernel.plant;
            free_row.choose(plant, (segment.conduction_state, length_s), state_index);
            sum += match within[0] == 0.0 {
                true => free_row.times(&segment.state),
                false => free_row.times(&plant.diagonal.block.flow(within[0], &segment.state)),
            };
            let driven = segment.driven_integral(state_kernel, within, &mut cache);
            sum += plant.integral_of(&driven, length_s, state_index);
            if !segment.sizes.is_empty() {
                let is_this = |(state, _): &(usize, _)| *state == segment.conduction_state;
                let known = forced_rows.iter().position(is_this).unwrap_or_else(|| {
                    let row = ExcitationRow::of_physical(plant, state_index);
                    forced_rows.push((segment.conduction_state, row));
                    forced_rows.len() - 1
                });
                let forced = forced_rows[known].1.series(&segment.sizes, within[1]);
                sum += forced.integral(within[1]) - forced.integral(within[0]);
            }
        }
        sum
    }
}

/// Row whose product with the state at the start of a step is the integral of a component of the
/// free motion; most steps have the length of the one before.
#[derive(Default)]
struct FreeRow {
    /// Conduction state and length, s.
    of: Option<(usize, f64)>,
    row: Vec<f64>,
}

impl FreeRow {
    fn choose(&mut self, plant: &Plant, of: (usize, f64), state_index: usize) {
        if self.of != Some(of) {
            let block: &BlockDiagonal = &plant.diagonal.block;
            let matrix = &plant.diagonal.to_physical;
            let output: Vec<f64> = (0..block.len()).map(|j| matrix[(state_index, j)]).collect();
            (self.of, self.row) = (Some(of), block.integral_row(of.1, &output));
        }
    }

    fn times(&self, state: &[f64]) -> f64 {
        self.row.iter().zip(state).map(|(r, y)| r * y).sum()
    }
}

impl TrajectorySegment {
    /// Returns the integral of the part of the state in block coordinates that sinusoids and
    /// contact forces drive, between two times after its start; empty where nothing drives it.
    fn driven_integral(
        &self,
        kernel: &Kernel,
        [from_s, to_s]: [f64; 2],
        cache: &mut ResponseCache,
    ) -> Vec<f64> {
        let plant = &kernel.plant;
        let mut state = match plant.tones.is_empty() {
            true => Vec::new(),
            false => plant.steady_integral(self.start_s + from_s, to_s - from_s),
        };
        if self.forces.is_empty() {
            return state;
        }
        state.resize(plant.len(), 0.0);
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
