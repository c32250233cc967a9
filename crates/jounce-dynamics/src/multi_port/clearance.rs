//! Ports too far from their stops to be monitored.
//!
//! Blocks decay, so that the speed of a port in flight is at most
//! `V = sum_k |c_k| |y_k| + sum |S| w`. `c` is the row of its velocity and `y` the state at its
//! last update. The force of another port adds at most `G = sum_k |c_k| |b_k|` per unit of its
//! impulse `J`. A port at a distance `d` at its last update is clear as long as `(V + G J) t < d`;
//! no further test is needed.

use crate::flow::layout::StateLayout;
use crate::flow::state::dot_abs;
use crate::integrator::Integrator;
use crate::ports::phasor::Phasor;
use crate::ports::state::ContactState;
use jounce_model::contact::Law;
use jounce_model::plant::{BlockDiagonal, BlockPair, Plant, Port};
use jounce_simd::{F64x8, Simd};

/// Factor on the impulse of a step computed from its nodes: on any accepted step their quadrature
/// is far more accurate than a tenth.
const IMPULSE_MARGIN: f64 = 1.1;

/// Bound on the speed of a port.
#[derive(Debug, Clone)]
pub struct SpeedBound {
    /// Factors on the magnitudes of the state, 1/s, padded.
    row: Vec<F64x8>,
    /// Contribution of the tones, m/s.
    tones_m_s: f64,
    /// `G` for each port that acts, 1/kg.
    per_impulse: Vec<f64>,
}

/// Bounds on the motion of a port since its last update.
#[derive(Debug, Clone, Copy, Default)]
pub struct Clearance {
    /// Time of the update, s.
    since_s: f64,
    /// Distance from its stop at the update, m.
    distance_m: f64,
    /// Bound on the speed since the update, m/s.
    speed_m_s: f64,
    /// True where penetration and rate belong to another time.
    pub is_unseen: bool,
}

impl SpeedBound {
    /// Returns the bound for a port; `None` where no simple bound exists: signals, rigid stops,
    /// bridges, and blocks that grow before they decay.
    pub fn of(plant: &Plant, layout: &StateLayout, tones: &[Phasor], port: usize) -> Option<Self> {
        let block = &plant.diagonal.block;
        let grows = |pair: &BlockPair| !matches!(pair, BlockPair::Oscillatory { .. });
        let is_rigid = plant
            .system
            .stops
            .iter()
            .any(|stop| matches!(stop.law, Law::Rigid(_)));
        let is_simple = plant.forcings.is_empty()
            && plant.system.bridges.is_empty()
            && !is_rigid
            && !block.pairs.iter().any(grows);
        if plant.ports.len() < 2 || !is_simple {
            return None;
        }
        let sizes = magnitudes(block, &plant.ports[port].velocity);
        let response = |other: &Port| {
            sizes
                .iter()
                .zip(&other.force)
                .map(|(c, b)| c * b.abs())
                .sum()
        };
        Some(Self {
            row: layout.pack(&sizes),
            tones_m_s: tones
                .iter()
                .map(|tone| tone.displacement_m[port].norm() * tone.angular_frequency_rad_s)
                .sum(),
            per_impulse: plant.ports.iter().map(response).collect(),
        })
    }
}

/// Returns bounds on the effect of each state on an output while its block decays: a pair rotates.
fn magnitudes(block: &BlockDiagonal, row: &[f64]) -> Vec<f64> {
    let paired = 2 * block.pairs.len();
    let size = |(k, c): (usize, &f64)| {
        if k < paired {
            c.hypot(row[k ^ 1])
        } else {
            c.abs()
        }
    };
    row.iter().enumerate().map(size).collect()
}

impl Integrator<'_> {
    /// True when no port in flight can touch within a time, under an impulse of another port; the
    /// ports are not updated.
    #[inline(always)]
    pub(crate) fn all_stay_clear<W: Simd>(
        &mut self,
        w: W,
        length_s: f64,
        push: (usize, f64),
    ) -> bool {
        let mut all = true;
        for q in 0..self.kernel.plant.ports.len() {
            if self.ports[q].contact_state == ContactState::Flight {
                all &= self.stays_clear(w, q, length_s, Some(push));
            }
        }
        all
    }

    /// True when a port in flight cannot touch within a time, under an impulse of another port; the
    /// port is not updated.
    #[inline(always)]
    pub(crate) fn stays_clear<W: Simd>(
        &mut self,
        w: W,
        q: usize,
        length_s: f64,
        push: Option<(usize, f64)>,
    ) -> bool {
        let Some(bound) = &self.ports[q].rows.speed_bound else {
            return false;
        };
        let gain_m_s = push.map_or(0.0, |(p, impulse_n_s)| {
            IMPULSE_MARGIN * bound.per_impulse[p] * impulse_n_s
        });
        let end_s = self.time_s + length_s;
        let holds = |known: &Clearance| {
            (known.speed_m_s + gain_m_s) * (end_s - known.since_s) < known.distance_m
        };
        if !holds(&self.ports[q].clearance) {
            let speed_m_s = dot_abs(w, &bound.row, &self.y) + bound.tones_m_s;
            self.update_free_port(w, q);
            let port = &mut self.ports[q];
            port.clearance = Clearance {
                since_s: self.time_s,
                distance_m: -port.penetration_m,
                speed_m_s,
                is_unseen: false,
            };
            if !holds(&port.clearance) {
                return false;
            }
        }
        let known = &mut self.ports[q].clearance;
        known.speed_m_s += gain_m_s;
        known.is_unseen = true;
        true
    }

    /// Updates a port that has not been updated.
    #[inline(always)]
    pub(crate) fn update_free_port<W: Simd>(&mut self, w: W, q: usize) {
        if std::mem::take(&mut self.ports[q].clearance.is_unseen) {
            self.update_port(w, q);
        }
    }

    /// Resets the bounds of the ports in flight after a push that was not counted.
    #[inline(always)]
    pub(super) fn forget_clearances(&mut self) {
        self.ports
            .iter_mut()
            .for_each(|port| port.clearance.distance_m = 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest speed over a long time stays below the bound, and is more than half of it.
    #[test]
    fn no_motion_is_faster_than_its_bound() {
        let pairs = vec![
            BlockPair::Oscillatory {
                decay: -0.01,
                frequency: 3.0,
            },
            BlockPair::Oscillatory {
                decay: -0.02,
                frequency: 7.1,
            },
        ];
        let block = BlockDiagonal {
            pairs,
            reals: vec![-0.5],
        };
        let (row, start) = ([0.3, -0.4, 0.1, 0.2, -0.6], [1.0_f64, 0.5, -0.2, 0.3, 0.4]);
        let sizes = magnitudes(&block, &row);
        assert_eq!(
            sizes,
            vec![0.5, 0.5, 0.1_f64.hypot(0.2), 0.1_f64.hypot(0.2), 0.6]
        );
        let bound: f64 = sizes.iter().zip(&start).map(|(c, y)| c * y.abs()).sum();
        let speed = |t: f64| {
            row.iter()
                .zip(block.flow(t, &start))
                .map(|(c, y)| c * y)
                .sum::<f64>()
                .abs()
        };
        let fastest = (0..20_000)
            .map(|k| speed(0.001 * f64::from(k)))
            .fold(0.0, f64::max);
        assert!(
            fastest < bound && fastest > 0.5 * bound,
            "{fastest} {bound}"
        );
    }
}
