//! Time integrals of the physical state along a record, in closed form, for example the flux of a
//! voltage.
//!
//! Each step contributes the integrals of its free flow, of the forced part of signals, of the
//! sinusoids, and of the response to its contact forces. The Legendre series of that response has
//! `int_0^x P_n = (P_{n+1} - P_{n-1}) / (2 (2 n + 1))`. Only the state at the start of a step
//! enters, so that a step that does not end where the next one begins shows as a gap.
//!
//! Validation: `crates/jounce-analysis/tests/integrate/time_integral.rs`.

use super::trajectory::{ResponseCache, Trajectory, TrajectorySegment};
use crate::excitation::row::ExcitationRow;
use crate::force_response::basis::legendre;
use crate::kernel::Kernel;
use jounce_model::plant::{Plant, SignalSample};

impl Trajectory {
    /// Returns the integral of one component of the physical state `(q, q', V, i)` over an interval
    /// within the record.
    pub fn integral(&self, kernel: &Kernel, from_s: f64, to_s: f64, state_index: usize) -> f64 {
        let mut cache = ResponseCache::default();
        let mut step = StepIntegral::of(state_index);
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
            step.choose(plant, (segment.conduction_state, within));
            sum += match within[0] == 0.0 {
                true => step.times(&segment.state),
                false => step.times(&plant.diagonal.block.flow(within[0], &segment.state)),
            };
            sum += step.of_signals(&segment.sizes);
            let driven = segment.driven_integral(state_kernel, within, &mut cache);
            sum += plant.integral_of(&driven, length_s, state_index);
        }
        sum
    }
}

/// Integral of a component of the physical state over a part of a step, as a linear function of the
/// state at its start and of the signals; most steps have the length of the one before.
struct StepIntegral {
    state_index: usize,
    /// Conduction state, and the part of the step, s.
    of: Option<(usize, [f64; 2])>,
    /// Factors on the state at the start of the part.
    row: Vec<f64>,
    /// Factors on the value and the slope of each signal at the start of the step.
    signals: Vec<[f64; 2]>,
    /// Row over the signals in each conduction state so far.
    excited: Vec<(usize, ExcitationRow)>,
}

impl StepIntegral {
    fn of(state_index: usize) -> Self {
        Self {
            state_index,
            of: None,
            row: Vec::new(),
            signals: Vec::new(),
            excited: Vec::new(),
        }
    }

    fn choose(&mut self, plant: &Plant, of: (usize, [f64; 2])) {
        if self.of == Some(of) {
            return;
        }
        let (conduction_state, [from_s, to_s]) = of;
        let (block, matrix) = (&plant.diagonal.block, &plant.diagonal.to_physical);
        let output = (0..block.len()).map(|j| matrix[(self.state_index, j)]);
        self.row = block.integral_row(to_s - from_s, &output.collect::<Vec<f64>>());
        let is_this = |(state, _): &(usize, ExcitationRow)| *state == conduction_state;
        let known = self.excited.iter().position(is_this).unwrap_or_else(|| {
            let row = ExcitationRow::of_physical(plant, self.state_index);
            self.excited.push((conduction_state, row));
            self.excited.len() - 1
        });
        self.signals.clear();
        self.signals
            .extend(self.excited[known].1.integrals(from_s, to_s));
        self.of = Some(of);
    }

    fn times(&self, state: &[f64]) -> f64 {
        self.row.iter().zip(state).map(|(r, y)| r * y).sum()
    }

    fn of_signals(&self, sizes: &[SignalSample]) -> f64 {
        let terms = self.signals.iter().zip(sizes);
        terms
            .map(|(by, size)| by[0] * size[0] + by[1] * size[1])
            .sum()
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
