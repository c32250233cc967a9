//! Length of the next contact step.
//!
//! The error of the last step determines the length of the next one. Towards the end of the contact
//! steps are shorter: the force ends like `t^1.5`, which no polynomial follows. On a step of length
//! `L` that begins a time `d` before the end, the interpolation error falls like `rho^-7` with the
//! number of nodes. Here `rho + 1/rho = 4 d / L - 2` (Bernstein's ellipse through the singularity).
//! The estimate of [`ContactStep`] follows its power 3/2.

use super::step::{ContactStep, SolvedStep};
use crate::contact::share;
use crate::force_response::basis::NODES;
use crate::integrator::Integrator;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::state::PortState;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_model::contact::ContactLaw;

/// Factors on the error of a step for 1.5 times its length, and from there to twice its length; the
/// error grows with a power of 8 to 11 of the length.
const ERROR_PER_LEVEL: [f64; 2] = [38.0, 13.0];

/// Fraction of the allowed error for which a step is planned: the next part of a contact may be
/// harder than the last.
const PLANNED_ERROR_SHARE: f64 = 0.3;

/// Largest number of levels by which a step becomes longer at once; a longer step has a lower level.
const MAX_LEVEL_INCREASE: i32 = 3 * LEVELS_PER_OCTAVE;

/// Factor by which the error is smaller than the power of `rho`, for an end like `t^1.5`.
const RELEASE_ERROR_GAIN: f64 = 1000.0;

/// Fraction of the impulse of a force like `t^1.5` that seven Gauss nodes miss if it ends in the
/// second half of a step: at most 0.0086.
pub(crate) const RELEASE_ERROR_FACTOR: f64 = 0.01;

/// Error factor for an integration with derivative: the derivative of the force ends like `t^0.5`,
/// so that the complete remaining impulse must be negligible.
pub(crate) const RELEASE_ERROR_FACTOR_OF_DERIVATIVE: f64 = 2.0;

/// Distance to the end of the contact, in step lengths, beyond which the end has no effect: the
/// power of `rho` is above 1e8 there.
const MAX_RELEASE_DISTANCE: f64 = 2.0;

impl ContactStep<'_> {
    /// Returns the time from the last node to the end, s.
    pub(crate) fn last_gap_s(&self) -> f64 {
        self.table.length_s * (1.0 - self.basis.positions[NODES - 1])
    }
}

impl SolvedStep {
    /// Returns the speed at the end of the step, m/s, from the last node.
    fn last_speed_m_s(&self, step: &ContactStep) -> f64 {
        (self.penetration.0[NODES] - self.penetration.0[NODES - 1]) / step.last_gap_s()
    }
}

impl Integrator<'_> {
    /// Returns the desired level of the step after an accepted one of `level`; with `starts_next`
    /// the next contact also starts at it, or at its present level where that is coarser: then
    /// another port shortened the step.
    #[inline(always)]
    pub(crate) fn next_level<L: ContactLaw>(
        &mut self,
        law: L,
        level: i32,
        step: &ContactStep,
        solved: &SolvedStep,
        (allowed, starts_next): (f64, bool),
    ) -> i32 {
        let longer = level
            - levels_to_spare(
                level,
                solved.error_n_s,
                PLANNED_ERROR_SHARE * share(step.shape) * allowed,
            );
        let coarsest = self.coarsest(law);
        if starts_next {
            let port = &mut self.ports[step.port];
            port.entry_level = longer.min(port.entry_level).max(coarsest);
        }
        // The error of the onset basis does not predict the next step.
        let level = if step.shape == ForceBasis::Onset {
            level
        } else {
            longer
        };
        let level = if law.acts_on_both_sides() {
            level
        } else {
            self.before_leaving(level, step, solved, allowed)
        };
        level.max(coarsest)
    }

    /// Returns the coarsest level of a contact step. Where the law acts at all times, no flight
    /// propagates the fast modes exactly. For the derivative of the motion, steps must then resolve a
    /// disturbance of them, even where the motion does not contain them.
    #[inline(always)]
    pub(crate) fn coarsest<L: ContactLaw>(&self, law: L) -> i32 {
        if law.acts_on_both_sides() && self.resolves_derivative() {
            Kernel::level_within(1.0 / self.kernel.fastest_rad_s)
        } else {
            Kernel::coarsest()
        }
    }

    /// Returns the desired level, or a finer one for the predicted end of the contact.
    #[inline(always)]
    fn before_leaving(
        &self,
        requested: i32,
        step: &ContactStep,
        solved: &SolvedStep,
        allowed: f64,
    ) -> i32 {
        let Some(leaving_s) = predicted_release_s(&self.ports[step.port], step, solved) else {
            return requested;
        };
        if leaving_s >= MAX_RELEASE_DISTANCE * Kernel::length_s(requested) {
            return requested;
        }
        let pulling_n_s = leaving_s * solved.force.0[NODES - 1];
        // The error of one step that carries the point past the surface may be negligible.
        if self.release_error_factor * pulling_n_s <= allowed {
            return requested.max(Kernel::level_within(2.0 * leaving_s));
        }
        let coarsest = Kernel::level_within(leaving_s);
        let is_enough = |level: &i32| {
            ellipse_power(leaving_s / Kernel::length_s(*level)) * RELEASE_ERROR_GAIN * allowed
                >= pulling_n_s
        };
        requested.max(
            (coarsest..coarsest + LEVELS_PER_OCTAVE)
                .find(is_enough)
                .unwrap_or(coarsest + LEVELS_PER_OCTAVE),
        )
    }
}

/// Predicts the time until the penetration ends, from the parabola through the last speeds of a
/// step. On a step so short that the difference of its last penetrations is roundoff, the change of
/// the rate over the step limits the curvature.
#[inline(always)]
fn predicted_release_s(port: &PortState, step: &ContactStep, solved: &SolvedStep) -> Option<f64> {
    if port.rate_m_s >= 0.0 || port.penetration_m <= 0.0 {
        return None;
    }
    let largest = ((port.rate_m_s - step.start_rate_m_s) / step.table.length_s).abs();
    let last = (port.rate_m_s - solved.last_speed_m_s(step)) / step.last_gap_s();
    let curvature = last.clamp(-largest, largest);
    let discriminant = port.rate_m_s * port.rate_m_s - 4.0 * curvature * port.penetration_m;
    let leaving_s = 2.0 * port.penetration_m / (-port.rate_m_s + discriminant.max(0.0).sqrt());
    (discriminant >= 0.0).then_some(leaving_s)
}

/// Returns `rho^10.5` for a step whose length fits `ratio` times into the time to the end of the
/// contact.
#[inline(always)]
fn ellipse_power(ratio: f64) -> f64 {
    let z = 2.0 * ratio - 1.0;
    let rho = z + (z * z - 1.0).max(0.0).sqrt();
    let fourth = (rho * rho) * (rho * rho);
    fourth * fourth * (rho * rho) * rho.sqrt()
}

/// Returns the levels by which a step should have been shorter, at most an octave, beyond which the
/// error estimate is unreliable.
#[inline(always)]
pub(super) fn levels_too_long(level: i32, error: f64, allowed: f64) -> i32 {
    let (mut down, mut shorter) = (0, error);
    while shorter > allowed && down < LEVELS_PER_OCTAVE {
        down += 1;
        shorter /= ERROR_PER_LEVEL[((level + down) & 1) as usize];
    }
    down
}

/// Returns the levels by which a step could have been longer.
#[inline(always)]
fn levels_to_spare(level: i32, error: f64, allowed: f64) -> i32 {
    let mut spare = 0;
    let factor = |spare: i32| ERROR_PER_LEVEL[((level - spare) & 1) as usize];
    let mut longer = error.max(f64::MIN_POSITIVE) * factor(0);
    while longer < allowed && spare < MAX_LEVEL_INCREASE {
        spare += 1;
        longer *= factor(spare);
    }
    spare
}
