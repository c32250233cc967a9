//! Flight: exact flow in certified steps, until the stop is struck or the end is reached.

use super::certificate::FlightStep;
use super::crossing::Crossing;
use super::error::MarchError;
use super::flow::SHORT;
use super::kernel::Kernel;
use super::marcher::{Marcher, Regime};
use super::state::{dot, dot_abs};
use crate::wide::Wide;

/// Certificate uncertainty, relative to the motion, below which a step that is neither clear nor a proved crossing is taken for
/// what its interpolant says: a contact that could hide in it is shallower than this fraction of the motion.
const LOCATED: f64 = 1e-12;

/// What became of one attempted step.
enum Verdict {
    Clear,
    Strike(Crossing),
    /// Levels to go down before the next attempt.
    Unclear(i32),
}

impl Marcher<'_> {
    /// Flies until contact or until the end.
    #[inline(always)]
    pub(super) fn flight<W: Wide>(&mut self, w: W, end_s: f64) -> Result<(), MarchError> {
        if self.kernel.plant.ports.is_empty() {
            let length_s = self.forced.remaining_s(self.time_s, end_s);
            let motion = self.look_ahead(w, length_s);
            self.move_on(length_s, end_s, motion);
            self.work.flight_steps += 1;
            return Ok(());
        }
        let mut grow = 1;
        while self.time_s < end_s {
            let level = self.flight_level;
            let length_s = Kernel::length_s(level);
            let remaining_s = self.forced.remaining_s(self.time_s, end_s);
            let landing = length_s >= remaining_s;
            // Of a step that ends early, the shortest level that bounds it from above.
            let tight = if landing { level.max(Kernel::level_within(remaining_s) - 1) } else { level };
            let verdict = if landing { self.land(w, tight, remaining_s, end_s) } else { self.attempt(w, level) };
            match verdict {
                Verdict::Clear => {
                    self.work.flight_steps += 1;
                    self.flight_level = (level - grow).max(Kernel::coarsest());
                    grow = 1;
                }
                Verdict::Strike(crossing) => {
                    self.strike(w, crossing);
                    return Ok(());
                }
                Verdict::Unclear(down) => {
                    self.work.flight_rejections += 1;
                    // The step after the next would fail as this one did.
                    grow = 0;
                    self.flight_level = (tight + down).min(Kernel::finest());
                    if !self.penetration_m.is_finite() {
                        return Err(MarchError::NotFinite { time_s: self.time_s });
                    }
                }
            }
        }
        Ok(())
    }

    /// One step of a level; taken only if clear.
    #[inline(always)]
    fn attempt<W: Wide>(&mut self, w: W, level: i32) -> Verdict {
        let kernel = self.kernel;
        kernel.flow(level).apply(w, &self.y, &mut self.next);
        let mut drive = self.forced.motion_after(0, Kernel::length_s(level));
        for tone in &mut self.tones {
            let turn = tone.end(level);
            let [place, speed] = tone.motion_after(turn);
            drive = [drive[0] + place, drive[1] + speed];
        }
        let motion =
            [dot(w, &self.rows.displacement, &self.next) + drive[0] - self.rows.gap_m, dot(w, &self.rows.velocity, &self.next) + drive[1]];
        let step = self.step_of(w, level, Kernel::length_s(level), motion, drive);
        let verdict = self.judge_flight(&step, motion[0]);
        if let Verdict::Clear = verdict {
            let length_s = step.length_s;
            if self.record.is_some() {
                self.note(length_s, None);
            }
            std::mem::swap(&mut self.y, &mut self.next);
            self.time_s += length_s;
            for tone in &mut self.tones {
                let turn = tone.end(level);
                tone.turn *= turn;
            }
            self.forced.pass(self.kernel, length_s, self.time_s, &mut self.y);
            [self.penetration_m, self.rate_m_s] = motion;
        }
        verdict
    }

    /// A last step of any length, to the end.
    #[inline(always)]
    fn land<W: Wide>(&mut self, w: W, level: i32, length_s: f64, end_s: f64) -> Verdict {
        let motion = self.look_ahead(w, length_s);
        let mut drive = self.forced.motion_after(0, length_s);
        for tone in &self.tones {
            let [place, speed] = tone.motion_after(faer::c64::cis(tone.angular_frequency_rad_s * length_s));
            drive = [drive[0] + place, drive[1] + speed];
        }
        // The level bounds the length from above: its split into slow and fast serves.
        let step = self.step_of(w, level, length_s, motion, drive);
        let verdict = self.judge_flight(&step, motion[0]);
        if let Verdict::Clear = verdict {
            self.move_on(length_s, end_s, motion);
        }
        verdict
    }

    /// The certificate's view of a step that ends in `next` with `motion` there, of which `drive` is the drives' share.
    #[inline(always)]
    fn step_of<W: Wide>(&self, w: W, level: i32, length_s: f64, motion: [f64; 2], drive: [f64; 2]) -> FlightStep {
        let flight = self.kernel.flight(0, level);
        let mut step = FlightStep {
            length_s,
            distance_m: [self.penetration_m, motion[0]],
            speed_m_s: [self.rate_m_s, motion[1]],
            fourth_bound: dot_abs(w, &flight.slow_fourth, &self.y) + self.rows.tone_fourth + self.forced.fourth_bound(0, length_s),
            fast_m: 0.0,
            fast_bound_m: 0.0,
            fast_bound_m_s: 0.0,
        };
        if let Some(fast) = &flight.fast {
            let [place, speed] = self.drive();
            let slow = dot(w, &fast.slow_displacement, &self.y) + place - self.rows.gap_m;
            step.distance_m = [slow, dot(w, &fast.slow_displacement, &self.next) + drive[0] - self.rows.gap_m];
            step.speed_m_s = [dot(w, &fast.slow_velocity, &self.y) + speed, dot(w, &fast.slow_velocity, &self.next) + drive[1]];
            step.fast_m = self.penetration_m - slow;
            step.fast_bound_m = dot_abs(w, &fast.displacement_bound, &self.y);
            step.fast_bound_m_s = dot_abs(w, &fast.velocity_bound, &self.y);
        }
        step
    }

    #[inline(always)]
    fn judge_flight(&self, step: &FlightStep, displacement_m: f64) -> Verdict {
        if step.is_clear() {
            return Verdict::Clear;
        }
        if let Some(crossing) = step.crossing() {
            return Verdict::Strike(crossing);
        }
        let uncertainty_m = step.uncertainty_m();
        if uncertainty_m <= LOCATED * self.scale_m(displacement_m) {
            // Shallower than the resolution: nothing the force law could feel, unless the interpolant itself crosses.
            return match step.crossing_s() {
                None => Verdict::Clear,
                Some(guess_s) => Verdict::Strike(Crossing { from_s: 0.0, guess_s, to_s: step.length_s }),
            };
        }
        // The uncertainty falls like the fourth power of the length: two levels where one is not enough.
        let far = uncertainty_m > 16.0 * self.penetration_m.abs().max(LOCATED * self.scale_m(displacement_m));
        Verdict::Unclear(if far { 2 } else { 1 })
    }

    /// Size of the motion against which the certificate's uncertainty is held.
    fn scale_m(&self, displacement_m: f64) -> f64 {
        let gap = if self.rows.gap_m.is_finite() { self.rows.gap_m.abs() } else { 0.0 };
        gap.max(displacement_m.abs()).max(self.rows.tone_scale_m)
    }

    /// Displacement and velocity of the port under the drive at the present time.
    #[inline(always)]
    fn drive(&self) -> [f64; 2] {
        self.tones.iter().map(|tone| tone.motion()).fold(self.forced.motion_after(0, 0.0), |a, b| [a[0] + b[0], a[1] + b[1]])
    }

    /// Moves onto the stop, by Newton on the exact flow inside the proved interval, and enters contact.
    #[inline(always)]
    fn strike<W: Wide>(&mut self, w: W, crossing: Crossing) {
        let Crossing { mut from_s, mut guess_s, mut to_s } = crossing;
        let short_s = SHORT / self.kernel.fastest_rad_s;
        let mut motion = self.look_ahead(w, guess_s);
        for _ in 0..20 {
            if motion[0] > 0.0 {
                to_s = guess_s
            } else {
                from_s = guess_s
            }
            let newton = guess_s - motion[0] / motion[1];
            let next = if newton >= from_s && newton <= to_s { newton } else { 0.5 * (from_s + to_s) };
            let change = (next - guess_s).abs();
            motion = if change <= short_s { self.look_on(w, next - guess_s, next) } else { self.look_ahead(w, next) };
            guess_s = next;
            // Newton squares the error: a change this small left one of roundoff, and the flow to `next` has been looked at.
            if change <= 1e-7 * guess_s.min(1.0 / self.kernel.fastest_rad_s) {
                break;
            }
        }
        self.move_on(guess_s, self.time_s + guess_s, motion);
        self.penetration_m = 0.0;
        self.strike_m_s = self.strike_m_s.max(self.rate_m_s);
        self.statistics.contacts += 1;
        self.statistics.strike_sum_m_s += self.rate_m_s;
        self.statistics.max_strike_m_s = self.statistics.max_strike_m_s.max(self.rate_m_s);
        self.regime = Regime::Contact;
    }
}
