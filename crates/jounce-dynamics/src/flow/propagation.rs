//! Flow over any time, and the motion of the ports at its end.

use super::state::dot;
use crate::flow::MAX_SERIES_ARGUMENT;
use crate::integrator::{Integrator, TrialState};
use crate::ports::state::{ContactState, PortState};
use jounce_linalg::c64;
use jounce_simd::Simd;

impl Integrator<'_> {
    /// Updates penetration and rate of a port from the state.
    #[inline(always)]
    pub(crate) fn update_port<W: Simd>(&mut self, w: W, p: usize) {
        let motion = self.reading(w, p);
        let port = &mut self.ports[p];
        [port.penetration_m, port.rate_m_s] = motion;
    }

    /// Updates all ports in flight.
    #[inline(always)]
    pub(crate) fn update_free_ports<W: Simd>(&mut self, w: W) {
        for p in 0..self.kernel.plant.ports.len() {
            if self.ports[p].contact_state == ContactState::Flight {
                self.update_port(w, p);
            }
        }
    }

    /// Returns penetration and rate of a port, m and m/s.
    #[inline(always)]
    pub(crate) fn reading<W: Simd>(&self, w: W, p: usize) -> [f64; 2] {
        let PortState { rows, gap_m, .. } = &self.ports[p];
        let mut motion = [
            dot(w, &rows.displacement, &self.y) - gap_m,
            dot(w, &rows.velocity, &self.y),
        ];
        let [displacement, speed] = self.excitation.motion_after(p, 0.0);
        motion = [motion[0] + displacement, motion[1] + speed];
        for tone in &self.tones {
            let [displacement, speed] = tone.motion(p);
            motion = [motion[0] + displacement, motion[1] + speed];
        }
        motion
    }

    /// Sets a trial state to that after an exact flow over any time.
    #[inline(always)]
    pub(crate) fn propagate_to<W: Simd>(&self, w: W, length_s: f64, trial: &mut TrialState) {
        if let Some(flow) = self.excitation.flow_over(length_s) {
            flow.apply(w, &self.y, &mut trial.y);
            return;
        }
        trial.y.copy_from_slice(&self.y);
        self.propagate_remainder(w, length_s, trial);
    }

    /// Moves a trial state from one time ahead of the current one to another. Over a short time it
    /// moves on or back, otherwise from the current time: the roundoff of a long flow would hide a
    /// point that hardly leaves its stop.
    #[inline(always)]
    pub(crate) fn propagate_from<W: Simd>(
        &self,
        w: W,
        [from_s, to_s]: [f64; 2],
        trial: &mut TrialState,
    ) {
        let change_s = to_s - from_s;
        if change_s.abs() * self.kernel.stiffest_rad_s <= MAX_SERIES_ARGUMENT {
            self.propagate_remainder(w, change_s, trial);
        } else {
            self.propagate_to(w, to_s, trial);
        }
    }

    /// Propagates a trial state over a time, or back over a short one.
    ///
    /// The time is split into levels, longest first, and a remainder so short that the power series
    /// of the flow is exact.
    #[inline(always)]
    fn propagate_remainder<W: Simd>(&self, w: W, change_s: f64, trial: &mut TrialState) {
        let kernel = self.kernel;
        let (flows, rest_s) = kernel.flows_within(change_s);
        kernel
            .generator
            .carry(w, &flows, (rest_s, kernel.stiffest_rad_s), &mut trial.y);
    }

    /// Returns penetration and rate of a port in a trial state, `length_s` after the current time.
    #[inline(always)]
    pub(crate) fn motion_after<W: Simd>(
        &self,
        w: W,
        p: usize,
        length_s: f64,
        trial: &TrialState,
    ) -> [f64; 2] {
        let PortState { rows, gap_m, .. } = &self.ports[p];
        let mut motion = [
            dot(w, &rows.displacement, &trial.y) - gap_m,
            dot(w, &rows.velocity, &trial.y),
        ];
        let [displacement, speed] = self.excitation.motion_after(p, length_s);
        motion = [motion[0] + displacement, motion[1] + speed];
        for tone in &self.tones {
            let [displacement, speed] =
                tone.motion_after(p, c64::cis(tone.angular_frequency_rad_s * length_s));
            motion = [motion[0] + displacement, motion[1] + speed];
        }
        motion
    }

    /// Ends a flight of any length in a trial state; the ports are not updated.
    #[inline(always)]
    pub(crate) fn advance_state<W: Simd>(
        &mut self,
        w: W,
        length_s: f64,
        end_s: f64,
        trial: &mut TrialState,
    ) {
        self.note(length_s, &[]);
        self.tones.iter_mut().for_each(|tone| tone.set(end_s));
        self.enter_trial(w, length_s, end_s, trial);
    }

    /// Enters a trial state at the end of its step; tones and ports are not updated.
    #[inline(always)]
    pub(crate) fn enter_trial<W: Simd>(
        &mut self,
        w: W,
        length_s: f64,
        end_s: f64,
        trial: &mut TrialState,
    ) {
        std::mem::swap(&mut self.y, &mut trial.y);
        self.time_s = end_s;
        self.excitation
            .pass(w, self.kernel, length_s, end_s, (&trial.y, &mut self.y));
    }

    /// Sets the motion of a port at the current time.
    #[inline(always)]
    pub(crate) fn set_motion(&mut self, p: usize, motion: [f64; 2]) {
        let port = &mut self.ports[p];
        [port.penetration_m, port.rate_m_s] = motion;
    }
}
