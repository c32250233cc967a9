//! The way through a contact, step by step, each taken if it is good enough.
//!
//! The first step has the onset basis, the others are smooth, each as long as its error allows (see [`super::step_control`]).

use super::basis::NODES;
use super::contact_step::{ContactStep, SolvedStep};
use super::error::IntegrationError;
use super::integrator::Integrator;
use super::kernel::{ForceBasis, Kernel};
use super::port_state::ContactState;
use super::step_control::{coarsest, levels_too_long};
use super::step_size::LEVELS_PER_OCTAVE;
use crate::contact::ContactLaw;
use crate::simd::Simd;

/// Share of the tolerance that one step may spend on the error of its impulse.
pub(super) const IMPULSE_ERROR_SHARE: f64 = 0.1;

/// Share of that which the first step of a contact may spend: its estimate sees the end of the step alone, and what it misses acts on
/// all that follows. With this share the mean power of a run is ten times nearer to its limit for 5 % more steps.
const ONSET_ERROR_SHARE: f64 = 0.01;

impl SolvedStep {
    /// Time integral of the magnitude of the force, N s.
    #[inline(always)]
    fn size_n_s<W: Simd>(&self, w: W, step: &ContactStep) -> f64 {
        step.table.length_s * w.sum(w.mul(w.load(&step.basis.weights), w.abs(w.load(&self.force))))
    }

    /// Can be trusted beside its error estimate.
    pub(super) fn is_sound(&self, shape: ForceBasis, is_short: bool) -> bool {
        match shape {
            ForceBasis::Onset => self.rises(),
            ForceBasis::Smooth => is_short || !self.mostly_free(),
        }
    }

    /// Leaves the stop before its middle: what comes after is flight, and another contact might hide in it.
    fn mostly_free(&self) -> bool {
        self.penetration.0[NODES] < 0.0 && self.penetration.0[NODES / 2] < 0.0
    }

    /// Still going deeper at its end.
    fn rises(&self) -> bool {
        self.penetration.0[NODES] > self.penetration.0[NODES - 1]
    }
}

impl Integrator<'_> {
    /// The only port stays in contact until it leaves its stop or the end is reached.
    #[inline(always)]
    pub(super) fn contact<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        end_s: f64,
    ) -> Result<(), IntegrationError> {
        let port = &self.ports[0];
        let start = (
            port.entry_level,
            !law.acts_on_both_sides() && port.penetration_m <= 0.0,
        );
        self.stay(w, law, (0, false), start, end_s)?;
        Ok(())
    }

    /// A port stays in contact until it leaves its stop or the end is reached; beside others, also until one of these has to be watched
    /// or the end is near. Starts with a step of a level, which enters the contact or does not, and says the same of the next one.
    #[inline(always)]
    pub(super) fn stay<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        (p, beside_others): (usize, bool),
        (level, mut entering): (i32, bool),
        end_s: f64,
    ) -> Result<(i32, bool), IntegrationError> {
        let kernel = self.kernel;
        let both_sides = law.acts_on_both_sides();
        let mut level = level.max(coarsest(law, kernel));
        // On steps this short no second contact can follow the first.
        let safe = Kernel::level_within(1.0 / kernel.fastest_rad_s) + 3 * LEVELS_PER_OCTAVE;
        while self.time_s < end_s && self.ports[p].regime == ContactState::Contact {
            let remaining_s = self.excitation.remaining_s(self.time_s, end_s);
            let shape = if entering {
                kernel.first_shape(p)
            } else {
                ForceBasis::Smooth
            };
            let landing = Kernel::length_s(level) >= remaining_s;
            if beside_others
                && (landing || !self.all_stay_clear(w, Kernel::length_s(level), (p, 0.0)))
            {
                break;
            }
            let odd;
            let table = if landing {
                odd = self.ad_hoc_tables.of(kernel, shape, remaining_s);
                &odd
            } else {
                kernel.table(p, shape, level)
            };
            let step = self.step_in_contact(w, law, (table, p), shape, level, landing);
            let solved = self.solve(w, law, &step);
            let allowed = self.allowed_n_s(law, &step, solved.as_ref());
            let sound = solved.filter(|solved| both_sides || solved.is_sound(shape, level >= safe));
            let down = sound.as_ref().map_or(LEVELS_PER_OCTAVE, |solved| {
                levels_too_long(level, solved.error_n_s, share(shape) * allowed)
            });
            match sound.filter(|_| down == 0) {
                Some(solved) => {
                    if beside_others
                        && !self.all_stay_clear(w, table.length_s, (p, solved.size_n_s(w, &step)))
                    {
                        break;
                    }
                    self.take(w, law, &step, &solved);
                    if landing {
                        self.time_s = end_s;
                    }
                    // Where nothing is left or entered, the next call goes on at the level at which this one stopped.
                    let starts_next = entering || (both_sides && !landing);
                    level = self.next_level(law, level, &step, &solved, (allowed, starts_next));
                    entering = false;
                }
                None => {
                    self.work.contact_rejections += 1;
                    level = if landing {
                        Kernel::level_within(remaining_s) + 1
                    } else {
                        level + down
                    };
                    if level > Kernel::finest() {
                        return Err(self.diverged(p));
                    }
                }
            }
        }
        Ok((level, entering))
    }

    /// Error of the impulse of a port that one step may make, N s.
    #[inline(always)]
    pub(super) fn allowed_n_s<L: ContactLaw>(
        &self,
        law: L,
        step: &ContactStep,
        solved: Option<&SolvedStep>,
    ) -> f64 {
        let port = &self.ports[step.port];
        let mut speed_m_s = port.impact_velocity_m_s.max(port.rate_m_s.abs());
        if let (true, Some(solved)) = (law.acts_on_both_sides(), solved) {
            // Nothing strikes: a march that starts at rest has no other scale than the speed that it takes up.
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

/// Share of the allowed error that a step may spend.
#[inline(always)]
pub(super) fn share(shape: ForceBasis) -> f64 {
    match shape {
        ForceBasis::Onset => ONSET_ERROR_SHARE,
        ForceBasis::Smooth => 1.0,
    }
}
