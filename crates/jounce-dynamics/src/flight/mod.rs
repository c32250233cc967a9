//! Flight of all ports: exact flow in certified steps, until one of them hits its stop or the end is
//! reached.
//!
//! There is one certificate per port. A step is accepted when it is clear for all ports; the port
//! with the first proved crossing has the impact. A plant without stops has nothing to prove: its
//! steps are as long as they can be.

pub(crate) mod certificate;
pub(crate) mod crossing;
mod first_crossing;
pub(crate) mod forced;
pub(crate) mod table;
pub(crate) mod verdict;

use crate::error::IntegrationError;
use crate::flow::state::{dot, dot_abs};
use crate::integrator::{Integrator, TrialState};
use crate::kernel::Kernel;
use crate::ports::phasor::Phasor;
use crate::ports::state::{ContactState, PortState};
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use certificate::FlightStep;
use jounce_simd::{F64x8, Simd};
use verdict::StepOutcome;

/// Trial step of a flight.
#[derive(Clone, Copy)]
struct TrialFlight {
    /// Level whose tables hold for the step: its own, or the shortest one that bounds it from above.
    level: i32,
    length_s: f64,
    /// True where the step ends at the end of the flight, and not after a level.
    landing: bool,
}

impl Integrator<'_> {
    /// Integrates the flight of all ports until one of them has an impact or until the end.
    #[inline(always)]
    pub(crate) fn fly<W: Simd>(
        &mut self,
        w: W,
        end_s: f64,
        trial: &mut TrialState,
    ) -> Result<(), IntegrationError> {
        // The loops over the ports vanish where one port is compiled on its own.
        match self.kernel.plant.ports.len() {
            1 => w.out_of_line(
                #[inline(always)]
                || self.fly_ports(w, 1, end_s, trial),
            ),
            ports => w.out_of_line(
                #[inline(always)]
                || self.fly_ports(w, ports, end_s, trial),
            ),
        }
    }

    #[inline(always)]
    fn fly_ports<W: Simd>(
        &mut self,
        w: W,
        ports: usize,
        end_s: f64,
        trial: &mut TrialState,
    ) -> Result<(), IntegrationError> {
        let (mut grow, begun_s) = (LEVELS_PER_OCTAVE, self.time_s);
        while self.time_s < end_s {
            let level = self.flight_level;
            let remaining_s = self.excitation.remaining_s(self.time_s, end_s);
            let landing = Kernel::length_s(level) >= remaining_s;
            let step = if landing {
                TrialFlight {
                    level: level.max(Kernel::level_within(remaining_s) - 1),
                    length_s: remaining_s,
                    landing,
                }
            } else {
                TrialFlight {
                    level,
                    length_s: Kernel::length_s(level),
                    landing,
                }
            };
            match self.attempt(w, ports, step, trial) {
                StepOutcome::Clear => {
                    self.accept_flight(w, ports, step, end_s, trial);
                    let longer = (level - grow).max(Kernel::coarsest());
                    // If this flight lasts as long as the previous one, a step much longer than the
                    // remaining time would be rejected.
                    let to_end_s = begun_s + self.flight_s - self.time_s;
                    let reaches_far = to_end_s > 0.0 && Kernel::length_s(longer) > 2.0 * to_end_s;
                    self.flight_level = if reaches_far { level } else { longer };
                    grow = LEVELS_PER_OCTAVE;
                }
                StepOutcome::Strikes(strikes) => {
                    self.advance_to_first_crossing(w, &strikes, trial);
                    self.flight_s = self.time_s - begun_s;
                    return Ok(());
                }
                StepOutcome::Unclear(down) => {
                    self.work.flight_rejections += 1;
                    // The step after the next would fail as this one did.
                    grow = 0;
                    self.flight_level = (step.level + down).min(Kernel::finest());
                    if (0..ports).any(|p| !self.ports[p].penetration_m.is_finite()) {
                        return Err(IntegrationError::NotFinite {
                            time_s: self.time_s,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    /// Evaluates a step: the state at its end, and the motion of each port there.
    #[inline(always)]
    fn attempt<W: Simd>(
        &mut self,
        w: W,
        ports: usize,
        step: TrialFlight,
        trial: &mut TrialState,
    ) -> StepOutcome {
        let TrialFlight {
            level,
            length_s,
            landing,
        } = step;
        if landing {
            self.propagate_to(w, length_s, trial);
        } else {
            let flow = self.kernel.tables(level).flow(self.kernel);
            flow.apply(w, &self.y, &mut trial.y);
        }
        let mut outcome = StepOutcome::Clear;
        for p in 0..ports {
            if self.stays_clear(w, p, length_s, None) {
                continue;
            }
            self.update_free_port(w, p);
            let (drive, motion) = if landing {
                (
                    self.drive_after(p, length_s),
                    self.motion_after(w, p, length_s, trial),
                )
            } else {
                let drive = self.drive_after_level(p, level);
                let PortState { rows, gap_m, .. } = &self.ports[p];
                let motion = [
                    dot(w, &rows.displacement, &trial.y) + drive[0] - gap_m,
                    dot(w, &rows.velocity, &trial.y) + drive[1],
                ];
                (drive, motion)
            };
            trial.motion[p] = motion;
            let ends = (trial.y.as_slice(), motion, drive);
            let flight = self.step_from(w, (p, &self.y), level, length_s, ends);
            let verdict = self.judge_with_others(w, p, &flight, motion[0], || 0.0);
            outcome.add(p, verdict);
        }
        outcome
    }

    /// Advances to the end of a clear step.
    #[inline(always)]
    fn accept_flight<W: Simd>(
        &mut self,
        w: W,
        ports: usize,
        step: TrialFlight,
        end_s: f64,
        trial: &mut TrialState,
    ) {
        if step.landing {
            self.advance_state(w, step.length_s, end_s, trial);
        } else {
            self.note(step.length_s, &[]);
            for tone in &mut self.tones {
                let turn = tone.end(step.level);
                tone.turn *= turn;
            }
            self.enter_trial(w, step.length_s, self.time_s + step.length_s, trial);
        }
        for p in 0..ports {
            let port = &mut self.ports[p];
            if !port.clearance.is_unseen {
                [port.penetration_m, port.rate_m_s] = trial.motion[p];
            }
        }
        self.work.flight_steps += 1;
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

    /// Returns the certificate data of a step from a given start state, which may differ from the
    /// current one in its fast decays, to a given end: the state there, the motion of the port, and
    /// its part by the drive.
    #[inline(always)]
    pub(super) fn step_from<W: Simd>(
        &self,
        w: W,
        (p, start): (usize, &[F64x8]),
        level: i32,
        length_s: f64,
        (end, motion, drive): (&[F64x8], [f64; 2], [f64; 2]),
    ) -> FlightStep {
        let (flight, port) = (
            self.kernel.tables(level).flight(self.kernel, p),
            &self.ports[p],
        );
        let mut step = FlightStep {
            length_s,
            distance_m: [port.penetration_m, motion[0]],
            speed_m_s: [port.rate_m_s, motion[1]],
            fourth_bound: dot_abs(w, &flight.slow_fourth, start)
                + port.rows.tone_fourth
                + self.excitation.fourth_bound(p, length_s),
            fast_m: 0.0,
            fast_bound_m: 0.0,
            fast_bound_m_s: 0.0,
        };
        if let Some(fast) = &flight.fast {
            let [displacement, speed] = self.drive(p);
            let slow = dot(w, &fast.slow_displacement, start) + displacement - port.gap_m;
            step.distance_m = [
                slow,
                dot(w, &fast.slow_displacement, end) + drive[0] - port.gap_m,
            ];
            step.speed_m_s = [
                dot(w, &fast.slow_velocity, start) + speed,
                dot(w, &fast.slow_velocity, end) + drive[1],
            ];
            step.fast_m = port.penetration_m - slow;
            step.fast_bound_m = dot_abs(w, &fast.displacement_bound, start);
            step.fast_bound_m_s = dot_abs(w, &fast.velocity_bound, start);
        }
        step
    }

    /// Returns displacement and velocity of a port under the drive at the current time.
    #[inline(always)]
    fn drive(&self, p: usize) -> [f64; 2] {
        self.tones
            .iter()
            .map(|tone| tone.motion(p))
            .fold(self.excitation.motion_after(p, 0.0), |a, b| {
                [a[0] + b[0], a[1] + b[1]]
            })
    }

    /// Returns displacement and velocity of a port under the drive after a time.
    #[inline(always)]
    pub(super) fn drive_after(&self, p: usize, time_s: f64) -> [f64; 2] {
        let motion = |tone: &Phasor| {
            tone.motion_after(
                p,
                jounce_linalg::c64::cis(tone.angular_frequency_rad_s * time_s),
            )
        };
        self.tones
            .iter()
            .map(motion)
            .fold(self.excitation.motion_after(p, time_s), |a, b| {
                [a[0] + b[0], a[1] + b[1]]
            })
    }

    /// Puts a port into contact at the current time.
    #[inline(always)]
    pub(super) fn enter_contact(&mut self, p: usize) {
        let port = &mut self.ports[p];
        (port.penetration_m, port.contact_duration_s) = (0.0, 0.0);
        port.impact_velocity_m_s = port.impact_velocity_m_s.max(port.rate_m_s);
        port.statistics.contacts += 1;
        port.statistics.strike_sum_m_s += port.rate_m_s;
        port.statistics.max_impact_velocity_m_s =
            port.statistics.max_impact_velocity_m_s.max(port.rate_m_s);
        port.contact_state = ContactState::Contact;
    }
}
