//! Contact of any number of ports, and impacts on their stops.
//!
//! Each port is in flight or in contact. The ports act on each other only through the plant.
//!
//! - *All in flight*: see [`crate::flight`].
//! - *Some in contact*: one step for all of these, each with its own basis, with a common solution
//!   for the nodal forces. With the Duhamel weights `D_pq` of the displacement of port `p` under
//!   the force of port `q`,
//!
//!   ```text
//!   delta_p = free_p + sum_q D_pq f_q,   f_p = F_p(delta_p, delta_p'),
//!   ```
//!
//!   a fixed point that converges like the one of a single port. The same certificate monitors the
//!   ports in flight; the forces add a known cubic and a bounded remainder (see
//!   [`crate::flight::forced`]). Where this proves neither flight nor a first crossing, the step is
//!   shortened, down to a length on which the remainder is below the resolution of the certificate.
//!   A single compliant port in contact is solved as in [`crate::contact::step`] (see
//!   [`single_contact`]); the others, if there are any, are monitored.
//! - *A port too far off* for an impact within a step is not monitored (see [`clearance`]).
//! - *An impact during a contact* ends the step there, by Newton on its length, so that the new
//!   contact starts on its own onset.
//! - *Rigid stops*: see [`impacts`], [`joint_impact`], [`sticking`] and [`holding`].

mod clearance;
mod commit;
mod free_ports;
mod holding;
mod impacts;
mod joint_contact;
mod joint_impact;
mod joint_solve;
mod landing;
mod newton;
mod single_contact;
mod sticking;

pub(super) use clearance::{Clearance, SpeedBound};

use crate::contact::IMPULSE_ERROR_SHARE;
use crate::contact::step::{ContactStep, SolvedStep};
use crate::impact::acceleration::RESOLVED_ROUNDOFFS;
use crate::integrator::Integrator;
use crate::kernel::Kernel;
use crate::ports::state::{ContactState, PortState};
use jounce_model::contact::Law;
use jounce_simd::Simd;

/// Fraction of the first step of a contact that counts as simultaneous: a port that would have its
/// impact within it has it now.
const SIMULTANEOUS_CONTACT: f64 = 1e-13;

/// Distance, relative to its terms, below which it is roundoff.
const RESOLVED_DISTANCE: f64 = RESOLVED_ROUNDOFFS * f64::EPSILON;

impl Integrator<'_> {
    /// Iterates over the ports in a contact state, ascending.
    pub(crate) fn ports_in(&self, contact_state: ContactState) -> impl Iterator<Item = usize> {
        (0..self.kernel.plant.ports.len())
            .filter(move |p| self.ports[*p].contact_state == contact_state)
    }

    /// Returns the law of the stop of a port.
    #[inline(always)]
    fn law(&self, p: usize) -> Law {
        self.kernel.plant.system.stops[p].law
    }

    pub(crate) fn is_rigid(&self, p: usize) -> bool {
        !self.is_guard(p) && matches!(self.law(p), Law::Rigid(_))
    }

    /// True for an output that is only monitored.
    pub(crate) fn is_guard(&self, p: usize) -> bool {
        p >= self.kernel.plant.system.stops.len()
    }

    /// Returns the distance at which a point touches, m: the path of the fastest impact within the
    /// simultaneous time.
    fn touch_m(&self, p: usize) -> f64 {
        self.ports
            .iter()
            .fold(0.0_f64, |max, port| max.max(port.impact_velocity_m_s))
            * SIMULTANEOUS_CONTACT
            * Kernel::length_s(self.ports[p].entry_level)
    }

    /// Returns the impulse error of one step allowed at any port, N s: a weak contact need not be
    /// more accurate than a strong one.
    #[inline(always)]
    fn allowed_with_others_n_s(&self, steps: &[ContactStep], solved: &[SolvedStep]) -> f64 {
        let fastest = |port: &PortState| port.impact_velocity_m_s / port.rows.mobility_per_kg;
        let by_speed = self.tolerance
            * IMPULSE_ERROR_SHARE
            * self.ports.iter().map(fastest).fold(0.0, f64::max);
        let by_port = steps
            .iter()
            .zip(solved)
            .map(|(step, solution)| self.allowed_n_s(step, Some(solution)));
        by_port.fold(by_speed, f64::max)
    }

    /// Puts a port into contact at the current time, with every other one that touches and moves
    /// in. The motion of the port is up to date; all others in flight are updated, because the step
    /// that ended here was cut short.
    #[inline(always)]
    pub(crate) fn join<W: Simd>(&mut self, w: W, p: usize) {
        if self.is_guard(p) {
            self.switching.pending_event = Some(p);
            return;
        }
        for q in 0..self.kernel.plant.ports.len() {
            if q != p && self.ports[q].contact_state == ContactState::Flight {
                self.update_port(w, q);
            }
        }
        // A point that is past a rigid stop by roundoff and moves out has left it, unless it is
        // pressed back first.
        let motion = [self.ports[p].penetration_m, self.ports[p].rate_m_s];
        if self.is_rigid(p) && motion[1] < 0.0 && !self.is_suppressed_hop(p, motion) {
            return;
        }
        self.enter(p);
        for q in 0..self.kernel.plant.system.stops.len() {
            if self.ports[q].contact_state == ContactState::Contact {
                continue;
            }
            // Simultaneous impacts on rigid stops share one instant, within the accuracy of their
            // distances.
            let roundoff_m = if self.is_rigid(q) {
                RESOLVED_DISTANCE * self.terms_m(w, q)
            } else {
                0.0
            };
            let port = &self.ports[q];
            let touches = port.penetration_m.abs() <= self.touch_m(q).max(roundoff_m);
            if port.rate_m_s > 0.0 && touches {
                self.enter(q);
            }
        }
    }

    fn enter(&mut self, p: usize) {
        // With a simultaneous impact on another stop, roundoff may release a port that returns
        // immediately: that is one contact.
        let is_rigid = self.is_rigid(p);
        let window_s = (SIMULTANEOUS_CONTACT * Kernel::length_s(self.ports[p].entry_level))
            .max(RESOLVED_DISTANCE * self.time_s.abs());
        if self.time_s - self.ports[p].entered_s <= window_s && !is_rigid {
            (self.ports[p].penetration_m, self.ports[p].contact_state) =
                (0.0, ContactState::Contact);
        } else {
            self.enter_contact(p);
            self.ports[p].entered_s = self.time_s;
        }
        let port = &mut self.ports[p];
        (port.level, port.entering) = (port.entry_level, !is_rigid);
    }
}
