//! A seeded cloud of starts.
//!
//! Every mode gets the same range of energy: `w q` and `q'` are uniform in `[-S, S]`, `S = spread w_drive L / |shape|`, with `L` the
//! larger of the gap and the steady amplitude at the stop and `|shape|` the norm of the port's shape, about where gravity holds the
//! harvester. Voltages start there too. The numbers are those of [`Stream`].

use crate::drive::Stream;
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
        let shape = plant.ports.iter().map(|port| port.mobility_per_kg.sqrt()).reduce(f64::max).unwrap_or(1.0);
        let size = self.spread * drive * plant.scale_m() / shape;
        let mut state = plant.resting_physical();
        // Starts do not share a stream: each has its own, from the seed and its number.
        let mut stream = Stream::new(self.seed, index as u64);
        for i in 0..n {
            let w = if modes.frequency_rad_s[i] > 0.0 { modes.frequency_rad_s[i] } else { drive };
            state[i] += size * stream.symmetric() / w;
            state[n + i] += size * stream.symmetric();
        }
        state
    }
}
