//! Flight of all ports.

use crate::error::IntegrationError;
use crate::flight::certificate::FlightStep;
use crate::flight::crossing::Crossing;
use crate::flight::verdict::{FlightVerdict, RESOLVED_UNCERTAINTY, by_interpolant};
use crate::flow::state::{dot, dot_of_magnitudes};
use crate::integrator::Integrator;
use crate::kernel::Kernel;
use crate::ports::state::PortState;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_simd::Simd;

/// Outcome of a step for all ports.
pub enum StepOutcome {
    /// Free of contact.
    Clear,
    /// Each of these ports has a crossing, proved or assumed.
    Strikes(Vec<(usize, Crossing)>),
    /// Levels to decrease before the next attempt.
    Unclear(i32),
}

impl StepOutcome {
    /// Adds the verdict on one more port.
    pub fn and(self, p: usize, verdict: FlightVerdict) -> Self {
        match (self, verdict) {
            (StepOutcome::Unclear(a), FlightVerdict::Unclear(b)) => StepOutcome::Unclear(a.max(b)),
            (StepOutcome::Unclear(down), _) | (_, FlightVerdict::Unclear(down)) => {
                StepOutcome::Unclear(down)
            }
            (outcome, FlightVerdict::Clear) => outcome,
            (StepOutcome::Clear, FlightVerdict::Strike(crossing)) => {
                StepOutcome::Strikes(vec![(p, crossing)])
            }
            (StepOutcome::Strikes(mut strikes), FlightVerdict::Strike(crossing)) => {
                strikes.push((p, crossing));
                StepOutcome::Strikes(strikes)
            }
        }
    }
}

impl Integrator<'_> {
    /// Integrates the flight until a port has an impact or until the end.
    #[inline(always)]
    pub(super) fn fly<W: Simd>(&mut self, w: W, end_s: f64) -> Result<(), IntegrationError> {
        w.out_of_line(
            #[inline(always)]
            || self.fly_all_ports(w, end_s),
        )
    }

    #[inline(always)]
    fn fly_all_ports<W: Simd>(&mut self, w: W, end_s: f64) -> Result<(), IntegrationError> {
        let mut grow = LEVELS_PER_OCTAVE;
        while self.time_s < end_s {
            let (level, remaining_s) = (
                self.flight_level,
                self.excitation.remaining_s(self.time_s, end_s),
            );
            let landing = Kernel::length_s(level) >= remaining_s;
            let length_s = if landing {
                remaining_s
            } else {
                Kernel::length_s(level)
            };
            // For a step that ends early, the shortest level that bounds it from above.
            let tight = if landing {
                level.max(Kernel::level_within(remaining_s) - 1)
            } else {
                level
            };
            match self.attempt_all(w, tight, length_s, landing) {
                StepOutcome::Clear => {
                    let start_s = self.time_s;
                    self.advance_state(
                        w,
                        length_s,
                        if landing { end_s } else { start_s + length_s },
                    );
                    for port in self
                        .ports
                        .iter_mut()
                        .filter(|port| !port.clearance.is_unseen)
                    {
                        [port.penetration_m, port.rate_m_s] = port.motion_at_end;
                    }
                    self.work.flight_steps += 1;
                    self.flight_level = (level - grow).max(Kernel::coarsest());
                    grow = LEVELS_PER_OCTAVE;
                }
                StepOutcome::Strikes(strikes) => {
                    w.out_of_line(
                        #[inline(always)]
                        || self.advance_to_first_crossing(w, &strikes),
                    );
                    return Ok(());
                }
                StepOutcome::Unclear(down) => {
                    self.work.flight_rejections += 1;
                    // The step after the next would fail as this one did.
                    grow = 0;
                    self.flight_level = (tight + down).min(Kernel::finest());
                    if self
                        .ports
                        .iter()
                        .any(|port| !port.penetration_m.is_finite())
                    {
                        return Err(IntegrationError::NotFinite {
                            time_s: self.time_s,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    /// Evaluates a step: the state at its end is in `next`, the motion of each port there in
    /// `motion_at_end`.
    #[inline(always)]
    fn attempt_all<W: Simd>(
        &mut self,
        w: W,
        level: i32,
        length_s: f64,
        landing: bool,
    ) -> StepOutcome {
        if landing {
            self.propagate_to(w, length_s);
        } else {
            let flow = self.kernel.tables(level).flow(self.kernel);
            flow.apply(w, &self.y, &mut self.next);
        }
        let mut outcome = StepOutcome::Clear;
        for p in 0..self.kernel.plant.ports.len() {
            if self.stays_clear(w, p, length_s, None) {
                continue;
            }
            self.update_free_port(w, p);
            let drive = if landing {
                self.drive_after(p, length_s)
            } else {
                self.drive_after_level(p, level)
            };
            let PortState { rows, gap_m, .. } = &self.ports[p];
            let motion = [
                dot(w, &rows.displacement, &self.next) + drive[0] - gap_m,
                dot(w, &rows.velocity, &self.next) + drive[1],
            ];
            self.ports[p].motion_at_end = motion;
            let step = self.step_of(w, p, level, length_s, motion, drive);
            outcome = outcome.and(p, self.judge_with_others(w, p, &step, motion[0], 0.0));
        }
        outcome
    }

    /// Judges the flight of one port with other ports, whose forces move it by `forced_m`. Distances
    /// below the roundoff of its displacement cannot be resolved: two bodies that touch far from the
    /// origin have neither gap nor relative motion as a scale.
    #[inline(always)]
    pub(super) fn judge_with_others<W: Simd>(
        &self,
        w: W,
        p: usize,
        step: &FlightStep,
        displacement_m: f64,
        forced_m: f64,
    ) -> FlightVerdict {
        let roundoff_m = || RESOLVED_UNCERTAINTY * self.terms_m(w, p).max(forced_m);
        match self.judge_flight(p, step, displacement_m) {
            FlightVerdict::Unclear(_) if step.uncertainty_m() <= roundoff_m() => {
                by_interpolant(step, self.leaves_from_rest(p))
            }
            verdict => verdict,
        }
    }

    /// Returns the sum of the magnitudes of the terms of a displacement, m.
    #[inline(always)]
    pub(super) fn terms_m<W: Simd>(&self, w: W, p: usize) -> f64 {
        dot_of_magnitudes(w, &self.ports[p].rows.displacement, &self.y)
    }

    /// Returns displacement and velocity of a port under the drive after a level.
    #[inline(always)]
    fn drive_after_level(&mut self, p: usize, level: i32) -> [f64; 2] {
        let mut drive = self.excitation.motion_after(p, Kernel::length_s(level));
        for tone in &mut self.tones {
            let turn = tone.end(level);
            let [displacement, speed] = tone.motion_after(p, turn);
            drive = [drive[0] + displacement, drive[1] + speed];
        }
        drive
    }

    /// Advances to the first of several crossings.
    #[inline(always)]
    fn advance_to_first_crossing<W: Simd>(&mut self, w: W, strikes: &[(usize, Crossing)]) {
        let mut first = (0, f64::INFINITY);
        for (p, crossing) in strikes {
            let (after_s, _) = self.locate(w, *p, *crossing);
            if after_s < first.1 {
                first = (*p, after_s);
            }
        }
        let (p, after_s) = first;
        if strikes.len() > 1 {
            self.propagate_to(w, after_s);
        }
        self.advance_state(w, after_s, self.time_s + after_s);
        self.join(w, p);
    }
}
