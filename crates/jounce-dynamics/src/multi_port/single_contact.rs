//! Single compliant port in contact with the others monitored: the most frequent case with several
//! stops.

use super::flight::StepOutcome;
use crate::error::IntegrationError;
use crate::integrator::Integrator;
use crate::kernel::ForceBasis;
use crate::tables::joint::StepLength;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_simd::Simd;

impl Integrator<'_> {
    /// Integrates as if there were no other port, as long as no other port must be monitored; false
    /// when that is less than a step.
    #[inline(always)]
    pub(super) fn stay_single_port<W: Simd>(
        &mut self,
        w: W,
        p: usize,
        end_s: f64,
    ) -> Result<bool, IntegrationError> {
        let (start_s, port) = (self.time_s, &self.ports[p]);
        if port.rows.speed_bound.is_none() {
            return Ok(false);
        }
        let start = (port.level, port.entering && port.rate_m_s > 0.0);
        let (level, entering) = w.out_of_line(
            #[inline(always)]
            || self.stay(w, self.law(p), (p, true), start, end_s),
        )?;
        let port = &mut self.ports[p];
        (port.level, port.entering) = (level, entering);
        Ok(self.time_s > start_s)
    }

    /// Attempts a step, accepted when it is accurate for the port in contact and clear for all in
    /// flight.
    #[inline(always)]
    pub(super) fn attempt_single_port<W: Simd>(
        &mut self,
        w: W,
        (p, shape): (usize, ForceBasis),
        length: StepLength,
        is_short: bool,
    ) -> StepOutcome {
        let (law, table) = (self.law(p), length.tables.contact(self.kernel, (p, shape)));
        let is_odd = !length.is_level();
        let step = [self.step_in_contact(w, law, (table, p), shape, length.level, is_odd)];
        let solved = self
            .solve(w, law, &step[0])
            .or_else(|| self.solve_by_newton(w, (p, shape), length))
            .map(|solved| [solved]);
        let Some(solved) = self.accepted(&step, solved, length, is_short) else {
            return StepOutcome::Unclear(LEVELS_PER_OCTAVE);
        };
        let outcome = self.check_free_ports(w, length, &step, &solved);
        if let StepOutcome::Clear = outcome {
            self.forget_clearances();
            self.accept_joint_step(w, length, &step, &solved, None);
        }
        outcome
    }
}
