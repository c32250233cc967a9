//! Advance of an integration to a given time: flights and contacts alternate.

use super::Integrator;
use crate::error::IntegrationError;
use crate::multi_port::AdvanceMultiPort;
use crate::ports::state::ContactState;
use jounce_model::contact::{ContactLaw, Hertz, Law, Rigid};
use jounce_simd::{Simd, Task, widest};

/// Polls of the control between two callbacks.
const POLLS_PER_CALLBACK: u8 = 64;

impl Integrator<'_> {
    /// Integrates to a time and lands on it exactly.
    ///
    /// # Errors
    /// Every variant of [`IntegrationError`].
    pub fn advance_to(&mut self, end_s: f64) -> Result<(), IntegrationError> {
        if self.kernel.plant.system.bridges.is_empty() {
            return self.advance_in_conduction_state(end_s);
        }
        while self.time_s < end_s {
            let until_s = end_s.min(self.next_phase_s());
            self.advance_in_conduction_state(until_s)?;
            self.change_on_events()?;
            self.pass_phases();
        }
        Ok(())
    }

    /// Integrates until the end, or until an event function passes zero.
    fn advance_in_conduction_state(&mut self, end_s: f64) -> Result<(), IntegrationError> {
        if self.kernel.plant.ports.len() > 1 || !self.kernel.plant.guards.is_empty() {
            return widest(AdvanceMultiPort {
                integrator: self,
                end_s,
            });
        }
        let law = self.kernel.plant.system.stops.first().map(|stop| stop.law);
        match law {
            // A law without stiffness exerts no force.
            None => self.dispatch(
                Hertz {
                    stiffness: 0.0,
                    exponent: 1.0,
                },
                end_s,
            ),
            Some(Law::Hertz(law)) => self.dispatch(law, end_s),
            Some(Law::Rigid(law)) => widest(AdvanceRigid {
                integrator: self,
                law,
                end_s,
            }),
            Some(law) => self.dispatch(law, end_s),
        }
    }

    /// Passes the breakpoints of the signals up to the current time; returns the next one, or the
    /// end if that is earlier.
    #[inline(always)]
    pub(crate) fn next_breakpoint<W: Simd>(&mut self, w: W, end_s: f64) -> f64 {
        if self.excitation.has_breakpoint(self.time_s)
            && self
                .excitation
                .cross(w, self.kernel, self.time_s, &mut self.y)
        {
            self.update_ports(w);
        }
        end_s.min(self.excitation.until_s(self.time_s))
    }

    /// Updates the ports of all stops after an impulse of a signal; a port that stuck to a rigid
    /// stop and now moves away enters flight.
    #[inline(always)]
    fn update_ports<W: Simd>(&mut self, w: W) {
        for (p, stop) in self.kernel.plant.system.stops.iter().enumerate() {
            self.update_port(w, p);
            let port = &mut self.ports[p];
            if matches!(stop.law, Law::Rigid(_)) && port.rate_m_s < 0.0 {
                port.contact_state = ContactState::Flight;
            }
        }
    }

    /// Checks for cancellation, reports progress, and periodically runs the callback.
    #[inline(always)]
    pub(crate) fn poll(&mut self) -> Result<(), IntegrationError> {
        self.checks = self.checks.wrapping_add(1);
        if self.kernel.control.is_quiet() && !self.checks.is_multiple_of(POLLS_PER_CALLBACK) {
            Ok(())
        } else {
            self.poll_control()
        }
    }

    #[cold]
    fn poll_control(&self) -> Result<(), IntegrationError> {
        if !self.kernel.control.is_quiet() {
            self.kernel.control.report_progress(self.time_s);
        }
        if self.kernel.control.is_stopped() {
            Err(IntegrationError::Stopped {
                time_s: self.time_s,
            })
        } else {
            Ok(())
        }
    }

    fn dispatch<L: ContactLaw>(&mut self, law: L, end_s: f64) -> Result<(), IntegrationError> {
        widest(Advance {
            integrator: self,
            law,
            end_s,
        })
    }
}

/// Runs the loop in code compiled for the vector instructions of this machine.
struct Advance<'m, 'k, L> {
    integrator: &'m mut Integrator<'k>,
    law: L,
    end_s: f64,
}

impl<L: ContactLaw> Task for Advance<'_, '_, L> {
    type Output = Result<(), IntegrationError>;

    /// Alternates flight and contact until the end.
    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> Self::Output {
        let Advance {
            integrator,
            law,
            end_s,
        } = self;
        while integrator.time_s < end_s {
            integrator.poll()?;
            let until_s = integrator.next_breakpoint(w, end_s);
            match integrator.ports[0].contact_state {
                ContactState::Flight => integrator.flight(w, until_s)?,
                ContactState::Contact => integrator.contact(w, law, until_s)?,
            }
        }
        Ok(())
    }
}

/// Runs the loop of a rigid stop.
struct AdvanceRigid<'m, 'k> {
    integrator: &'m mut Integrator<'k>,
    law: Rigid,
    end_s: f64,
}

impl Task for AdvanceRigid<'_, '_> {
    type Output = Result<(), IntegrationError>;

    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> Self::Output {
        self.integrator.advance_rigid(w, self.law, self.end_s)
    }
}
