//! Integration through a contact, step by step, with acceptance of each step.
//!
//! The first step has the onset basis, the others are smooth. The error limits the length of each
//! (see [`step_size_control`]).

mod accept;
mod peak;
mod separation;
pub(crate) mod solve;
pub(crate) mod step;
pub(crate) mod step_size_control;

use crate::error::IntegrationError;
use crate::force_response::basis::NODES;
use crate::integrator::{Integrator, TrialState};
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::state::ContactState;
use crate::tables::joint::StepLength;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
pub(crate) use accept::nodal;
use jounce_model::contact::ContactLaw;
use jounce_simd::Simd;
use step::{ContactStep, SolvedStep};
use step_size_control::levels_too_long;

/// Fraction of the tolerance allowed for the impulse error of one step.
pub(super) const IMPULSE_ERROR_SHARE: f64 = 0.1;

/// Fraction of that error allowed for the first step of a contact. Its estimate uses the end of the
/// step only, and its error affects all that follows. With this fraction the mean power of a run is
/// ten times nearer to its limit for 5 % more steps.
const ONSET_ERROR_SHARE: f64 = 0.01;

impl SolvedStep {
    /// Returns the time integral of the magnitude of the force, N s.
    #[inline(always)]
    pub(super) fn size_n_s<W: Simd>(&self, w: W, step: &ContactStep) -> f64 {
        step.table.length_s * w.sum(w.mul(w.load(&step.basis.weights), w.abs(w.load(&self.force))))
    }

    /// True where the step is reliable in addition to its error estimate; on a negligible step the
    /// impulse of the force is below the allowed error.
    pub(super) fn is_sound(
        &self,
        shape: ForceBasis,
        is_short: bool,
        is_negligible: impl Fn() -> bool,
    ) -> bool {
        match shape {
            ForceBasis::Onset => self.rises() || is_short && is_negligible(),
            ForceBasis::Smooth => is_short || !self.mostly_free(),
        }
    }

    /// True where the step leaves the stop before its middle: the rest is flight, and another
    /// contact might hide in it.
    fn mostly_free(&self) -> bool {
        self.penetration.0[NODES] < 0.0 && self.penetration.0[NODES / 2] < 0.0
    }

    /// True where the penetration still increases at the end of the step.
    fn rises(&self) -> bool {
        self.penetration.0[NODES] > self.penetration.0[NODES - 1]
    }
}

impl Integrator<'_> {
    /// Integrates the contact of a compliant port, the only one in contact, until it leaves its stop
    /// or the end is reached. With other ports, it also returns when one of them must be monitored
    /// or the end is near: a step to the end is accurate for all ports.
    #[inline(always)]
    pub(super) fn stay<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        (p, with_others): (usize, bool),
        end_s: f64,
        trial: &mut TrialState,
    ) -> Result<(), IntegrationError> {
        let port = &self.ports[p];
        let (mut level, mut entering) = (port.level, port.entering && port.rate_m_s > 0.0);
        let (kernel, both_sides) = (self.kernel, law.acts_on_both_sides());
        level = level.max(self.coarsest(law));
        // On steps this short no second contact can follow the first.
        let safe = Kernel::level_within(1.0 / kernel.fastest_rad_s) + 3 * LEVELS_PER_OCTAVE;
        while self.time_s < end_s && self.ports[p].contact_state == ContactState::Contact {
            let remaining_s = self.excitation.remaining_s(self.time_s, end_s);
            let shape = kernel.shape(p, entering);
            let level_s = Kernel::length_s(level);
            let landing = level_s >= remaining_s;
            if with_others && (landing || !self.all_stay_clear(w, level_s, (p, 0.0))) {
                break;
            }
            let odd;
            let tables = if landing {
                odd = self.tables_of_length(remaining_s);
                &odd
            } else {
                kernel.tables(level)
            };
            let table = tables.contact(kernel, (p, shape));
            let step = self.step_in_contact(w, law, (table, p), shape, level, landing);
            let length = StepLength { tables, level };
            let (sound, allowed) = self.solve_soundly(w, law, &step, length, level >= safe);
            let allowed_error = share(shape) * allowed;
            match accurate(sound, level, allowed_error) {
                Ok(solved) => {
                    if with_others
                        && !self.all_stay_clear(w, table.length_s, (p, solved.size_n_s(w, &step)))
                    {
                        break;
                    }
                    self.accept_step(w, law, &step, &solved, trial);
                    if landing {
                        self.time_s = end_s;
                    }
                    // Where no contact ends or begins, the next call continues at the level of this
                    // one.
                    let starts_next = entering || (both_sides && !landing);
                    level = self.next_level(law, level, &step, &solved, (allowed, starts_next));
                    entering = false;
                }
                Err(down) => {
                    level = if landing {
                        Kernel::level_within(remaining_s) + 1
                    } else {
                        level + down
                    };
                    if entering || both_sides {
                        self.ports[p].entry_level = level;
                    }
                    self.count_rejection(p, level)?;
                }
            }
        }
        // A step to the end is shorter than its level: its error does not predict the next one.
        if self.time_s >= end_s {
            level = self.ports[p].entry_level;
        }
        let port = &mut self.ports[p];
        (port.level, port.entering) = (level, entering);
        Ok(())
    }

    /// Returns the solution of a step if it is reliable, and the allowed impulse error, N s.
    #[inline(always)]
    fn solve_soundly<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
        length: StepLength,
        is_short: bool,
    ) -> (Option<SolvedStep>, f64) {
        let solved = self.solve(w, law, step);
        let solved = solved.or_else(|| self.solve_by_newton(w, (step.port, step.shape), length));
        let allowed = self.allowed_n_s(step, solved.as_ref());
        let sound = solved.filter(|solved| {
            let is_negligible = || solved.size_n_s(w, step) <= share(step.shape) * allowed;
            law.acts_on_both_sides() || solved.is_sound(step.shape, is_short, is_negligible)
        });
        (sound, allowed)
    }

    /// Counts a rejected step; an error where the level of the next attempt would be too fine.
    #[inline(always)]
    pub(super) fn count_rejection(&mut self, p: usize, level: i32) -> Result<(), IntegrationError> {
        self.work.contact_rejections += 1;
        if level > Kernel::finest() {
            return Err(self.diverged(p));
        }
        Ok(())
    }

    /// Returns the allowed impulse error of a port for one step, N s.
    #[inline(always)]
    pub(super) fn allowed_n_s(&self, step: &ContactStep, solved: Option<&SolvedStep>) -> f64 {
        let port = &self.ports[step.port];
        let mut speed_m_s = port.impact_velocity_m_s.max(port.rate_m_s.abs());
        if let Some(solved) = solved {
            // Without an impact, a contact that starts at rest has the speed that it gains as its
            // only scale.
            speed_m_s = speed_m_s.max(
                (solved.penetration.0[NODES] - port.penetration_m).abs() / step.table.length_s,
            );
        }
        self.tolerance * IMPULSE_ERROR_SHARE * speed_m_s / port.rows.mobility_per_kg
    }

    pub(super) fn diverged(&self, p: usize) -> IntegrationError {
        IntegrationError::ContactDiverged {
            time_s: self.time_s,
            stop: self.kernel.plant.system.stops[p].name.clone(),
            step_s: Kernel::length_s(Kernel::finest()),
            penetration_m: self.ports[p].penetration_m,
        }
    }
}

/// Returns a sound solution whose error is allowed, or by how many levels the step is too long.
#[inline(always)]
fn accurate(sound: Option<SolvedStep>, level: i32, allowed_n_s: f64) -> Result<SolvedStep, i32> {
    let solved = sound.ok_or(LEVELS_PER_OCTAVE)?;
    match levels_too_long(level, solved.error_n_s, allowed_n_s) {
        0 => Ok(solved),
        down => Err(down),
    }
}

/// Returns the fraction of the allowed error for a step.
#[inline(always)]
pub(super) fn share(shape: ForceBasis) -> f64 {
    match shape {
        ForceBasis::Onset => ONSET_ERROR_SHARE,
        ForceBasis::Smooth => 1.0,
    }
}
