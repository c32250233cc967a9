//! Ports in flight during the contact of others.

use super::joint_solve::JointStep;
use crate::contact::nodal;
use crate::contact::step::{ContactStep, SolvedStep};
use crate::flight::crossing::Crossing;
use crate::flight::forced::{ForcedFlight, rest_bounds};
use crate::flight::verdict::{FlightVerdict, StepOutcome};
use crate::flow::state::{add_force_response, dot, dot_of_magnitudes};
use crate::force_response::basis::NODES;
use crate::integrator::{Integrator, TrialState};
use crate::ports::small_list::SmallList;
use crate::ports::state::{ContactState, PortState};
use crate::tables::joint::StepLength;
use jounce_simd::{F64x8, Simd};
use std::borrow::Cow;

impl Integrator<'_> {
    /// Judges the flight of every other port over a solved step; the trial state is the free motion
    /// to its end.
    #[inline(always)]
    pub(super) fn check_free_ports<W: Simd>(
        &mut self,
        w: W,
        length: StepLength,
        steps: &[ContactStep],
        solved: &[SolvedStep],
        trial: &mut TrialState,
    ) -> StepOutcome {
        w.out_of_line(
            #[inline(always)]
            || self.check_free_ports_all(w, length, steps, solved, trial),
        )
    }

    /// Computes the free motion to the end of a step, and updates the ports in flight.
    #[inline(always)]
    pub(super) fn move_freely<W: Simd>(
        &mut self,
        w: W,
        steps: &[ContactStep],
        trial: &mut TrialState,
    ) {
        steps[0].table.flow.apply(w, &self.y, &mut trial.y);
        for p in 0..self.kernel.plant.ports.len() {
            if self.ports[p].contact_state == ContactState::Flight {
                self.update_free_port(w, p);
            }
        }
    }

    #[inline(always)]
    fn check_free_ports_all<W: Simd>(
        &mut self,
        w: W,
        length: StepLength,
        steps: &[ContactStep],
        solved: &[SolvedStep],
        trial: &mut TrialState,
    ) -> StepOutcome {
        self.move_freely(w, steps, trial);
        let forces: SmallList<F64x8> = solved
            .iter()
            .map(|solution| nodal(&solution.force))
            .collect();
        let mut outcome = StepOutcome::Clear;
        for p in 0..self.kernel.plant.ports.len() {
            if self.ports[p].contact_state == ContactState::Flight {
                outcome.add(
                    p,
                    self.check_free_port(w, length, (steps, &forces), p, &trial.y),
                );
            }
        }
        outcome
    }

    /// Returns the verdict on one port.
    #[inline(always)]
    fn check_free_port<W: Simd>(
        &self,
        w: W,
        length: StepLength,
        (steps, forces): (&[ContactStep], &[F64x8]),
        p: usize,
        free_end: &[F64x8],
    ) -> FlightVerdict {
        let flight = |step: &ContactStep| {
            length
                .tables
                .forced_flight(self.kernel, (step.port, step.shape), p)
        };
        let flights: SmallList<_> = steps.iter().map(flight).collect();
        let mut forced = w.zero();
        for (flight, force) in flights.iter().zip(forces) {
            forced = add_force_response(w, forced, &flight.ends, force);
        }
        let forced = w.store(forced).0;
        let [rest_m, rest_m_s] = rest_bounds(w, &flights, forces);
        let drive = self.drive_at_end(p, steps[0].port, length);
        let PortState { rows, gap_m, .. } = &self.ports[p];
        let free = [
            dot(w, &rows.displacement, free_end) + drive[0] - gap_m,
            dot(w, &rows.velocity, free_end) + drive[1],
        ];
        let start = self.without_decays(&flights, forces);
        let mut step = self.step_from(
            w,
            (p, &start),
            length.level,
            length.seconds(),
            (free_end, free, drive),
        );
        step.distance_m[0] += forced[3];
        step.distance_m[1] += forced[0];
        step.speed_m_s[0] += forced[2];
        step.speed_m_s[1] += forced[1];
        step.fast_m -= forced[3];
        step.fast_bound_m += rest_m;
        step.fast_bound_m_s += rest_m_s;
        let end_m = free[0] + forced[0];
        // A point that touches and is pushed in has its impact now: in contact the law decides.
        let touches = end_m > 0.0
            && self.ports[p].penetration_m.abs() <= self.touch_m(p)
            && !self.is_rigid(p)
            && !self.is_guard(p);
        let now = Crossing {
            from_s: 0.0,
            guess_s: 0.0,
            to_s: step.length_s,
        };
        let forced_m = || self.forced_terms_m(w, steps, forces, p);
        match self.judge_with_others(w, p, &step, end_m, forced_m) {
            FlightVerdict::Clear => FlightVerdict::Clear,
            _ if touches => FlightVerdict::Strike(now),
            verdict => verdict,
        }
    }

    /// Returns the sum of the magnitudes of the terms of the displacement of a port by the forces of
    /// a step, m. They nearly cancel on a short step, where the displacement is of second order.
    fn forced_terms_m<W: Simd>(
        &self,
        w: W,
        steps: &[ContactStep],
        forces: &[F64x8],
        p: usize,
    ) -> f64 {
        let mut forced = TrialState::new(self.kernel);
        for (step, force) in steps.iter().zip(forces) {
            self.push_on(w, step, force, &mut forced);
        }
        dot_of_magnitudes(w, &self.ports[p].rows.displacement, &forced.y)
    }

    /// Returns the state without the values from which fast decays follow the forces: the remainder
    /// decays.
    fn without_decays(&self, flights: &[&ForcedFlight], forces: &[F64x8]) -> Cow<'_, [F64x8]> {
        let mut state = Cow::from(&self.y);
        for (flight, force) in flights.iter().zip(forces) {
            for decay in &flight.decays {
                let (lane, index) = self.layout.locate(decay.state);
                let terms = decay.start.0.iter().zip(&force.0);
                state.to_mut()[lane].0[index] -=
                    terms.map(|(start, force)| start * force).sum::<f64>();
            }
        }
        state
    }

    /// Returns the motion of a port in flight at the end of a solved step: distance past the stop,
    /// m, and its rate, m/s.
    #[inline(always)]
    pub(super) fn motion_at_end<W: Simd>(
        &self,
        w: W,
        joint: &JointStep,
        solved: &[SolvedStep],
        p: usize,
        trial: &mut TrialState,
    ) -> [f64; 2] {
        let table = joint.steps[0].table;
        table.flow.apply(w, &self.y, &mut trial.y);
        for (step, solution) in joint.steps.iter().zip(solved) {
            self.push_on(w, step, &nodal(&solution.force), trial);
        }
        let drive = self.drive_at_end(p, joint.steps[0].port, joint.tables.length);
        let PortState { rows, gap_m, .. } = &self.ports[p];
        let immediate: f64 = joint
            .steps
            .iter()
            .zip(solved)
            .map(|(step, solution)| self.kernel.direct_gain(step.port, p) * solution.force.0[NODES])
            .sum();
        [
            dot(w, &rows.displacement, &trial.y) + drive[0] - gap_m,
            dot(w, &rows.velocity, &trial.y) + drive[1] + immediate,
        ]
    }

    /// Returns displacement and velocity of a port under the drive at the end of a step of another
    /// one in contact.
    #[inline(always)]
    fn drive_at_end(&self, p: usize, in_contact: usize, length: StepLength) -> [f64; 2] {
        let mut drive = self.excitation.motion_after(p, length.seconds());
        for tone in &self.tones {
            let [displacement, speed] = tone.motion_after(p, tone.samples[in_contact].end());
            drive = [drive[0] + displacement, drive[1] + speed];
        }
        drive
    }
}
