//! Impacts on rigid stops of a plant with several ports.
//!
//! An impact is one impulse (see [`crate::march::rigid`]), which moves the other ports too. Several stops struck at the same
//! instant, or a stop at rest that another one's impulse strikes, are resolved one after another in the order of the stops of the
//! spec, each by Newton's law with its own restitution, until no touching point moves into its stop. Every impulse acts through
//! the plant, so that momentum is conserved exactly whatever the order; the order is a choice where several are touched at once.

use crate::contact::Law;
use crate::march::error::MarchError;
use crate::march::marcher::Marcher;
use crate::march::port_state::Regime;
use crate::wide::Wide;

/// Speed into a stop that is roundoff, relative to the fastest strike and to the terms that it is summed from.
const STILL: f64 = 1e-14;

/// Most impacts at one instant.
const MOST_IMPACTS: usize = 10_000;

impl Marcher<'_> {
    /// A touched rigid stop is moved into.
    pub(super) fn hits_rigid_stop(&self) -> bool {
        self.in_regime(Regime::Contact).any(|p| self.is_rigid(p) && self.moves_in(p))
    }

    fn moves_in(&self, p: usize) -> bool {
        self.ports[p].rate_m_s > self.still_m_s(p)
    }

    fn still_m_s(&self, p: usize) -> f64 {
        STILL * self.speed_m_s(p)
    }

    /// Resolves all impacts of the present instant.
    ///
    /// # Errors
    /// [`MarchError::ImpactsWithoutEnd`].
    #[inline(always)]
    pub(super) fn collide<W: Wide>(&mut self, w: W) -> Result<(), MarchError> {
        let touching: Vec<usize> = self.in_regime(Regime::Contact).filter(|p| self.is_rigid(*p)).collect();
        for _ in 0..MOST_IMPACTS {
            let struck = touching.iter().find(|p| self.moves_in(**p));
            let (Some(&p), Some(Law::Rigid(law))) = (struck, struck.map(|p| self.law(*p))) else {
                self.settle(&touching);
                return Ok(());
            };
            self.impact(p, law);
            for q in 0..self.kernel.plant.ports.len() {
                let kept_m =
                    if self.ports[q].regime == Regime::Contact || touching.contains(&q) { Some(self.ports[q].penetration_m) } else { None };
                if q != p {
                    self.see(w, q);
                    self.ports[q].penetration_m = kept_m.unwrap_or(self.ports[q].penetration_m);
                }
            }
        }
        let stops = touching.iter().map(|p| self.kernel.plant.system.stops[*p].name.clone()).collect();
        Err(MarchError::ImpactsWithoutEnd { time_s: self.time_s, stops, impacts: MOST_IMPACTS })
    }

    /// Points that leave fly, the others rest.
    fn settle(&mut self, touching: &[usize]) {
        for p in touching {
            let leaves = self.ports[*p].rate_m_s < -self.still_m_s(*p);
            let port = &mut self.ports[*p];
            port.regime = if leaves { Regime::Flight } else { Regime::Contact };
            port.rate_m_s = if leaves { port.rate_m_s } else { 0.0 };
        }
    }
}
