//! Flow over any time, and the motion of the ports at its end.

use super::flow::MAX_SERIES_ARGUMENT;
use super::integrator::Integrator;
use super::state::dot;
use crate::simd::Simd;
use faer::c64;

impl Integrator<'_> {
    /// Reads penetration and rate of a port off the state.
    #[inline(always)]
    pub(super) fn update_port<W: Simd>(&mut self, w: W, p: usize) {
        let motion = self.reading(w, p);
        let port = &mut self.ports[p];
        [port.penetration_m, port.rate_m_s] = motion;
    }

    /// The same, m and m/s.
    #[inline(always)]
    pub(super) fn reading<W: Simd>(&self, w: W, p: usize) -> [f64; 2] {
        let rows = &self.ports[p].rows;
        let mut motion = [
            dot(w, &rows.displacement, &self.y) - rows.gap_m,
            dot(w, &rows.velocity, &self.y),
        ];
        let [place, speed] = self.excitation.motion_after(p, 0.0);
        motion = [motion[0] + place, motion[1] + speed];
        for tone in &self.tones {
            let [place, speed] = tone.motion(p);
            motion = [motion[0] + place, motion[1] + speed];
        }
        motion
    }

    /// Puts the state after an exact flow over any time into `next`.
    #[inline(always)]
    pub(super) fn propagate_to<W: Simd>(&mut self, w: W, length_s: f64) {
        if let Some(flow) = self.excitation.flow_over(length_s) {
            flow.apply(w, &self.y, &mut self.next);
            return;
        }
        self.next.copy_from_slice(&self.y);
        self.carry_on(w, length_s);
    }

    /// Moves `next` from one time ahead of the present to another: on or back where that is near, else from the present again, for what is
    /// lost on a long way and back would hide a point that hardly leaves its stop.
    #[inline(always)]
    pub(super) fn propagate_from<W: Simd>(&mut self, w: W, from_s: f64, to_s: f64) {
        let change_s = to_s - from_s;
        if change_s.abs() * self.kernel.stiffest_rad_s <= MAX_SERIES_ARGUMENT {
            self.carry_on(w, change_s);
        } else {
            self.propagate_to(w, to_s);
        }
    }

    /// Carries `next` on over a time, or back over a short one.
    ///
    /// The time is cut into levels, longest first, and a rest so short that the power series of the flow is exact.
    #[inline(always)]
    fn carry_on<W: Simd>(&mut self, w: W, change_s: f64) {
        let kernel = self.kernel;
        let (flows, rest_s) = kernel.flows_within(change_s);
        kernel
            .generator
            .carry(w, &flows, (rest_s, kernel.stiffest_rad_s), &mut self.next);
    }

    /// Penetration and rate of a port in `next`, `length_s` after the present time.
    #[inline(always)]
    pub(super) fn motion_ahead<W: Simd>(&self, w: W, p: usize, length_s: f64) -> [f64; 2] {
        let rows = &self.ports[p].rows;
        let mut motion = [
            dot(w, &rows.displacement, &self.next) - rows.gap_m,
            dot(w, &rows.velocity, &self.next),
        ];
        let [place, speed] = self.excitation.motion_after(p, length_s);
        motion = [motion[0] + place, motion[1] + speed];
        for tone in &self.tones {
            let [place, speed] =
                tone.motion_after(p, c64::cis(tone.angular_frequency_rad_s * length_s));
            motion = [motion[0] + place, motion[1] + speed];
        }
        motion
    }

    /// Moves to the state in `next`; the ports are left to be seen.
    #[inline(always)]
    pub(super) fn move_on(&mut self, length_s: f64, end_s: f64) {
        self.note(length_s, &[]);
        std::mem::swap(&mut self.y, &mut self.next);
        self.time_s = end_s;
        self.tones.iter_mut().for_each(|tone| tone.set(end_s));
        self.excitation
            .pass(self.kernel, length_s, end_s, &mut self.y);
    }

    /// Sets what a port does at the present time.
    #[inline(always)]
    pub(super) fn set_motion(&mut self, p: usize, motion: [f64; 2]) {
        let port = &mut self.ports[p];
        [port.penetration_m, port.rate_m_s] = motion;
    }
}
