//! Flow over any time, and the motion of the port at its end.

use super::flow::SHORT;
use super::kernel::Kernel;
use super::marcher::Marcher;
use super::state::dot;
use crate::wide::Wide;
use faer::c64;

impl Marcher<'_> {
    /// Reads penetration and rate off the state.
    #[inline(always)]
    pub(super) fn see<W: Wide>(&mut self, w: W) {
        let mut motion = [dot(w, &self.rows.displacement, &self.y) - self.rows.gap_m, dot(w, &self.rows.velocity, &self.y)];
        let [place, speed] = self.forced.motion_after(0, 0.0);
        motion = [motion[0] + place, motion[1] + speed];
        for tone in &self.tones {
            let [place, speed] = tone.motion();
            motion = [motion[0] + place, motion[1] + speed];
        }
        [self.penetration_m, self.rate_m_s] = motion;
    }

    /// Puts the state after an exact flow over any time into `next`; returns penetration and rate there.
    ///
    /// The time is cut into levels, longest first, and a rest so short that the power series of the flow is exact.
    #[inline(always)]
    pub(super) fn look_ahead<W: Wide>(&mut self, w: W, length_s: f64) -> [f64; 2] {
        let kernel = self.kernel;
        if let Some(flow) = self.forced.flow_over(length_s) {
            flow.apply(w, &self.y, &mut self.next);
            return self.motion_in_next(w, length_s);
        }
        self.next.copy_from_slice(&self.y);
        let mut rest_s = length_s;
        while rest_s * kernel.fastest_rad_s > SHORT {
            let level = Kernel::level_within(rest_s);
            kernel.flow(level).apply(w, &self.next, &mut self.scratch);
            std::mem::swap(&mut self.next, &mut self.scratch);
            rest_s -= Kernel::length_s(level);
        }
        self.look_on(w, rest_s, length_s)
    }

    /// Carries `next` on by a short time, to `length_s` after the present one; returns penetration and rate there.
    #[inline(always)]
    pub(super) fn look_on<W: Wide>(&mut self, w: W, short_s: f64, length_s: f64) -> [f64; 2] {
        self.kernel.generator.glide(w, short_s, &mut self.next);
        self.motion_in_next(w, length_s)
    }

    /// Penetration and rate of the state in `next`, `length_s` after the present time.
    #[inline(always)]
    fn motion_in_next<W: Wide>(&self, w: W, length_s: f64) -> [f64; 2] {
        let mut motion = [dot(w, &self.rows.displacement, &self.next) - self.rows.gap_m, dot(w, &self.rows.velocity, &self.next)];
        let [place, speed] = self.forced.motion_after(0, length_s);
        motion = [motion[0] + place, motion[1] + speed];
        for tone in &self.tones {
            let [place, speed] = tone.motion_after(c64::cis(tone.angular_frequency_rad_s * length_s));
            motion = [motion[0] + place, motion[1] + speed];
        }
        motion
    }

    /// Moves to the state in `next`.
    #[inline(always)]
    pub(super) fn move_on(&mut self, length_s: f64, end_s: f64, motion: [f64; 2]) {
        self.note(length_s, None);
        std::mem::swap(&mut self.y, &mut self.next);
        self.time_s = end_s;
        self.tones.iter_mut().for_each(|tone| tone.set(end_s));
        self.forced.pass(self.kernel, length_s, end_s, &mut self.y);
        [self.penetration_m, self.rate_m_s] = motion;
    }
}
