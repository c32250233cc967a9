//! End of a step of several ports at the first impact of a port in flight.

use super::joint_solve::JointStep;
use super::sticking::StickingPorts;
use super::{RESOLVED_DISTANCE, SIMULTANEOUS_CONTACT};
use crate::contact::step::SolvedStep;
use crate::flight::crossing::Crossing;
use crate::integrator::{Integrator, TrialState};
use crate::kernel::{ForceBasis, Kernel};
use crate::tables::joint::{JointTables, StepLength};
use crate::tables::step_tables::StepTables;
use jounce_simd::Simd;

/// Port in flight with its crossing.
type Strike = (usize, Crossing);

/// Largest number of Newton iterations for the time of one impact at which a step ends.
const MAX_LANDING_ITERATIONS: u32 = 12;

/// Time error, relative to the first step of the following contact, within which an impact is
/// located.
const LANDING_TOLERANCE: f64 = 1e-14;

impl Integrator<'_> {
    /// Ends the step at the first of several impacts; false when that fails. Newton's method locates
    /// the one that seems to be first, and then each one that proves to precede it.
    #[inline(always)]
    pub(super) fn end_at_first_impact<W: Simd>(
        &mut self,
        w: W,
        ports: &[(usize, ForceBasis)],
        strikes: &[Strike],
        level: i32,
        trial: &mut TrialState,
    ) -> bool {
        let by_guess = |a: &&Strike, b: &&Strike| a.1.guess_s.total_cmp(&b.1.guess_s);
        let Some(mut first) = strikes.iter().min_by(by_guess).copied() else {
            return false;
        };
        let mut length_s = first.1.guess_s;
        for _ in 0..MAX_LANDING_ITERATIONS * strikes.len() as u32 {
            let scale_s = Kernel::length_s(self.ports[first.0].entry_level);
            if length_s <= SIMULTANEOUS_CONTACT * scale_s {
                self.join(w, first.0);
                return true;
            }
            let tables = StepTables::new(self.kernel.plant.ports.len(), length_s);
            let length = StepLength {
                tables: &tables,
                level,
            };
            let joint_tables = JointTables::new(self.kernel, ports, length);
            let joint = self.joint_step(w, &joint_tables);
            let resting = StickingPorts::new(self, &joint_tables);
            let Some(solved) = self.solve_joint(w, &joint, &resting) else {
                return false;
            };
            let [change_s, accuracy_s] = self.time_to_impact(w, &joint, &solved, first.0, trial);
            if change_s.abs() <= accuracy_s {
                if let Some(earlier) =
                    self.earlier_strike(w, &joint, &solved, strikes, first.0, trial)
                {
                    first = earlier;
                    length_s = length_s.min(first.1.guess_s);
                    continue;
                }
                self.move_freely(w, &joint.steps, trial);
                self.forget_clearances();
                self.accept_joint_step(
                    w,
                    length,
                    &joint.steps,
                    &solved,
                    Some(&joint_tables),
                    trial,
                );
                self.join(w, first.0);
                return true;
            }
            length_s += change_s;
            if !(length_s >= 0.0 && length_s <= 2.0 * first.1.to_s) {
                return false;
            }
        }
        false
    }

    /// Returns another strike that precedes the end of a step: its interval has passed, or the end is
    /// inside it and the port is past its stop.
    #[inline(always)]
    fn earlier_strike<W: Simd>(
        &self,
        w: W,
        joint: &JointStep,
        solved: &[SolvedStep],
        strikes: &[Strike],
        first: usize,
        trial: &mut TrialState,
    ) -> Option<Strike> {
        let end_s = joint.tables.length.seconds();
        let mut is_past = |p: usize| {
            let [change_s, accuracy_s] = self.time_to_impact(w, joint, solved, p, trial);
            change_s < -accuracy_s
        };
        let is_earlier = |(p, crossing): &&Strike| {
            *p != first && (crossing.to_s < end_s || crossing.from_s < end_s && is_past(*p))
        };
        strikes.iter().find(is_earlier).copied()
    }

    /// Returns the time from the end of a step to the impact of a port by Newton's method, and the
    /// accuracy to which it must be known, s.
    #[inline(always)]
    fn time_to_impact<W: Simd>(
        &self,
        w: W,
        joint: &JointStep,
        solved: &[SolvedStep],
        p: usize,
        trial: &mut TrialState,
    ) -> [f64; 2] {
        let [distance_m, speed_m_s] = self.motion_at_end(w, joint, solved, p, trial);
        let scale_s = Kernel::length_s(self.ports[p].entry_level);
        // The roundoff of the distance limits the accuracy of the time.
        let roundoff_s = RESOLVED_DISTANCE * self.terms_m(w, p) / speed_m_s.abs();
        let longest_s = scale_s.max(joint.tables.length.seconds());
        [
            -distance_m / speed_m_s,
            roundoff_s.max(LANDING_TOLERANCE * longest_s),
        ]
    }
}
