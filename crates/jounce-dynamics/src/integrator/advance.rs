//! Advance of an integration to a given time: impacts, contacts and flights of any number of ports
//! alternate.

use super::{Integrator, TrialState};
use crate::error::IntegrationError;
use crate::excitation::breakpoints::Jump;
use crate::impact::zeno_guard::ZenoGuard;
use crate::ports::state::ContactState;
use jounce_model::contact::Law;
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
        widest(Advance {
            integrator: self,
            end_s,
        })
    }

    /// Passes the breakpoints of the signals up to the current time; true where the motion of a port
    /// has jumped.
    #[inline(always)]
    fn pass_breakpoints<W: Simd>(&mut self, w: W) -> bool {
        if !self.excitation.has_breakpoint(self.time_s) {
            return false;
        }
        let jump = self
            .excitation
            .cross(w, self.kernel, self.time_s, &mut self.y);
        match jump {
            Jump::Jerk => {}
            Jump::Acceleration => self.update_free_ports(w),
            Jump::Velocity => self.update_ports(w),
        }
        jump != Jump::Jerk
    }

    /// Updates all ports after an impulse of a signal; a port that stuck to a rigid stop and now
    /// moves away enters flight.
    #[inline(always)]
    fn update_ports<W: Simd>(&mut self, w: W) {
        for p in 0..self.kernel.plant.ports.len() {
            self.update_port(w, p);
        }
        for (p, stop) in self.kernel.plant.system.stops.iter().enumerate() {
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
}

/// Runs the loop in code compiled for the vector instructions of this machine.
struct Advance<'m, 'k> {
    integrator: &'m mut Integrator<'k>,
    end_s: f64,
}

impl Task for Advance<'_, '_> {
    type Output = Result<(), IntegrationError>;

    /// Alternates impacts, contact and flight until the end.
    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> Self::Output {
        let Advance { integrator, end_s } = self;
        let mut rounds = ZenoGuard::default();
        let mut trial = TrialState::new(integrator.kernel);
        while integrator.time_s < end_s && integrator.switching.pending_event.is_none() {
            integrator.poll()?;
            rounds.count(&integrator.kernel.plant, integrator.time_s)?;
            if integrator.pass_breakpoints(w) {
                // An impulse that inverts the current of a patch makes an extremum of its charge.
                integrator.switching.pending_event = integrator.crossed_event();
                continue;
            }
            let until_s = end_s.min(integrator.excitation.until_s(integrator.time_s));
            if integrator.hits_rigid_stop() {
                w.out_of_line(
                    #[inline(always)]
                    || integrator.collide(w),
                )?;
                // So does an impact.
                integrator.switching.pending_event = integrator.crossed_event();
            } else if integrator.ports_in(ContactState::Contact).next().is_some() {
                integrator.contact(w, until_s, &mut rounds, &mut trial)?;
            } else {
                integrator.fly(w, until_s, &mut trial)?;
            }
        }
        Ok(())
    }
}
