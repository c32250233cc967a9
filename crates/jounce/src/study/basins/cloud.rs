//! A seeded cloud of starts.
//!
//! Every mode gets the same range of energy: `w q` and `q'` are uniform in `[-S, S]`, `S = spread w_drive L / |shape|`, with `L` the
//! larger of the gap and the steady amplitude at the stop and `|shape|` the norm of the port's shape. Voltages start at zero.
//!
//! Source of the numbers: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators" (OOPSLA 2014), SplitMix64.

use crate::plant::Plant;

/// A cloud.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cloud {
    /// Number of starts.
    pub starts: usize,
    /// Seed.
    pub seed: u64,
    /// Size, in gaps (or steady amplitudes, where those are larger).
    pub spread: f64,
}

impl Cloud {
    /// Start number `index`, physical state `(q, q', V)`: the same for the same seed, whatever else is computed.
    pub fn start(&self, plant: &Plant, index: usize) -> Vec<f64> {
        let modes = &plant.system.modes;
        let n = modes.len();
        let drive = plant.tones.first().map_or(1.0, |tone| tone.angular_frequency_rad_s);
        let shape = plant.ports.first().map_or(1.0, |port| port.mobility_per_kg.sqrt());
        let size = self.spread * drive * plant.scale_m() / shape;
        let mut state = vec![0.0; plant.len()];
        // Starts do not share a stream: each has its own, from the seed and its number.
        let mut stream = Stream(mixed(self.seed) ^ mixed(index as u64 + 1));
        for i in 0..n {
            let w = if modes.frequency_rad_s[i] > 0.0 { modes.frequency_rad_s[i] } else { drive };
            state[i] = size * stream.symmetric() / w;
            state[n + i] = size * stream.symmetric();
        }
        state
    }
}

/// A SplitMix64 generator.
struct Stream(u64);

impl Stream {
    /// Uniform in [-1, 1).
    fn symmetric(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (mixed(self.0) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_their_range_evenly() {
        let mut stream = Stream(7);
        let values: Vec<f64> = (0..20_000).map(|_| stream.symmetric()).collect();
        let mean = values.iter().sum::<f64>() / 2e4;
        let square = values.iter().map(|v| v * v).sum::<f64>() / 2e4;
        assert!(mean.abs() < 0.015 && (square - 1.0 / 3.0).abs() < 0.01, "{mean} {square}");
        assert!(values.iter().all(|v| (-1.0..1.0).contains(v)));
    }
}
