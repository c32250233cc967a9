//! Integration through contacts of several ports: choice and acceptance of the steps.

use super::sticking::StickingPorts;
use crate::contact::share;
use crate::contact::step::{ContactStep, SolvedStep};
use crate::error::IntegrationError;
use crate::flight::verdict::StepOutcome;
use crate::impact::zeno_guard::ZenoGuard;
use crate::integrator::{Integrator, TrialState};
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::small_list::SmallList;
use crate::ports::state::ContactState;
use crate::tables::joint::{JointTables, StepLength};
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_simd::{Portable, Simd};

impl Integrator<'_> {
    /// Integrates until all ports fly, a rigid stop has an impact, or the end is reached.
    #[inline(always)]
    pub(crate) fn contact<W: Simd>(
        &mut self,
        w: W,
        end_s: f64,
        rounds: &mut ZenoGuard,
        trial: &mut TrialState,
    ) -> Result<(), IntegrationError> {
        let mut coarsest = Kernel::coarsest();
        while self.time_s < end_s
            && self.switching.pending_event.is_none()
            && !self.hits_rigid_stop()
        {
            self.poll()?;
            rounds.count(&self.kernel.plant, self.time_s)?;
            if let Some(p) = self.single_compliant_port()
                && self.stay_single_port(w, p, end_s, trial)?
            {
                continue;
            }
            self.release()?;
            let ports = self.ports_with_bases();
            let Some(wanted) = ports.iter().map(|(p, _)| self.ports[*p].level).max() else {
                return Ok(());
            };
            coarsest = self.step_of_ports(w, &ports, wanted.max(coarsest), end_s, trial)?;
        }
        Ok(())
    }

    /// Takes a step of the ports in contact, of a wanted level or shorter. Returns the coarsest level
    /// of the next step: after a rejection it is at most an octave longer, because a step as long as
    /// the rejected one would often be rejected again.
    #[inline(always)]
    fn step_of_ports<W: Simd>(
        &mut self,
        w: W,
        ports: &[(usize, ForceBasis)],
        wanted: i32,
        end_s: f64,
        trial: &mut TrialState,
    ) -> Result<i32, IntegrationError> {
        // On steps this short no second contact can follow the first.
        let safe = Kernel::level_within(1.0 / self.kernel.fastest_rad_s) + 3 * LEVELS_PER_OCTAVE;
        let mut level = wanted;
        loop {
            let remaining_s = self.excitation.remaining_s(self.time_s, end_s);
            let landing = Kernel::length_s(level) >= remaining_s;
            let odd;
            let tables = if landing {
                odd = self.tables_of_length(remaining_s);
                &odd
            } else {
                self.kernel.tables(level)
            };
            let length = StepLength { tables, level };
            match self.attempt_step(w, ports, length, level >= safe, trial) {
                StepOutcome::Clear => {
                    if landing {
                        self.time_s = end_s;
                    }
                    return Ok(if level > wanted {
                        level - LEVELS_PER_OCTAVE
                    } else {
                        Kernel::coarsest()
                    });
                }
                StepOutcome::Strikes(strikes)
                    if w.out_of_line(
                        #[inline(always)]
                        || self.end_at_first_impact(w, ports, &strikes, level, trial),
                    ) =>
                {
                    return Ok(Kernel::coarsest());
                }
                StepOutcome::Strikes(_) => level += LEVELS_PER_OCTAVE,
                StepOutcome::Unclear(down) if landing => {
                    level = Kernel::level_within(remaining_s) + down;
                }
                StepOutcome::Unclear(down) => level += down,
            }
            self.count_rejection(ports[0].0, level)?;
        }
    }

    /// Returns the only port in contact, if its stop is compliant.
    fn single_compliant_port(&self) -> Option<usize> {
        let mut ports = self.ports_in(ContactState::Contact);
        let first = ports.next()?;
        (ports.next().is_none() && !self.is_rigid(first)).then_some(first)
    }

    /// Returns the ports in contact, each with the basis of its next step.
    fn ports_with_bases(&self) -> SmallList<(usize, ForceBasis)> {
        // The force of a sticking port follows the others immediately: its basis would have to
        // include their onset.
        let rests = self
            .ports_in(ContactState::Contact)
            .any(|p| self.is_rigid(p));
        let strikes = |p: usize| self.ports[p].entering && self.ports[p].rate_m_s > 0.0 && !rests;
        self.ports_in(ContactState::Contact)
            .map(|p| (p, self.kernel.shape(p, strikes(p))))
            .collect()
    }

    /// Attempts a step of the ports in contact.
    #[inline(always)]
    fn attempt_step<W: Simd>(
        &mut self,
        w: W,
        ports: &[(usize, ForceBasis)],
        length: StepLength,
        is_short: bool,
        trial: &mut TrialState,
    ) -> StepOutcome {
        match ports {
            [(p, shape)] if !self.is_rigid(*p) => w.out_of_line(
                #[inline(always)]
                || self.attempt_single_port(w, (*p, *shape), length, is_short, trial),
            ),
            several => self.joint_attempt(w, several, length, is_short, trial),
        }
    }

    /// Attempts a step, accepted when it is accurate for all ports in contact and clear for all in
    /// flight.
    #[inline(always)]
    fn joint_attempt<W: Simd>(
        &mut self,
        w: W,
        ports: &[(usize, ForceBasis)],
        length: StepLength,
        is_short: bool,
        trial: &mut TrialState,
    ) -> StepOutcome {
        let tables = JointTables::new(self.kernel, ports, length);
        let joint = self.joint_step(w, &tables);
        let resting = StickingPorts::new(self, &tables);
        let solved = self.solve_joint(w, &joint, &resting);
        let Some(solved) = self.accepted(&joint.steps, solved, length, is_short) else {
            return StepOutcome::Unclear(LEVELS_PER_OCTAVE);
        };
        let outcome = self.check_free_ports(w, length, &joint.steps, &solved, trial);
        if let StepOutcome::Clear = outcome {
            self.forget_clearances();
            self.accept_joint_step(w, length, &joint.steps, &solved, Some(&tables), trial);
        }
        outcome
    }

    /// Returns a solution that is accurate and reliable at every port. Where it is not at a port that
    /// enters, its contacts start with a shorter step.
    #[inline(always)]
    pub(super) fn accepted<S: AsRef<[SolvedStep]>>(
        &mut self,
        steps: &[ContactStep],
        solved: Option<S>,
        length: StepLength,
        is_short: bool,
    ) -> Option<S> {
        let shorter = Kernel::level_within(length.seconds()) + LEVELS_PER_OCTAVE;
        let accurate: SmallList<bool> = match &solved {
            Some(solved) => self.are_accurate(steps, solved.as_ref(), is_short),
            None => steps.iter().map(|_| false).collect(),
        };
        for (step, accurate) in steps.iter().zip(accurate.as_slice()) {
            let port = &mut self.ports[step.port];
            if port.entering && !accurate {
                port.entry_level = port.entry_level.max(shorter);
            }
        }
        solved.filter(|_| accurate.iter().all(|accurate| *accurate))
    }

    /// True for each port at which a step is accurate and reliable.
    #[inline(always)]
    fn are_accurate(
        &self,
        steps: &[ContactStep],
        solved: &[SolvedStep],
        is_short: bool,
    ) -> SmallList<bool> {
        let allowed_n_s = self.allowed_with_others_n_s(steps, solved);
        let is_accurate = |(step, solution): (&ContactStep, &SolvedStep)| {
            let is_decided = self.is_rigid(step.port) || self.law(step.port).acts_on_both_sides();
            let allowed_error = share(step.shape) * allowed_n_s;
            let is_negligible = || solution.size_n_s(Portable::new(), step) <= allowed_error;
            solution.error_n_s <= allowed_error
                && (is_decided || solution.is_sound(step.shape, is_short, is_negligible))
        };
        steps.iter().zip(solved).map(is_accurate).collect()
    }
}
