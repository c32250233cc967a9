//! A plant laid out for marching: padded block data, the rows of each port, and level tables made when first used.
//!
//! Steps have lengths `2^-e` seconds, so that tables are shared by all runs of a plant, whatever its drive.

use super::lane::{Lane, WIDTH};
use super::table::Table;
use crate::plant::{Meters, Pair, Plant, PlantError};
use std::sync::{Arc, OnceLock};

/// Exponents `e` of the level lengths run from here ...
const COARSEST: i32 = -12;
/// ... to here.
const FINEST: i32 = 60;

/// A plant with its step tables.
#[derive(Debug)]
pub struct Kernel {
    /// The plant.
    pub plant: Plant,
    /// Its energy meters.
    pub meters: Meters,
    /// Per port and level; they depend on the plant without its drives only, so that plants that differ in drives share them.
    levels: Arc<Vec<Vec<OnceLock<Box<Table>>>>>,
}

/// Where the numbers of a state stand: `u` of all pairs, then `v` of all pairs, then the reals, each padded to whole lanes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Number of pairs.
    pub pairs: usize,
    /// Number of reals.
    pub reals: usize,
    /// Lanes of `u` (and of `v`).
    pub pair_lanes: usize,
    /// Lanes of the reals.
    pub real_lanes: usize,
}

impl Layout {
    /// Layout of a plant.
    pub fn of(plant: &Plant) -> Self {
        let block = &plant.diagonal.block;
        let (pairs, reals) = (block.pairs.len(), block.reals.len());
        Self { pairs, reals, pair_lanes: pairs.div_ceil(WIDTH), real_lanes: reals.div_ceil(WIDTH) }
    }

    /// Lanes of a state.
    pub fn lanes(&self) -> usize {
        2 * self.pair_lanes + self.real_lanes
    }

    /// Lane and place of state number `state` in block order `u0, v0, u1, ...`.
    pub fn place(&self, state: usize) -> (usize, usize) {
        let (base, index) = match state.checked_sub(2 * self.pairs) {
            Some(real) => (2 * self.pair_lanes, real),
            None => ((state % 2) * self.pair_lanes, state / 2),
        };
        (base + index / WIDTH, index % WIDTH)
    }

    /// Block order to padded lanes.
    pub fn pack(&self, values: &[f64]) -> Vec<Lane> {
        let mut lanes = vec![Lane::ZERO; self.lanes()];
        for (state, value) in values.iter().enumerate() {
            let (lane, place) = self.place(state);
            lanes[lane].0[place] = *value;
        }
        lanes
    }

    /// Padded lanes to block order.
    pub fn unpack(&self, lanes: &[Lane]) -> Vec<f64> {
        (0..2 * self.pairs + self.reals)
            .map(|state| {
                let (lane, place) = self.place(state);
                lanes[lane].0[place]
            })
            .collect()
    }

    /// Block order to column order `u0, u1, .., v0, v1, .., r0, ..`, in which states meet their columns.
    pub fn column_order(&self) -> Vec<usize> {
        let pairs = self.pairs;
        (0..pairs).map(|k| 2 * k).chain((0..pairs).map(|k| 2 * k + 1)).chain(2 * pairs..2 * pairs + self.reals).collect()
    }
}

impl Kernel {
    /// Prepares a plant for marching.
    ///
    /// # Errors
    /// [`PlantError::Undamped`].
    pub fn new(plant: Plant) -> Result<Self, PlantError> {
        let meters = Meters::new(&plant)?;
        let ports = plant.ports.len().max(1);
        let count = (FINEST - COARSEST + 1) as usize;
        let levels = (0..ports).map(|_| (0..count).map(|_| OnceLock::new()).collect()).collect();
        Ok(Self { plant, meters, levels: Arc::new(levels) })
    }

    /// The same plant under other drives, the tables made so far kept.
    ///
    /// # Errors
    /// [`PlantError::UndampedResonance`].
    pub fn with_drives(&self, drives: Vec<crate::plant::Drive>) -> Result<Self, PlantError> {
        let plant = self.plant.with_drives(drives)?;
        let meters = self.meters.with_drives(&plant)?;
        Ok(Self { plant, meters, levels: Arc::clone(&self.levels) })
    }

    /// Row of the relative acceleration of the first port, the contact force left out: `(A^T c_v)`.
    pub fn acceleration_row(&self) -> Vec<f64> {
        let block = &self.plant.diagonal.block;
        let velocity = &self.plant.ports[0].velocity;
        let mut row = Vec::with_capacity(velocity.len());
        for (pair, c) in block.pairs.iter().zip(velocity.chunks_exact(2)) {
            let [a, b, d, e] = pair.matrix();
            row.extend([c[0] * a + c[1] * d, c[0] * b + c[1] * e]);
        }
        row.extend(block.reals.iter().zip(&velocity[2 * block.pairs.len()..]).map(|(rate, c)| rate * c));
        row
    }

    /// Length of a level, s.
    pub fn length_s(level: i32) -> f64 {
        2.0_f64.powi(-level)
    }

    /// Finest level there is.
    pub const fn finest() -> i32 {
        FINEST
    }

    /// Coarsest level there is.
    pub const fn coarsest() -> i32 {
        COARSEST
    }

    /// Coarsest level not longer than a time.
    pub fn level_within(time_s: f64) -> i32 {
        (-time_s.log2().floor()).clamp(f64::from(COARSEST), f64::from(FINEST)) as i32
    }

    /// Table of a level for a port.
    pub fn table(&self, port: usize, level: i32) -> &Table {
        self.levels[port][(level - COARSEST) as usize].get_or_init(|| Box::new(Table::new(self, port, Self::length_s(level))))
    }

    /// Bound on the fourth derivative of one block's share of an output row: factors for `|u|` and `|v|`, and its speed, rad/s.
    pub fn fourth_derivative(pair: &Pair, row: [f64; 2], length_s: f64) -> ([f64; 2], f64) {
        match *pair {
            Pair::Oscillatory { .. } => {
                let speed = pair.eigenvalue().norm();
                let gain = row[0].hypot(row[1]) * speed.powi(4);
                ([gain, gain], speed)
            }
            // w = (c_u u + c_v v + c_u v t) e^{r t}, r <= 0
            Pair::Jordan { rate } => {
                let [cu, cv] = [row[0].abs(), row[1].abs()];
                let r = rate.abs();
                ([cu * r.powi(4), (cv + cu * length_s) * r.powi(4) + 4.0 * cu * r.powi(3)], r)
            }
        }
    }
}
