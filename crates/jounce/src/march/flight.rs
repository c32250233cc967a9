//! Flight: exact flow in certified steps, until the stop is struck or the end is reached.

use super::certificate::FlightStep;
use super::kernel::Kernel;
use super::marcher::{MarchError, Marcher, Regime};
use super::state::{columns, dot_abs, flow};
use super::table::Table;

/// Certificate uncertainty, relative to the motion, below which a crossing counts as located: a contact that could hide in a
/// step is then shallower than this fraction of the motion.
const LOCATED: f64 = 1e-14;

/// What became of one attempted step.
enum Attempt {
    Clear,
    Strike(f64),
    Unclear,
}

impl Marcher<'_> {
    /// Flies until contact or until the end.
    #[inline(always)]
    pub(super) fn flight<const FMA: bool>(&mut self, end_s: f64) -> Result<(), MarchError> {
        let mut grow = true;
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
                    self.flight_level = if grow { (level - 1).max(Kernel::coarsest()) } else { level };
                }
                Attempt::Strike(after_s) => return self.strike::<FMA>(after_s),
                Attempt::Unclear => {
                    self.work.flight_rejections += 1;
                    grow = false;
                    self.flight_level = level + 1;
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
        let mut turned = [(0.0, 0.0); 1];
        let (mut drive_m, mut drive_m_s) = (0.0, 0.0);
        let mut start = (0.0, 0.0);
        for tone in &mut self.tones {
            let (w, v) = tone.motion();
            start = (start.0 + w, start.1 + v);
            let (cos, sin) = tone.level(level);
            let before = tone.turn;
            tone.turn *= faer::c64::new(cos.0[7], sin.0[7]);
            let (w, v) = tone.motion();
            (drive_m, drive_m_s) = (drive_m + w, drive_m_s + v);
            tone.turn = before;
        }
        turned[0] = (drive_m, drive_m_s);
        let outputs = columns::<FMA>(&self.layout, &self.next, &table.flight.columns).0;
        let step = self.step_of::<FMA>(table, start, [outputs[2], outputs[3]], turned[0]);
        let clear = step.highest_m() < 0.0;
        let located = !clear && step.uncertainty_m() <= LOCATED * self.scale_m(outputs[0]);
        if !clear {
            if !located {
                return Attempt::Unclear;
            }
            if let Some(after_s) = step.crossing_s() {
                return Attempt::Strike(after_s);
            }
            // Shallower than the resolution: nothing the force law could feel.
        }
        std::mem::swap(&mut self.y, &mut self.next);
        self.time_s += table.length_s;
        for tone in &mut self.tones {
            let (cos, sin) = tone.level(level);
            tone.turn *= faer::c64::new(cos.0[7], sin.0[7]);
        }
        self.penetration_m = outputs[0] + turned[0].0 - self.rows.gap_m;
        self.rate_m_s = outputs[1] + turned[0].1;
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
        let saved = (self.y.clone(), self.time_s, self.penetration_m, self.rate_m_s);
        let start_drive = self.tones.iter().map(|t| t.motion()).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
        let before = self.clone_start();
        self.glide(remaining, end_s);
        let outputs = columns::<FMA>(&self.layout, &self.y, &table.flight.columns).0;
        let drive = self.tones.iter().map(|t| t.motion()).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
        std::mem::swap(&mut self.y, &mut self.next);
        self.y.copy_from_slice(&saved.0);
        (self.time_s, self.penetration_m, self.rate_m_s) = (saved.1, saved.2, saved.3);
        let mut step = self.step_of::<FMA>(table, start_drive, [outputs[2], outputs[3]], drive);
        step.length_s = remaining;
        let clear = step.highest_m() < 0.0 || step.uncertainty_m() <= LOCATED * self.scale_m(outputs[0]) && step.crossing_s().is_none();
        if clear {
            std::mem::swap(&mut self.y, &mut self.next);
            self.time_s = end_s;
            self.see::<FMA>();
        } else {
            self.tones.iter_mut().zip(before).for_each(|(tone, turn)| tone.turn = turn);
        }
        clear
    }

    fn clone_start(&self) -> Vec<faer::c64> {
        self.tones.iter().map(|tone| tone.turn).collect()
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
