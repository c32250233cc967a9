//! Single compliant port in contact with the others monitored: the most frequent case, with one stop
//! and with several.

use crate::error::IntegrationError;
use crate::flight::verdict::StepOutcome;
use crate::integrator::{Integrator, TrialState};
use crate::kernel::ForceBasis;
use crate::tables::joint::StepLength;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_model::contact::Law;
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
        trial: &mut TrialState,
    ) -> Result<bool, IntegrationError> {
        let with_others = self.kernel.plant.ports.len() > 1;
        if with_others && self.ports[p].rows.speed_bound.is_none() {
            return Ok(false);
        }
        let start_s = self.time_s;
        // The only port has code of its own, and once more under the most frequent law.
        match (self.law(p), with_others) {
            (Law::Hertz(law), false) => w.out_of_line(
                #[inline(always)]
                || self.stay(w, law, (0, false), end_s, trial),
            ),
            (law, false) => w.out_of_line(
                #[inline(always)]
                || self.stay(w, law, (0, false), end_s, trial),
            ),
            (law, true) => w.out_of_line(
                #[inline(always)]
                || self.stay(w, law, (p, true), end_s, trial),
            ),
        }?;
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
        trial: &mut TrialState,
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
        let outcome = self.check_free_ports(w, length, &step, &solved, trial);
        if let StepOutcome::Clear = outcome {
            self.forget_clearances();
            self.accept_joint_step(w, length, &step, &solved, None, trial);
        }
        outcome
    }
}
