//! Flight: exact flow in certified steps, until the stop is hit or the end is reached.

pub(crate) mod certificate;
pub(crate) mod crossing;
pub(crate) mod forced;
pub(crate) mod table;
pub(crate) mod verdict;

use crate::error::IntegrationError;
use crate::flow::state::{dot, dot_abs};
use crate::integrator::Integrator;
use crate::kernel::Kernel;
use crate::ports::phasor::Phasor;
use crate::ports::state::{ContactState, PortState};
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use certificate::FlightStep;
use crossing::Crossing;
use jounce_model::contact::Law;
use jounce_simd::{F64x8, Simd};
use verdict::FlightVerdict;

impl Integrator<'_> {
    /// Integrates the flight until contact or until the end.
    #[inline(always)]
    pub(super) fn flight<W: Simd>(&mut self, w: W, end_s: f64) -> Result<(), IntegrationError> {
        w.out_of_line(
            #[inline(always)]
            || self.fly_single_port(w, end_s),
        )
    }

    #[inline(always)]
    fn fly_single_port<W: Simd>(&mut self, w: W, end_s: f64) -> Result<(), IntegrationError> {
        if self.kernel.plant.ports.is_empty() {
            self.fly_without_ports(w, end_s);
            return Ok(());
        }
        let (mut grow, begun_s) = (LEVELS_PER_OCTAVE, self.time_s);
        while self.time_s < end_s {
            let level = self.flight_level;
            let length_s = Kernel::length_s(level);
            let remaining_s = self.excitation.remaining_s(self.time_s, end_s);
            let landing = length_s >= remaining_s;
            // For a step that ends early, the shortest level that bounds it from above.
            let tight = if landing {
                level.max(Kernel::level_within(remaining_s) - 1)
            } else {
                level
            };
            let verdict = if landing {
                self.land(w, tight, remaining_s, end_s)
            } else {
                self.attempt(w, level)
            };
            match verdict {
                FlightVerdict::Clear => {
                    self.work.flight_steps += 1;
                    let longer = (level - grow).max(Kernel::coarsest());
                    // If this flight lasts as long as the previous one, a step much longer than the
                    // remaining time would be rejected.
                    let to_end_s = begun_s + self.flight_s - self.time_s;
                    let reaches_far = to_end_s > 0.0 && Kernel::length_s(longer) > 2.0 * to_end_s;
                    self.flight_level = if reaches_far { level } else { longer };
                    grow = LEVELS_PER_OCTAVE;
                }
                FlightVerdict::Strike(crossing) => {
                    if self.strike(w, crossing, begun_s) {
                        return Ok(());
                    }
                }
                FlightVerdict::Unclear(down) => {
                    self.work.flight_rejections += 1;
                    // The step after the next would fail as this one did.
                    grow = 0;
                    self.flight_level = (tight + down).min(Kernel::finest());
                    if !self.ports[0].penetration_m.is_finite() {
                        return Err(IntegrationError::NotFinite {
                            time_s: self.time_s,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    /// Advances a plant without stops to the end, in one step.
    #[inline(always)]
    fn fly_without_ports<W: Simd>(&mut self, w: W, end_s: f64) {
        let length_s = self.excitation.remaining_s(self.time_s, end_s);
        self.propagate_to(w, length_s);
        self.advance_state(w, length_s, end_s);
        self.work.flight_steps += 1;
    }

    /// Ends the flight that began at a time where it reaches the stop; false where the point has
    /// left a rigid stop instead.
    #[inline(always)]
    fn strike<W: Simd>(&mut self, w: W, crossing: Crossing, begun_s: f64) -> bool {
        let (after_s, motion) = self.locate(w, 0, crossing);
        self.advance_state(w, after_s, self.time_s + after_s);
        self.set_motion(0, motion);
        // A point that is past a rigid stop by roundoff and moves out has left it, unless it is
        // pressed back first.
        if motion[1] < 0.0
            && matches!(self.kernel.plant.system.stops[0].law, Law::Rigid(_))
            && !self.is_suppressed_hop(0, motion)
        {
            return false;
        }
        self.flight_s = self.time_s - begun_s;
        self.enter_contact(0);
        true
    }

    /// Attempts one step of a level, which is accepted only if clear.
    #[inline(always)]
    fn attempt<W: Simd>(&mut self, w: W, level: i32) -> FlightVerdict {
        let kernel = self.kernel;
        kernel
            .tables(level)
            .flow(kernel)
            .apply(w, &self.y, &mut self.next);
        let mut drive = self.excitation.motion_after(0, Kernel::length_s(level));
        for tone in &mut self.tones {
            let turn = tone.end(level);
            let [displacement, speed] = tone.motion_after(0, turn);
            drive = [drive[0] + displacement, drive[1] + speed];
        }
        let PortState { rows, gap_m, .. } = &self.ports[0];
        let motion = [
            dot(w, &rows.displacement, &self.next) + drive[0] - gap_m,
            dot(w, &rows.velocity, &self.next) + drive[1],
        ];
        let step = self.step_of(w, 0, level, Kernel::length_s(level), motion, drive);
        let verdict = self.judge_flight(0, &step, motion[0]);
        if let FlightVerdict::Clear = verdict {
            let length_s = step.length_s;
            if self.record.is_some() {
                self.note(length_s, &[]);
            }
            std::mem::swap(&mut self.y, &mut self.next);
            self.time_s += length_s;
            for tone in &mut self.tones {
                let turn = tone.end(level);
                tone.turn *= turn;
            }
            self.excitation.pass(
                w,
                self.kernel,
                length_s,
                self.time_s,
                (&self.next, &mut self.y),
            );
            self.set_motion(0, motion);
        }
        verdict
    }

    /// Attempts a last step of any length, to the end.
    #[inline(always)]
    fn land<W: Simd>(&mut self, w: W, level: i32, length_s: f64, end_s: f64) -> FlightVerdict {
        self.propagate_to(w, length_s);
        let motion = self.motion_after(w, 0, length_s);
        // The level bounds the length from above: its split into slow and fast blocks is valid.
        let step = self.step_of(w, 0, level, length_s, motion, self.drive_after(0, length_s));
        let verdict = self.judge_flight(0, &step, motion[0]);
        if let FlightVerdict::Clear = verdict {
            self.advance_state(w, length_s, end_s);
            self.set_motion(0, motion);
        }
        verdict
    }

    /// Returns the certificate data of a step that ends in `next` with `motion` of a port there;
    /// `drive` is the contribution of the drives.
    #[inline(always)]
    pub(super) fn step_of<W: Simd>(
        &self,
        w: W,
        p: usize,
        level: i32,
        length_s: f64,
        motion: [f64; 2],
        drive: [f64; 2],
    ) -> FlightStep {
        self.step_from(w, (p, &self.y), level, length_s, motion, drive)
    }

    /// Returns the certificate data of a step from a given start state, which may differ from the
    /// current one in its fast decays.
    #[inline(always)]
    pub(super) fn step_from<W: Simd>(
        &self,
        w: W,
        (p, start): (usize, &[F64x8]),
        level: i32,
        length_s: f64,
        motion: [f64; 2],
        drive: [f64; 2],
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
                dot(w, &fast.slow_displacement, &self.next) + drive[0] - port.gap_m,
            ];
            step.speed_m_s = [
                dot(w, &fast.slow_velocity, start) + speed,
                dot(w, &fast.slow_velocity, &self.next) + drive[1],
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

    /// Returns the time until a port hits its stop, by Newton on the exact flow inside the proved
    /// interval, and its motion then; the state there is in `next`.
    #[inline(always)]
    pub(super) fn locate<W: Simd>(
        &mut self,
        w: W,
        p: usize,
        crossing: Crossing,
    ) -> (f64, [f64; 2]) {
        w.out_of_line(
            #[inline(always)]
            || self.locate_crossing(w, p, crossing),
        )
    }

    #[inline(always)]
    fn locate_crossing<W: Simd>(&mut self, w: W, p: usize, crossing: Crossing) -> (f64, [f64; 2]) {
        let Crossing {
            mut from_s,
            mut guess_s,
            mut to_s,
        } = crossing;
        self.propagate_to(w, guess_s);
        let mut motion = self.motion_after(w, p, guess_s);
        for _ in 0..20 {
            if motion[0] > 0.0 {
                to_s = guess_s
            } else {
                from_s = guess_s
            }
            let newton = guess_s - motion[0] / motion[1];
            let next = if newton >= from_s && newton <= to_s {
                newton
            } else {
                0.5 * (from_s + to_s)
            };
            let change = (next - guess_s).abs();
            self.propagate_from(w, guess_s, next);
            let before = motion;
            motion = self.motion_after(w, p, next);
            guess_s = next;
            // The error left by Newton is the change times half the relative change of the rate:
            // here roundoff, and `next` has been evaluated.
            let remaining_error = 0.5 * change * ((motion[1] - before[1]) / motion[1]).abs();
            if remaining_error <= 1e-15 * guess_s.min(1.0 / self.kernel.fastest_rad_s) {
                break;
            }
        }
        (guess_s, motion)
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
