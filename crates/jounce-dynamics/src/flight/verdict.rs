//! Verdict on a flight step: clear, a proved first crossing, or too long.

use super::certificate::FlightStep;
use super::crossing::Crossing;
use crate::flow::state::dot_of_magnitudes;
use crate::impact::acceleration::RESOLVED_ROUNDOFFS;
use crate::integrator::Integrator;
use crate::ports::small_list::SmallList;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_simd::Simd;
use smallvec::smallvec;

/// Certificate uncertainty, relative to the motion, below which the interpolant decides on a step
/// that is neither clear nor a proved crossing. A contact missed in it is shallower than this
/// fraction of the motion.
pub(crate) const RESOLVED_UNCERTAINTY: f64 = 1e-12;

/// Outcome of one attempted step.
pub(crate) enum FlightVerdict {
    Clear,
    Strike(Crossing),
    /// Levels to decrease before the next attempt.
    Unclear(i32),
}

/// Outcome of a step for all ports.
pub(crate) enum StepOutcome {
    /// Free of contact.
    Clear,
    /// Each of these ports has a crossing, proved or assumed.
    Strikes(SmallList<(usize, Crossing)>),
    /// Levels to decrease before the next attempt.
    Unclear(i32),
}

impl StepOutcome {
    /// Adds the verdict on one more port.
    #[inline(always)]
    pub(crate) fn add(&mut self, p: usize, verdict: FlightVerdict) {
        match (&mut *self, verdict) {
            (_, FlightVerdict::Clear) => {}
            (StepOutcome::Unclear(a), FlightVerdict::Unclear(b)) => *a = b.max(*a),
            (StepOutcome::Unclear(_), FlightVerdict::Strike(_)) => {}
            (_, FlightVerdict::Unclear(down)) => *self = StepOutcome::Unclear(down),
            (StepOutcome::Clear, FlightVerdict::Strike(crossing)) => {
                *self = StepOutcome::Strikes(smallvec![(p, crossing)]);
            }
            (StepOutcome::Strikes(strikes), FlightVerdict::Strike(crossing)) => {
                strikes.push((p, crossing));
            }
        }
    }
}

impl Integrator<'_> {
    /// Judges the flight of one port, which the forces of others move by terms of size `forced_m`.
    /// Distances below the roundoff of its displacement cannot be resolved: two bodies that touch far
    /// from the origin have neither gap nor relative motion as a scale.
    #[inline(always)]
    pub(crate) fn judge_with_others<W: Simd>(
        &self,
        w: W,
        p: usize,
        step: &FlightStep,
        displacement_m: f64,
        forced_m: impl Fn() -> f64,
    ) -> FlightVerdict {
        let roundoff_m = || RESOLVED_UNCERTAINTY * self.terms_m(w, p).max(forced_m());
        match self.judge_flight(p, step, displacement_m) {
            FlightVerdict::Unclear(_) if step.uncertainty_m() <= roundoff_m() => {
                by_interpolant(step, self.leaves_from_rest(p))
            }
            verdict => verdict,
        }
    }

    /// Returns the sum of the magnitudes of the terms of a displacement, m.
    #[inline(always)]
    pub(crate) fn terms_m<W: Simd>(&self, w: W, p: usize) -> f64 {
        dot_of_magnitudes(w, &self.ports[p].rows.displacement, &self.y)
    }

    #[inline(always)]
    fn judge_flight(&self, p: usize, step: &FlightStep, displacement_m: f64) -> FlightVerdict {
        if step.is_clear() || self.touches_within_roundoff(p, step) {
            return FlightVerdict::Clear;
        }
        if let Some(crossing) = step.crossing() {
            return FlightVerdict::Strike(crossing);
        }
        let uncertainty_m = step.uncertainty_m();
        if uncertainty_m <= RESOLVED_UNCERTAINTY * self.scale_m(p, displacement_m) {
            return by_interpolant(step, self.leaves_from_rest(p));
        }
        // The uncertainty falls with the fourth power of the length: two levels where one is not
        // enough.
        let far = uncertainty_m
            > 16.0
                * self.ports[p]
                    .penetration_m
                    .abs()
                    .max(RESOLVED_UNCERTAINTY * self.scale_m(p, displacement_m));
        FlightVerdict::Unclear(if far {
            2 * LEVELS_PER_OCTAVE
        } else {
            LEVELS_PER_OCTAVE
        })
    }

    /// True where a point touches its stop at the start of a step, and all its motion past the
    /// surface is roundoff: a held point is on its stop to roundoff only.
    fn touches_within_roundoff(&self, p: usize, step: &FlightStep) -> bool {
        if p >= self.kernel.plant.system.stops.len() {
            return false;
        }
        let resolved_m = RESOLVED_ROUNDOFFS * self.distance_roundoff_m(p);
        self.ports[p].penetration_m.abs() <= resolved_m
            && step.highest_m() + step.uncertainty_m() <= resolved_m
    }

    /// True for a touching port without speed that is in flight, so that it is not pressed.
    pub(crate) fn leaves_from_rest(&self, p: usize) -> bool {
        self.ports[p].penetration_m == 0.0 && self.ports[p].rate_m_s == 0.0
    }

    /// Returns the size of the motion, to which the uncertainty of the certificate is relative.
    fn scale_m(&self, p: usize, displacement_m: f64) -> f64 {
        let port = &self.ports[p];
        let gap = if port.gap_m.is_finite() {
            port.gap_m.abs()
        } else {
            0.0
        };
        // The motion of a point that leaves its stop from rest is not a scale yet.
        let from_rest = if port.rate_m_s == 0.0 {
            self.terms_of(&port.rows.displacement)
        } else {
            0.0
        };
        gap.max(displacement_m.abs())
            .max(port.rows.tone_scale_m)
            .max(from_rest)
    }
}

/// Decides below the resolution, where a contact has no effect on the force law, unless the
/// interpolant crosses. A point released from rest may rise at first, but does not return within
/// the uncertainty of the interpolant.
#[inline(always)]
pub(crate) fn by_interpolant(step: &FlightStep, from_rest: bool) -> FlightVerdict {
    match step.crossing_s() {
        None => FlightVerdict::Clear,
        Some(_) if from_rest && step.highest_m() <= step.uncertainty_m() => FlightVerdict::Clear,
        Some(guess_s) => FlightVerdict::Strike(Crossing {
            from_s: 0.0,
            guess_s,
            to_s: step.length_s,
        }),
    }
}
