//! Rows and bounds for the proof that a flight step is free of contact (see
//! [`super::certificate`]).

use crate::flow::layout::StateLayout;
use jounce_model::plant::{BlockDiagonal, BlockPair, Port};
use jounce_simd::F64x8;

/// Tables of the certificate for a flight step of one length. All rows are padded.
#[derive(Debug, Clone)]
pub struct FlightTable {
    /// Factors of the bound on the fourth derivative of the slow part, m/s^4.
    pub slow_fourth: Vec<F64x8>,
    /// Contribution of blocks too fast for this length; `None` without such a block.
    pub fast: Option<FastBlocks>,
}

/// Blocks for which a bound on the motion is better than one on the interpolation error.
#[derive(Debug, Clone)]
pub struct FastBlocks {
    /// Row of the displacement of the slow part.
    pub slow_displacement: Vec<F64x8>,
    /// Row of the velocity of the slow part.
    pub slow_velocity: Vec<F64x8>,
    /// Factors of the bound on the displacement of the fast part, m.
    pub displacement_bound: Vec<F64x8>,
    /// Factors of the bound on the velocity of the fast part, m/s.
    pub velocity_bound: Vec<F64x8>,
}

/// `|lambda| h` above which a block counts as fast.
const FAST_BLOCK: f64 = 4.4;

/// Bounds on the contribution of one block to the displacement, as factors on the magnitudes of its
/// states.
struct BlockBounds {
    states: Vec<usize>,
    speed_rad_s: f64,
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    fourth: Vec<f64>,
    may_be_fast: bool,
}

impl FlightTable {
    /// Computes the tables for steps of one length.
    pub fn new(block: &BlockDiagonal, layout: &StateLayout, port: &Port, h: f64) -> Self {
        let n = block.len();
        let (mut fourth, mut bound, mut speed, mut slow) =
            (vec![0.0; n], vec![0.0; n], vec![0.0; n], vec![1.0; n]);
        for share in shares(block, &port.displacement, h) {
            let is_fast = share.may_be_fast && share.speed_rad_s * h >= FAST_BLOCK;
            for (i, state) in share.states.iter().enumerate() {
                if is_fast {
                    (bound[*state], speed[*state], slow[*state]) =
                        (share.displacement[i], share.velocity[i], 0.0);
                } else {
                    fourth[*state] = share.fourth[i];
                }
            }
        }
        let factors_of = |row: &[f64]| {
            layout.pack(
                &row.iter()
                    .zip(&slow)
                    .map(|(c, factor)| c * factor)
                    .collect::<Vec<_>>(),
            )
        };
        let fast = slow.contains(&0.0).then(|| FastBlocks {
            slow_displacement: factors_of(&port.displacement),
            slow_velocity: factors_of(&port.velocity),
            displacement_bound: layout.pack(&bound),
            velocity_bound: layout.pack(&speed),
        });
        FlightTable {
            slow_fourth: layout.pack(&fourth),
            fast,
        }
    }
}

impl BlockBounds {
    /// Returns the bounds of one state that decays.
    fn single(state: usize, gain: f64, speed_rad_s: f64) -> Self {
        Self {
            states: vec![state],
            speed_rad_s,
            displacement: vec![gain],
            velocity: vec![gain * speed_rad_s],
            fourth: vec![gain * speed_rad_s.powi(4)],
            may_be_fast: true,
        }
    }

    /// Returns the bounds of pair `k`, whose entries of the displacement row are `start_row`.
    fn of_pair(k: usize, pair: &BlockPair, start_row: [f64; 2], h: f64) -> Vec<Self> {
        let (states, speed_rad_s) = (vec![2 * k, 2 * k + 1], pair.eigenvalue().norm());
        let ([cu, cv], r) = (start_row.map(f64::abs), speed_rad_s);
        match *pair {
            BlockPair::Oscillatory { .. } => {
                let gain = start_row[0].hypot(start_row[1]);
                let both = |factor: f64| vec![gain * factor; 2];
                let (velocity, fourth) = (both(speed_rad_s), both(speed_rad_s.powi(4)));
                vec![Self {
                    states,
                    speed_rad_s,
                    displacement: both(1.0),
                    velocity,
                    fourth,
                    may_be_fast: true,
                }]
            }
            // w = (c_u u + c_v v + c_u v t) e^{r t}, r <= 0
            BlockPair::Jordan { .. } => {
                let fourth = vec![
                    cu * r.powi(4),
                    (cv + cu * h) * r.powi(4) + 4.0 * cu * r.powi(3),
                ];
                vec![Self {
                    states,
                    speed_rad_s,
                    displacement: vec![0.0; 2],
                    velocity: vec![0.0; 2],
                    fourth,
                    may_be_fast: false,
                }]
            }
            // w = c_u u + c_v v e^{r t} + c_u v (e^{r t} - 1) / r, r <= 0
            BlockPair::FreeBody { .. } => vec![
                Self::single(2 * k, cu, 0.0),
                Self {
                    displacement: vec![cv + cu / r],
                    velocity: vec![cv * r + cu],
                    fourth: vec![cv * r.powi(4) + cu * r.powi(3)],
                    ..Self::single(2 * k + 1, cv, r)
                },
            ],
        }
    }
}

/// Returns the bounds of all blocks. Blocks decay, so that bounds at the start of a step hold
/// throughout.
fn shares(block: &BlockDiagonal, row: &[f64], h: f64) -> Vec<BlockBounds> {
    let (paired, single) = row.split_at(2 * block.pairs.len());
    let pairs = block.pairs.iter().zip(paired.chunks_exact(2)).enumerate();
    let reals = block.reals.iter().zip(single).enumerate();
    let real = |(k, (rate, gain)): (usize, (&f64, &f64))| {
        BlockBounds::single(paired.len() + k, gain.abs(), rate.abs())
    };
    pairs
        .flat_map(|(k, (pair, uv))| BlockBounds::of_pair(k, pair, [uv[0], uv[1]], h))
        .chain(reals.map(real))
        .collect()
}
