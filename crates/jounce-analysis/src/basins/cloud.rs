//! Seeded random cloud of starts.
//!
//! Every mode has the same range of energy: `w q` and `q'` are uniform in `[-S, S]`, `S = spread
//! w_drive L / |shape|`. `L` is the larger of the gap and the steady amplitude at the stop, and
//! `|shape|` the norm of the port's shape. The centre is the static equilibrium under gravity, and
//! the voltages start there; those of isolated patches with the charge at equilibrium. The numbers are those of [`RandomStream`].
//!
//! A start inside a rigid stop is mirrored, `q - 2 (s q - gap) s / |s|^2`, until it is outside all
//! stops.

use jounce_model::contact::Law;
use jounce_model::plant::{Plant, Stop};
use jounce_signal::RandomStream;

/// Largest number of reflections of a start: between two stops it may start many gaps away.
const MAX_REFLECTIONS: usize = 1000;

/// Random cloud of starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cloud {
    /// Number of starts.
    pub starts: usize,
    /// Seed.
    pub seed: u64,
    /// Size, in gaps (or steady amplitudes, where larger).
    pub spread: f64,
}

impl Cloud {
    /// Returns start number `index` as a physical state `(q, q', V)`; it depends only on the seed
    /// and the index.
    pub fn start(&self, plant: &Plant, index: usize) -> Vec<f64> {
        let modes = &plant.system.modes;
        let n = modes.len();
        let drive = plant
            .tones
            .first()
            .map_or(1.0, |tone| tone.angular_frequency_rad_s);
        let shape = plant
            .ports
            .iter()
            .map(|port| port.mobility_per_kg.sqrt())
            .reduce(f64::max)
            .unwrap_or(1.0);
        let size = self.spread * drive * plant.scale_m() / shape;
        let mut state = plant.resting_physical();
        // Each start has its own stream, from the seed and its index.
        let mut stream = RandomStream::new(self.seed, index as u64);
        for i in 0..n {
            let w = if modes.frequency_rad_s[i] > 0.0 {
                modes.frequency_rad_s[i]
            } else {
                drive
            };
            state[i] += size * stream.symmetric() / w;
            state[n + i] += size * stream.symmetric();
        }
        mirror(plant, &mut state);
        plant.keep_charges(&mut state);
        state
    }
}

/// Mirrors displacements out of rigid stops, as far as there is room between them.
fn mirror(plant: &Plant, displacement: &mut [f64]) {
    let stops = plant.system.stops.iter().enumerate();
    let rigid: Vec<_> = stops
        .filter(|(_, stop)| matches!(stop.law, Law::Rigid(_)))
        .collect();
    for _ in 0..MAX_REFLECTIONS {
        let depth_m = |(index, stop): (usize, &Stop)| {
            let modal_m: f64 = stop
                .shape
                .iter()
                .zip(&*displacement)
                .map(|(s, q)| s * q)
                .sum();
            modal_m + plant.approached_m(index, 0.0) - stop.gap_m
        };
        let depths = rigid
            .iter()
            .map(|(index, stop)| (*stop, depth_m((*index, stop))));
        let Some((stop, depth_m)) = depths.into_iter().find(|(_, depth_m)| *depth_m > 0.0) else {
            return;
        };
        let square: f64 = stop.shape.iter().map(|s| s * s).sum();
        displacement
            .iter_mut()
            .zip(&stop.shape)
            .for_each(|(q, s)| *q -= 2.0 * depth_m * s / square);
    }
}
