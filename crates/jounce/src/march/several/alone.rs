//! One compliant port in contact by itself, the others watched: most of the time of most marches with several stops.

use super::flight::Outcome;
use crate::march::error::MarchError;
use crate::march::joint_tables::Length;
use crate::march::kernel::Shape;
use crate::march::level::PER_OCTAVE;
use crate::march::marcher::Marcher;
use crate::wide::Wide;

impl Marcher<'_> {
    /// Goes on as if there were no other port, for as long as none of them needs to be watched; false when that is not even a step.
    #[inline(always)]
    pub(super) fn stay_alone<W: Wide>(&mut self, w: W, p: usize, end_s: f64) -> Result<bool, MarchError> {
        let (start_s, port) = (self.time_s, &self.ports[p]);
        if port.rows.speed_bound.is_none() {
            return Ok(false);
        }
        let start = (port.level, port.entering && port.rate_m_s > 0.0);
        let (level, entering) = w.apart(
            #[inline(always)]
            || self.stay(w, self.law(p), (p, true), start, end_s),
        )?;
        let port = &mut self.ports[p];
        (port.level, port.entering) = (level, entering);
        Ok(self.time_s > start_s)
    }

    /// Tries a step; taken when it is accurate for the port in contact and clear for all in flight.
    #[inline(always)]
    pub(super) fn attempt_alone<W: Wide>(&mut self, w: W, (p, shape): (usize, Shape), length: Length, is_short: bool) -> Outcome {
        let (law, table) = (self.law(p), length.table(self.kernel, (p, shape)));
        let is_odd = matches!(length, Length::Odd { .. });
        let step = [self.step_in_contact(w, law, (&table, p), shape, length.level(), is_odd)];
        let Some(solved) = self.solve(w, law, &step[0]) else { return Outcome::Unclear(PER_OCTAVE) };
        let solved = [solved];
        if !self.is_fine(&step, &solved, is_short) {
            return Outcome::Unclear(PER_OCTAVE);
        }
        let outcome = self.watch(w, length, &step, &solved);
        if let Outcome::Clear = outcome {
            self.forget_clearances();
            self.take_joint(w, length, &step, &solved, None);
        }
        outcome
    }
}
