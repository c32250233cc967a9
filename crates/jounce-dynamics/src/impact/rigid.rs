//! Rigid stop: exact flight between impacts, impacts as velocity jumps, and sticking to the stop.
//!
//! An impact changes the relative speed `v` to `-e v` by the impulse `p = (1 + e) v / M`, with the
//! mobility `M` of the port (1/kg). The energy loss is `(1 - e^2) v^2 / (2 M)`. Where the motion
//! presses the point onto the stop, impacts accumulate in finite time (chatter). Once the speed is
//! below the tolerance, the remaining impacts are omitted and the point sticks. While it sticks the
//! contact force holds its relative acceleration at zero,
//!
//! ```text
//! a . y(t) + a_drive(t) - M f(t) = 0,
//! ```
//!
//! collocated at the nodes of a step as for compliant stops; the point leaves when the force would
//! have to pull.

use crate::flow::state::dot;
use crate::integrator::Integrator;
use crate::ports::state::ContactState;
use jounce_model::contact::Rigid;
use jounce_simd::{F64x8, Portable};
use std::sync::Arc;

/// Height of a hop, in units of the roundoff of the distance, below which its end cannot be
/// resolved.
const MIN_HOP_HEIGHT: f64 = 64.0;

/// Height of a hop, in units of its distance past the stop at the start, below which it is ignored.
const MIN_HOP_PAST_STOP: f64 = 2.0;

/// Speed after an impact, relative to the scale of speeds, above which a hop is always high enough.
const FAST_HOP_SPEED: f64 = 1e-3;

/// Speed after an impact, relative to the largest impact speed and the tolerance, below which
/// chatter ends.
const CHATTER_SPEED: f64 = 1e-2;

impl Integrator<'_> {
    /// Applies one impact; it ends in flight, or in sticking where chatter has ended.
    pub(crate) fn impact(&mut self, p: usize, law: Rigid) {
        let (before, mobility, rebound) = (
            self.ports[p].rate_m_s,
            self.ports[p].rows.mobility_per_kg,
            self.rebound(p, law),
        );
        self.push_by(p, (1.0 + rebound) * before / mobility);
        self.integrals.loss_j += 0.5 * (1.0 - rebound * rebound) * before * before / mobility;
        self.rebounds(p, -rebound * before);
        if rebound == 0.0 && self.ports[p].contact_state == ContactState::Contact {
            // The omitted bounces, a geometric series, do not count as sticking.
            let omitted_s = 2.0 * law.restitution * before
                / ((1.0 - law.restitution) * self.pressing_acceleration_m_s2(p));
            self.ports[p].statistics.sticking_s -= if omitted_s.is_finite() {
                omitted_s
            } else {
                0.0
            };
        }
    }

    /// Returns the ratio of the speeds after and before an impact: the restitution, or zero for a
    /// rebound that is negligible or within roundoff.
    pub(crate) fn rebound(&self, p: usize, law: Rigid) -> f64 {
        let (after, impact_velocity_m_s) = (
            law.restitution * self.ports[p].rate_m_s,
            self.ports[p].impact_velocity_m_s,
        );
        let is_slow = after <= CHATTER_SPEED * self.tolerance * impact_velocity_m_s;
        let is_suppressed =
            || self.is_suppressed_hop(p, [self.reading(Portable::new(), p)[0], after]);
        if is_slow || (after <= FAST_HOP_SPEED * self.speed_m_s(p) && is_suppressed()) {
            0.0
        } else {
            law.restitution
        }
    }

    /// True for a hop that starts at a speed past the stop by roundoff and is pressed back before
    /// it leaves the stop by more than the roundoff of the distance.
    pub(crate) fn is_suppressed_hop(&self, p: usize, [depth_m, rate_m_s]: [f64; 2]) -> bool {
        let least_m =
            MIN_HOP_HEIGHT * self.distance_roundoff_m(p) + MIN_HOP_PAST_STOP * depth_m.max(0.0);
        // Where the pressing acceleration is roundoff the point leaves: sticking would release it
        // at once.
        rate_m_s * rate_m_s <= 2.0 * self.pressing_acceleration_m_s2(p) * least_m
            && self.is_pressed(p)
    }

    /// Sets a point that leaves an impact at a speed: it flies, or sticks where it has no speed and
    /// is pressed.
    pub(crate) fn rebounds(&mut self, p: usize, rate_m_s: f64) {
        self.set_motion(p, [0.0, rate_m_s]);
        if rate_m_s != 0.0 || !self.is_pressed(p) {
            self.ports[p].contact_state = ContactState::Flight;
        }
    }

    /// Changes the velocity by an impulse away from the stop, N s.
    pub(crate) fn push_by(&mut self, p: usize, impulse_n_s: f64) {
        if let Some(record) = &mut self.record {
            record.push_impact(p, impulse_n_s);
        }
        let kernel = self.kernel;
        let rows = Arc::clone(&self.ports[p].rows);
        let column = &rows.rigid(kernel, p).force;
        let middle: Vec<F64x8> = self
            .y
            .iter()
            .zip(column)
            .map(|(y, b)| y.add_scaled(0.5 * impulse_n_s, b))
            .collect();
        // For the meters, the integral over an instantaneous force is the force times the mean of
        // the states before and after.
        for (sum, meter) in self
            .integrals
            .loads_j
            .iter_mut()
            .zip(&kernel.meters().loads)
        {
            *sum += impulse_n_s
                * dot(
                    Portable::new(),
                    &self.layout.pack(meter.port_row(p)),
                    &middle,
                );
        }
        self.integrals.damping_j += impulse_n_s
            * dot(
                Portable::new(),
                &self.layout.pack(kernel.meters().damping.port_row(p)),
                &middle,
            );
        for (sum, tone) in self.integrals.tones_n_s[p].iter_mut().zip(&self.tones) {
            *sum += tone.turn * impulse_n_s;
        }
        self.excitation.strike_stop(p, self.time_s, impulse_n_s);
        self.ports[p].statistics.impulse_n_s += impulse_n_s;
        self.y
            .iter_mut()
            .zip(column)
            .for_each(|(y, b)| *y = y.add_scaled(impulse_n_s, b));
    }
}
