//! All ports in flight.

use crate::march::certificate::FlightStep;
use crate::march::crossing::Crossing;
use crate::march::error::MarchError;
use crate::march::flight::{LOCATED, Verdict, by_interpolant};
use crate::march::kernel::Kernel;
use crate::march::level::PER_OCTAVE;
use crate::march::marcher::Marcher;
use crate::march::state::{dot, dot_of_magnitudes};
use crate::wide::Wide;

/// What became of a step for all ports together.
pub enum Outcome {
    /// Free of contact.
    Clear,
    /// Each of these ports is proved to cross, or taken to.
    Strikes(Vec<(usize, Crossing)>),
    /// Levels to go down before the next attempt.
    Unclear(i32),
}

impl Outcome {
    /// Adds the verdict on one more port.
    pub fn and(self, p: usize, verdict: Verdict) -> Self {
        match (self, verdict) {
            (Outcome::Unclear(a), Verdict::Unclear(b)) => Outcome::Unclear(a.max(b)),
            (Outcome::Unclear(down), _) | (_, Verdict::Unclear(down)) => Outcome::Unclear(down),
            (outcome, Verdict::Clear) => outcome,
            (Outcome::Clear, Verdict::Strike(crossing)) => Outcome::Strikes(vec![(p, crossing)]),
            (Outcome::Strikes(mut strikes), Verdict::Strike(crossing)) => {
                strikes.push((p, crossing));
                Outcome::Strikes(strikes)
            }
        }
    }
}

impl Marcher<'_> {
    /// Flies until a port strikes or until the end.
    #[inline(always)]
    pub(super) fn fly<W: Wide>(&mut self, w: W, end_s: f64) -> Result<(), MarchError> {
        let mut grow = PER_OCTAVE;
        while self.time_s < end_s {
            let (level, remaining_s) = (self.flight_level, self.forced.remaining_s(self.time_s, end_s));
            let landing = Kernel::length_s(level) >= remaining_s;
            let length_s = if landing { remaining_s } else { Kernel::length_s(level) };
            // Of a step that ends early, the shortest level that bounds it from above.
            let tight = if landing { level.max(Kernel::level_within(remaining_s) - 1) } else { level };
            match self.attempt_all(w, tight, length_s, landing) {
                Outcome::Clear => {
                    let start_s = self.time_s;
                    self.move_on(length_s, if landing { end_s } else { start_s + length_s });
                    for port in self.ports.iter_mut().filter(|port| !port.clearance.is_unseen) {
                        [port.penetration_m, port.rate_m_s] = port.ahead;
                    }
                    self.work.flight_steps += 1;
                    self.flight_level = (level - grow).max(Kernel::coarsest());
                    grow = PER_OCTAVE;
                }
                Outcome::Strikes(strikes) => {
                    self.strike_first(w, &strikes);
                    return Ok(());
                }
                Outcome::Unclear(down) => {
                    self.work.flight_rejections += 1;
                    // The step after the next would fail as this one did.
                    grow = 0;
                    self.flight_level = (tight + down).min(Kernel::finest());
                    if self.ports.iter().any(|port| !port.penetration_m.is_finite()) {
                        return Err(MarchError::NotFinite { time_s: self.time_s });
                    }
                }
            }
        }
        Ok(())
    }

    /// Looks at a step: the state at its end is in `next`, the motion of each port there in `ahead`.
    #[inline(always)]
    fn attempt_all<W: Wide>(&mut self, w: W, level: i32, length_s: f64, landing: bool) -> Outcome {
        if landing {
            self.look_ahead(w, length_s);
        } else {
            self.kernel.flow(level).apply(w, &self.y, &mut self.next);
        }
        let mut outcome = Outcome::Clear;
        for p in 0..self.kernel.plant.ports.len() {
            if self.stays_clear(w, p, length_s, None) {
                continue;
            }
            self.look_again(w, p);
            let drive = if landing { self.drive_after(p, length_s) } else { self.drive_after_level(p, level) };
            let rows = &self.ports[p].rows;
            let motion = [dot(w, &rows.displacement, &self.next) + drive[0] - rows.gap_m, dot(w, &rows.velocity, &self.next) + drive[1]];
            self.ports[p].ahead = motion;
            let step = self.step_of(w, p, level, length_s, motion, drive);
            outcome = outcome.and(p, self.judge_beside(w, p, &step, motion[0]));
        }
        outcome
    }

    /// Judges the flight of one port beside others. What is shallower than the roundoff of its displacement cannot be resolved: two
    /// bodies that touch far from the origin have neither gap nor relative motion as a scale.
    #[inline(always)]
    pub(super) fn judge_beside<W: Wide>(&self, w: W, p: usize, step: &FlightStep, displacement_m: f64) -> Verdict {
        match self.judge_flight(p, step, displacement_m) {
            Verdict::Unclear(_) if step.uncertainty_m() <= LOCATED * self.terms_m(w, p) => by_interpolant(step, self.leaves_from_rest(p)),
            verdict => verdict,
        }
    }

    /// Sum of the magnitudes of what a displacement is summed from, m.
    #[inline(always)]
    pub(super) fn terms_m<W: Wide>(&self, w: W, p: usize) -> f64 {
        dot_of_magnitudes(w, &self.ports[p].rows.displacement, &self.y)
    }

    /// Displacement and velocity of a port under the drive after a level.
    #[inline(always)]
    fn drive_after_level(&mut self, p: usize, level: i32) -> [f64; 2] {
        let mut drive = self.forced.motion_after(p, Kernel::length_s(level));
        for tone in &mut self.tones {
            let turn = tone.end(level);
            let [place, speed] = tone.motion_after(p, turn);
            drive = [drive[0] + place, drive[1] + speed];
        }
        drive
    }

    /// Moves to the first of several crossings.
    #[inline(always)]
    fn strike_first<W: Wide>(&mut self, w: W, strikes: &[(usize, Crossing)]) {
        let mut first = (0, f64::INFINITY);
        for (p, crossing) in strikes {
            let (after_s, _) = self.locate(w, *p, *crossing);
            if after_s < first.1 {
                first = (*p, after_s);
            }
        }
        let (p, after_s) = first;
        if strikes.len() > 1 {
            self.look_ahead(w, after_s);
        }
        self.move_on(after_s, self.time_s + after_s);
        self.join(w, p);
    }
}
