//! Exact response of the plant to a drive that is linear in time.
//!
//! With `y' = A y + b (u + s t)`, a block responds to a drive in one of two ways:
//!
//! ```text
//! following   P(t) = rest (u + s t) + lag s,                           rest = -A^-1 b,   lag = A^-1 rest
//! local       P(t) = sum_j A^(j-1) b (u t^j / j! + s t^(j+1) / (j+1)!),  j = 1, 2, ...
//! ```
//!
//! so `y - P` evolves as without a drive. If the slope changes by `ds` and the value jumps by `du`,
//! the state is continuous and `y - P` jumps by `-rest du - lag ds`. Blocks that are slow relative
//! to the samples of a drive (free bodies are the slowest) are local to it: their `lag` and its
//! roundoff would be far larger than their motion. Their `P` is reset at each step.
//!
//! Each drive has its own local blocks: a constant has no samples, so that only free bodies are
//! local to it, also next to a drive with fine samples.

mod base_motion;
pub(super) mod signal;
pub(super) mod tone;

use super::{BridgeNodes, Plant, Signal};
use crate::drive::Wave;

/// Response to a signal of unit value, in block coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Forcing {
    /// `b`.
    pub column: Vec<f64>,
    /// States of the blocks that are local to the signal.
    pub is_local: Vec<bool>,
    /// Largest `|eigenvalue|` of these blocks, rad/s; 0 where only free bodies without losses are
    /// local.
    pub fastest_local_rad_s: f64,
    /// Response of following blocks to a value; 0 in local blocks.
    pub rest: Vec<f64>,
    /// Response of following blocks to a slope, s; 0 in local blocks.
    pub lag: Vec<f64>,
    /// `b` in local blocks; 0 in following blocks.
    pub local: Vec<f64>,
}

/// Value and slope of a signal.
pub type SignalSample = [f64; 2];

/// `|eigenvalue|` times the sampling step below which a block is local.
const LOCAL_BLOCK_RATE: f64 = 0.5;

/// Terms of the series of local blocks: with `|eigenvalue| t` up to 0.5 (`LOCAL_BLOCK_RATE`) the
/// first omitted term is below 1e-17 of their sum.
pub const LOCAL_TERMS: usize = 16;

/// Term of such a series, relative to its sum, below which the series is complete: less than half a
/// unit in the last place, and each further term is less than half of the one before.
pub const NEGLIGIBLE_TERM: f64 = 1e-17;

impl Forcing {
    pub(super) fn of(plant: &Plant, signal: &Signal) -> Self {
        let block = &plant.diagonal.block;
        let column = plant.signal_column(signal);
        let is_local = plant.local_states(signal);
        let rest: Vec<f64> = block
            .solve(&column, &is_local)
            .into_iter()
            .map(|x| -x)
            .collect();
        let local = column
            .iter()
            .zip(&is_local)
            .map(|(b, local)| if *local { *b } else { 0.0 })
            .collect();
        Self {
            lag: block.solve(&rest, &is_local),
            fastest_local_rad_s: plant.fastest_rad_s_of(&is_local),
            is_local,
            rest,
            column,
            local,
        }
    }
}

/// Returns the longest step that the series of local blocks of at most some `|eigenvalue|` allows, s.
pub fn local_limit_s(fastest_rad_s: f64) -> f64 {
    LOCAL_BLOCK_RATE / fastest_rad_s
}

impl Plant {
    /// Returns the states of the blocks that are local to a signal: states without a restoring
    /// effect, and states that are slow relative to its samples.
    fn local_states(&self, signal: &Signal) -> Vec<bool> {
        let slowest_mode_rad_s = || {
            let modes_rad_s = self.system.modes.frequency_rad_s.iter().copied();
            modes_rad_s.filter(|w| *w > 0.0).reduce(f64::min)
        };
        let changes_per_s = match signal.wave {
            Wave::Sampled { step_s, .. } => 1.0 / step_s,
            // A current that is held drives a storage far from any equilibrium: what matters is the
            // change over a time of the structure.
            _ if signal.drawn_from.is_some() => slowest_mode_rad_s().unwrap_or(0.0),
            _ => 0.0,
        };
        let fastest_rad_s = LOCAL_BLOCK_RATE * changes_per_s;
        let block = &self.diagonal.block;
        block
            .free()
            .into_iter()
            .zip(block.eigenvalue_magnitudes_rad_s())
            .map(|(free, rad_s)| free || rad_s <= fastest_rad_s)
            .collect()
    }

    /// Returns the largest `|eigenvalue|` of some states, rad/s; 0 where they only belong to free
    /// bodies without losses.
    fn fastest_rad_s_of(&self, states: &[bool]) -> f64 {
        let block = &self.diagonal.block;
        let zero = block.zero_rate();
        let magnitudes = block.eigenvalue_magnitudes_rad_s().into_iter().zip(states);
        magnitudes
            .filter(|(rad_s, is_one)| **is_one && *rad_s > zero)
            .fold(0.0_f64, |max, (rad_s, _)| max.max(rad_s))
    }

    /// Returns `P`, the forced part of the state under signals, a time after the reset of local
    /// blocks.
    pub fn forced(&self, sizes: &[SignalSample], after_s: f64) -> Vec<f64> {
        let mut state = vec![0.0; self.len()];
        self.add_forced(sizes, after_s, &mut state);
        state
    }

    /// Adds `P` to a state.
    pub fn add_forced(&self, sizes: &[SignalSample], after_s: f64, state: &mut [f64]) {
        for (forcing, [size, slope]) in self.forcings.iter().zip(sizes) {
            let now = size + slope * after_s;
            for (sum, (rest, lag)) in state.iter_mut().zip(forcing.rest.iter().zip(&forcing.lag)) {
                *sum += rest * now + lag * slope;
            }
            if after_s > 0.0 {
                let (mut power, mut factor) = (forcing.local.clone(), after_s);
                for j in 1..=LOCAL_TERMS {
                    let weight = factor * (size + slope * after_s / (j + 1) as f64);
                    state
                        .iter_mut()
                        .zip(&power)
                        .for_each(|(sum, p)| *sum += weight * p);
                    power = self.diagonal.block.apply(&power);
                    factor *= after_s / (j + 1) as f64;
                }
            }
        }
    }

    /// Returns the equilibrium under constant drives alone, in block coordinates; 0 in states
    /// without a restoring effect.
    pub fn resting(&self) -> Vec<f64> {
        let block = &self.diagonal.block;
        let mut state = vec![0.0; self.len()];
        for (signal, forcing) in self.system.signals.iter().zip(&self.forcings) {
            if let Wave::Constant(size) = signal.wave {
                let rest = block.solve(&forcing.column, &block.free());
                state
                    .iter_mut()
                    .zip(rest)
                    .for_each(|(sum, x)| *sum -= size * x);
            }
        }
        state
    }

    /// Returns the equilibrium as a physical state `(q, q', V, i)`.
    pub fn resting_physical(&self) -> Vec<f64> {
        let steady = self.steady_at(0.0);
        self.to_physical(
            &self
                .resting()
                .iter()
                .zip(steady)
                .map(|(y, steady)| y - steady)
                .collect::<Vec<f64>>(),
            0.0,
        )
    }

    /// Sets the voltage of each isolated node of a physical state so that its charge `C V + theta . q`
    /// is that at equilibrium: nothing discharges it, so that a motion keeps the charge with which it
    /// starts.
    pub fn keep_charges(&self, state: &mut [f64]) {
        let (electrical, first) = (&self.electrical, 2 * self.system.modes.len());
        let is_rectified = |node: usize| {
            let ends =
                |bridge: &BridgeNodes| bridge.terminal == node || bridge.storage == Some(node);
            electrical.bridges.iter().any(ends)
        };
        let rest = self.resting_physical();
        for (index, node) in electrical.nodes.iter().enumerate() {
            if electrical.is_open(index) && !is_rectified(index) {
                let motion = state.iter().zip(&rest).map(|(x, rest)| x - rest);
                let displaced_c: f64 = (node.coupling_n_per_v.iter().zip(motion))
                    .map(|(theta, q)| theta * q)
                    .sum();
                state[first + index] = rest[first + index] - displaced_c / node.capacitance_f;
            }
        }
    }
}
