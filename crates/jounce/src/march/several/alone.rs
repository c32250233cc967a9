//! One compliant port in contact by itself, the others watched: most of the time of most marches with several stops.

use super::flight::Outcome;
use crate::march::joint_tables::Length;
use crate::march::kernel::Shape;
use crate::march::marcher::Marcher;
use crate::wide::Wide;

impl Marcher<'_> {
    /// Tries a step; taken when it is accurate for the port in contact and clear for all in flight.
    #[inline(always)]
    pub(super) fn attempt_alone<W: Wide>(&mut self, w: W, (p, shape): (usize, Shape), length: Length, is_short: bool) -> Outcome {
        let (law, table) = (self.law(p), length.table(self.kernel, (p, shape)));
        let is_odd = matches!(length, Length::Odd { .. });
        let step = [self.step_in_contact(w, law, (&table, p), shape, length.level(), is_odd)];
        let Some(solved) = self.solve(w, law, &step[0]) else { return Outcome::Unclear(1) };
        let solved = [solved];
        if !self.is_fine(&step, &solved, is_short) {
            return Outcome::Unclear(1);
        }
        if self.all_stay_clear(w, length.seconds(), Some((&step[0], &solved[0]))) {
            table.flow.apply(w, &self.y, &mut self.next);
            self.take_joint(w, length, &step, &solved, None);
            return Outcome::Clear;
        }
        let outcome = self.watch(w, length, &step, &solved);
        if let Outcome::Clear = outcome {
            self.forget_clearances();
            self.take_joint(w, length, &step, &solved, None);
        }
        outcome
    }
}
