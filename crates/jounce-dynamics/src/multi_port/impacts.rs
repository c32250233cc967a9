//! Impacts on rigid stops at one instant.
//!
//! An impact is one impulse (see [`crate::impact`]), which moves the other ports too.
//! Simultaneous impacts have joint impulses (see [`super::joint_impact`]). Further impacts, on a
//! sticking stop or again on the same one, follow until no touching point moves into its stop.
//! Where Newton's law has no joint solution, the impacts follow one after another in the order of
//! the spec. Every impulse acts through the plant, so that momentum is conserved exactly in any
//! order.

use crate::error::IntegrationError;
use crate::integrator::Integrator;
use crate::ports::small_list::SmallList;
use crate::ports::state::ContactState;
use jounce_model::contact::Law;
use jounce_simd::Simd;
use smallvec::smallvec;

/// Speed into a stop that is roundoff, relative to the largest impact speed and to its terms.
const NEGLIGIBLE_SPEED: f64 = 1e-14;

/// Largest number of impacts at one instant.
const MAX_IMPACTS_PER_INSTANT: usize = 10_000;

impl Integrator<'_> {
    /// True where a touching point moves into a rigid stop.
    pub(crate) fn hits_rigid_stop(&self) -> bool {
        self.ports_in(ContactState::Contact)
            .any(|p| self.is_rigid(p) && self.moves_in(p))
    }

    fn moves_in(&self, p: usize) -> bool {
        let rate_m_s = self.ports[p].rate_m_s;
        rate_m_s > 0.0 && rate_m_s > self.rest_speed_m_s(p)
    }

    fn rest_speed_m_s(&self, p: usize) -> f64 {
        NEGLIGIBLE_SPEED * self.speed_m_s(p)
    }

    /// Resolves all impacts of the present instant.
    ///
    /// # Errors
    /// [`IntegrationError::ImpactsWithoutEnd`].
    #[inline(always)]
    pub(crate) fn collide<W: Simd>(&mut self, w: W) -> Result<(), IntegrationError> {
        let touching: SmallList<usize> = self
            .ports_in(ContactState::Contact)
            .filter(|p| self.is_rigid(*p))
            .collect();
        for _ in 0..MAX_IMPACTS_PER_INSTANT {
            let impacting: SmallList<usize> = touching
                .iter()
                .copied()
                .filter(|p| self.moves_in(*p))
                .collect();
            let Some(first) = impacting.first() else {
                self.settle(&touching);
                return Ok(());
            };
            let affected = self
                .joint_impact(&impacting)
                .unwrap_or_else(|| self.single_impact(*first));
            for q in (0..self.kernel.plant.ports.len()).filter(|q| !affected.contains(q)) {
                let touches =
                    self.ports[q].contact_state == ContactState::Contact || touching.contains(&q);
                let penetration_m = touches.then_some(self.ports[q].penetration_m);
                self.update_port(w, q);
                self.ports[q].penetration_m = penetration_m.unwrap_or(self.ports[q].penetration_m);
            }
        }
        let stops = touching
            .iter()
            .map(|p| self.kernel.plant.system.stops[*p].name.clone())
            .collect();
        Err(IntegrationError::ImpactsWithoutEnd {
            time_s: self.time_s,
            stops,
            impacts: MAX_IMPACTS_PER_INSTANT,
        })
    }

    /// Applies an impact on one stop; returns the affected ports.
    fn single_impact(&mut self, p: usize) -> SmallList<usize> {
        if let Law::Rigid(law) = self.law(p) {
            self.impact(p, law);
        }
        smallvec![p]
    }

    /// Sets points that leave to flight, and the others to sticking.
    fn settle(&mut self, touching: &[usize]) {
        for p in touching {
            let leaves = self.ports[*p].rate_m_s < -self.rest_speed_m_s(*p);
            let port = &mut self.ports[*p];
            port.contact_state = if leaves {
                ContactState::Flight
            } else {
                ContactState::Contact
            };
            port.rate_m_s = if leaves { port.rate_m_s } else { 0.0 };
        }
    }
}
