//! Members until the interval of the mean power is as narrow as wanted.
//!
//! Members come in rounds of a fixed size, and each has its own seed, so that the answer has the same bits for any number of threads.

use super::{Estimate, IntervalOver, Member};
use crate::march::MarchError;
use crate::run::{RunError, RunPlan, StartState};
use crate::study::{Prepared, StudyError};
use rayon::prelude::*;

/// An ensemble to be marched.
#[derive(Debug)]
pub struct Ensemble<'s> {
    /// The harvester, with at least one drive of noise.
    pub base: &'s Prepared,
    /// Where every member starts.
    pub start: StartState,
    /// Members of a round; all of them where no width is wanted.
    pub members: usize,
    /// Seed of the realisations.
    pub seed: u64,
    /// Wanted half width of the interval over the mean power.
    pub relative_width: Option<f64>,
    /// Rounds at most.
    pub most_rounds: usize,
}

/// What an ensemble says.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsembleAnswer {
    /// Every member, by index.
    pub members: Vec<Member>,
    /// Mean power of all loads together, W.
    pub power_w: Estimate,
    /// Contacts per second, Hz, over the members.
    pub contact_rate_hz: Estimate,
    /// Mean speed at which contacts began, m/s, over all contacts.
    pub mean_strike_m_s: f64,
    /// Largest of these speeds, m/s.
    pub max_strike_m_s: f64,
    /// Mean time that a contact lasts, s, over all contacts.
    pub mean_dwell_s: f64,
    /// True when the wanted width was reached, or none was wanted; false where the work was stopped.
    pub reached: bool,
}

impl Ensemble<'_> {
    /// Marches the members; `done` hears of each. Stopped by the watch of its harvester it answers from the members that are finished,
    /// of which there may be none.
    ///
    /// # Errors
    /// [`StudyError::NoNoise`], or the first march that failed.
    pub fn run(&self, done: &(dyn Fn(&Member) + Sync)) -> Result<EnsembleAnswer, StudyError> {
        let watch = &self.base.kernel.watch;
        let mut members: Vec<Member> = Vec::new();
        loop {
            let first = members.len();
            watch.expect(self.members);
            let round: Result<Vec<Option<Member>>, StudyError> =
                (first..first + self.members).into_par_iter().map(|index| self.member(index, done)).collect();
            members.extend(round?.into_iter().flatten());
            let answer = self.answer(&members);
            if watch.is_stopped() {
                return Ok(EnsembleAnswer { members, reached: false, ..answer });
            }
            if answer.reached || members.len() >= self.members * self.most_rounds {
                return Ok(EnsembleAnswer { members, ..answer });
            }
        }
    }

    /// `None` for a member that was stopped on its way.
    fn member(&self, index: usize, done: &(dyn Fn(&Member) + Sync)) -> Result<Option<Member>, StudyError> {
        let kernel = self.base.realised(self.seed, index as u64)?;
        let run = &self.base.spec.run;
        let plan = RunPlan { duration_s: run.duration_s, average_over_s: run.average_over_s, tolerance: run.tolerance, record_s: 0.0 };
        match Member::march(&kernel, &self.start, &plan, index) {
            Err(MarchError::Stopped { .. }) => Ok(None),
            Err(error) => Err(RunError::from(error).into()),
            Ok(member) => {
                kernel.watch.count();
                done(&member);
                Ok(Some(member))
            }
        }
    }

    fn answer(&self, members: &[Member]) -> EnsembleAnswer {
        let power_w = Estimate::of_power(members);
        let contacts = members.iter().map(|member| member.contacts).sum::<u64>().max(1) as f64;
        let over_contacts = |value: fn(&Member) -> f64| members.iter().map(|m| m.contacts as f64 * value(m)).sum::<f64>() / contacts;
        let rates: Vec<f64> = members.iter().map(|member| member.contact_rate_hz).collect();
        EnsembleAnswer {
            members: Vec::new(),
            contact_rate_hz: Estimate::of(&rates, IntervalOver::Members),
            mean_strike_m_s: over_contacts(|member| member.mean_strike_m_s),
            max_strike_m_s: members.iter().fold(0.0, |max, member| max.max(member.max_strike_m_s)),
            mean_dwell_s: over_contacts(|member| member.mean_dwell_s),
            reached: self.relative_width.is_none_or(|width| power_w.relative_width() <= width),
            power_w,
        }
    }
}
