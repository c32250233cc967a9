//! Conversion between physical states and block coordinates.

use super::{Plant, Tone, product};
use jounce_linalg::c64;

impl Plant {
    /// Returns the voltage of each patch in a physical state, V.
    pub fn patch_voltages_v(&self, x: &[f64]) -> Vec<f64> {
        let nodes = &x[2 * self.system.modes.len()..];
        self.electrical
            .patch
            .iter()
            .map(|parts| {
                parts
                    .iter()
                    .map(|(node, factor)| factor * nodes[*node])
                    .sum()
            })
            .collect()
    }

    /// Returns the row for each patch whose product with a physical state is its voltage, V.
    pub fn patch_voltage_rows(&self) -> Vec<Vec<f64>> {
        let first = 2 * self.system.modes.len();
        self.electrical
            .patch
            .iter()
            .map(|parts| {
                let mut row = vec![0.0; self.len()];
                for (node, factor) in parts {
                    row[first + *node] += factor;
                }
                row
            })
            .collect()
    }

    /// Returns the block coordinates of a physical state `(q, q', V, i)` at time `t`, without the
    /// steady part.
    pub fn from_physical(&self, x: &[f64], time_s: f64) -> Vec<f64> {
        let steady = self.steady_at(time_s);
        let mut y = product(&self.diagonal.from_physical, &self.counted(x));
        y.iter_mut()
            .zip(&steady)
            .for_each(|(y, steady)| *y -= steady);
        y
    }

    /// Returns the physical state `(q, q', V, i)` at time `t` for block coordinates `y`.
    pub fn to_physical(&self, y: &[f64], time_s: f64) -> Vec<f64> {
        let steady = self.steady_at(time_s);
        let full: Vec<f64> = y.iter().zip(&steady).map(|(y, s)| y + s).collect();
        let mut x = product(&self.diagonal.to_physical, &full);
        x[2 * self.system.modes.len()..]
            .iter_mut()
            .zip(&self.electrical.zero_v)
            .for_each(|(v, zero)| *v += zero);
        x
    }

    /// Returns the time integral of one entry of the physical state, from integrated block
    /// coordinates.
    pub fn integral_of(&self, y: &[f64], length_s: f64, state_index: usize) -> f64 {
        let matrix = &self.diagonal.to_physical;
        let zero_v = state_index
            .checked_sub(2 * self.system.modes.len())
            .and_then(|node| self.electrical.zero_v.get(node));
        y.iter()
            .enumerate()
            .map(|(j, y)| matrix[(state_index, j)] * y)
            .sum::<f64>()
            + zero_v.map_or(0.0, |zero_v| zero_v * length_s)
    }

    /// Returns the rate of the block coordinates for a physical state and its rate at a time.
    pub fn moving(&self, rate: &[f64], time_s: f64) -> Vec<f64> {
        let turning = |i: usize| -> f64 {
            let of = |tone: &Tone| {
                (c64::cis(tone.angular_frequency_rad_s * time_s)
                    * tone.steady[i]
                    * c64::new(0.0, tone.angular_frequency_rad_s))
                .re
            };
            self.tones.iter().map(of).sum()
        };
        product(&self.diagonal.from_physical, rate)
            .iter()
            .enumerate()
            .map(|(i, velocity)| velocity - turning(i))
            .collect()
    }

    /// Returns a physical state with each voltage measured from the zero of its node.
    fn counted(&self, x: &[f64]) -> Vec<f64> {
        let mut counted = x.to_vec();
        counted[2 * self.system.modes.len()..]
            .iter_mut()
            .zip(&self.electrical.zero_v)
            .for_each(|(v, zero)| *v -= zero);
        counted
    }
}
