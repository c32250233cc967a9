//! Flight: exact flow in certified steps, until the stop is struck or the end is reached.

use super::certificate::FlightStep;
use super::kernel::Kernel;
use super::lane::WIDTH;
use super::marcher::{MarchError, Marcher, Regime};
use super::state::{columns, dot_abs, flow};
use super::table::Table;

/// Certificate uncertainty, relative to the motion, below which a crossing counts as located: a contact that could hide in a
/// step is then shallower than this fraction of the motion.
const LOCATED: f64 = 1e-12;

/// What became of one attempted step.
enum Attempt {
    Clear,
    Strike(f64),
    Unclear { crossing_s: Option<f64> },
}

impl Marcher<'_> {
    /// Flies until contact or until the end.
    #[inline(always)]
    pub(super) fn flight<const FMA: bool>(&mut self, end_s: f64) -> Result<(), MarchError> {
        // Levels to go up after a success: two while nothing has failed in this flight.
        let mut grow = 2;
        while self.time_s < end_s {
            let remaining = end_s - self.time_s;
            let mut level = self.flight_level;
            if Kernel::length_s(level) >= remaining {
                level = Kernel::level_within(remaining);
                if self.land::<FMA>(level, remaining, end_s) {
                    return Ok(());
                }
            }
            match self.attempt::<FMA>(level) {
                Attempt::Clear => {
                    self.work.flight_steps += 1;
                    self.flight_level = (level - grow).max(Kernel::coarsest());
                }
                Attempt::Strike(after_s) => return self.strike::<FMA>(after_s),
                Attempt::Unclear { crossing_s } => {
                    self.work.flight_rejections += 1;
                    grow = 0;
                    // Short of the crossing that the cubic foretells, a step may well be clear.
                    let short = crossing_s.map_or(level, |crossing_s| Kernel::level_within(0.95 * crossing_s));
                    self.flight_level = short.max(level + 1).min(Kernel::finest());
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
    fn attempt<const FMA: bool>(&mut self, level: i32) -> Attempt {
        let kernel = self.kernel;
        let table = kernel.table(0, level);
        flow::<FMA>(&self.layout, &self.y, table, &mut self.next);
        let start = self.drive();
        let mut end = (0.0, 0.0);
        for tone in &mut self.tones {
            let (cos, sin) = tone.level(level);
            let (w, v) = tone.motion_after(cos.0[WIDTH - 1], sin.0[WIDTH - 1]);
            end = (end.0 + w, end.1 + v);
        }
        let outputs = columns::<FMA>(&self.layout, &self.next, &table.flight.columns).0;
        let step = self.step_of::<FMA>(table, start, [outputs[2], outputs[3]], end);
        let clear = step.highest_m() < 0.0;
        let located = !clear && step.uncertainty_m() <= LOCATED * self.scale_m(outputs[0]);
        if !clear {
            if !located {
                return Attempt::Unclear { crossing_s: step.crossing_s() };
            }
            if let Some(after_s) = step.crossing_s() {
                return Attempt::Strike(after_s);
            }
            // Shallower than the resolution: nothing the force law could feel.
        }
        if self.record.is_some() {
            self.note(table.length_s, None);
        }
        std::mem::swap(&mut self.y, &mut self.next);
        self.time_s += table.length_s;
        for tone in &mut self.tones {
            let (cos, sin) = tone.level(level);
            tone.turn *= faer::c64::new(cos.0[WIDTH - 1], sin.0[WIDTH - 1]);
        }
        self.penetration_m = outputs[0] + end.0 - self.rows.gap_m;
        self.rate_m_s = outputs[1] + end.1;
        Attempt::Clear
    }

    /// The certificate's view of a step whose end gives `slow` and `drive` (displacement, velocity).
    #[inline(always)]
    fn step_of<const FMA: bool>(&self, table: &Table, start_drive: (f64, f64), slow: [f64; 2], drive: (f64, f64)) -> FlightStep {
        let flight = &table.flight;
        let (mut distance, mut speed) = (self.penetration_m, self.rate_m_s);
        let mut fast_bound_m = 0.0;
        if flight.has_fast {
            let outputs = columns::<FMA>(&self.layout, &self.y, &flight.columns).0;
            distance = outputs[2] + start_drive.0 - self.rows.gap_m;
            speed = outputs[3] + start_drive.1;
            fast_bound_m = dot_abs::<FMA>(&flight.fast_bound, &self.y);
        }
        FlightStep {
            length_s: table.length_s,
            distance_m: [distance, slow[0] + drive.0 - self.rows.gap_m],
            speed_m_s: [speed, slow[1] + drive.1],
            fourth_bound: dot_abs::<FMA>(&flight.slow_fourth, &self.y) + self.rows.tone_fourth,
            fast_bound_m,
        }
    }

    /// Size of the motion against which the certificate's uncertainty is held.
    fn scale_m(&self, displacement_m: f64) -> f64 {
        let gap = if self.rows.gap_m.is_finite() { self.rows.gap_m.abs() } else { 0.0 };
        gap.max(displacement_m.abs()).max(self.rows.tone_scale_m)
    }

    /// Tries to glide to the end in one certified step shorter than a level.
    fn land<const FMA: bool>(&mut self, level: i32, remaining: f64, end_s: f64) -> bool {
        if self.kernel.plant.ports.is_empty() {
            self.glide(remaining, end_s);
            self.see::<FMA>();
            return true;
        }
        // The level above the remaining time bounds it from above; its table splits slow and fast for the whole step.
        let table = self.kernel.table(0, (level - 1).max(Kernel::coarsest()));
        let start = self.drive();
        let ahead = self.flown(remaining);
        let turns: Vec<_> = self.tones.iter().map(|tone| tone.turn).collect();
        self.tones.iter_mut().for_each(|tone| tone.set(end_s));
        let drive = self.drive();
        let outputs = columns::<FMA>(&self.layout, &ahead, &table.flight.columns).0;
        let mut step = self.step_of::<FMA>(table, start, [outputs[2], outputs[3]], drive);
        step.length_s = remaining;
        let located = || step.uncertainty_m() <= LOCATED * self.scale_m(outputs[0]) && step.crossing_s().is_none();
        let clear = step.highest_m() < 0.0 || located();
        self.tones.iter_mut().zip(turns).for_each(|(tone, turn)| tone.turn = turn);
        if clear {
            self.glide(remaining, end_s);
            self.see::<FMA>();
            self.work.flight_steps += 1;
        }
        clear
    }

    /// Displacement and velocity of the port under the drive at the present time.
    #[inline(always)]
    fn drive(&self) -> (f64, f64) {
        self.tones.iter().map(|tone| tone.motion()).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
    }

    /// Moves onto the stop and enters contact.
    fn strike<const FMA: bool>(&mut self, after_s: f64) -> Result<(), MarchError> {
        self.glide(after_s, self.time_s + after_s);
        self.see::<FMA>();
        // The Hermite crossing is exact to roundoff of the motion; one Newton step removes what is left of the distance.
        let nudge_s = -self.penetration_m / self.rate_m_s;
        if nudge_s.abs() < after_s {
            self.glide(nudge_s, self.time_s + nudge_s);
            self.see::<FMA>();
        }
        self.penetration_m = 0.0;
        self.strike_m_s = self.strike_m_s.max(self.rate_m_s);
        self.statistics.contacts += 1;
        self.regime = Regime::Contact;
        Ok(())
    }
}
