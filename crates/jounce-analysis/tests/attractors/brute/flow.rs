//! Flow over drive cycles: steps of controlled error from event to event, and changes of contacts
//! at events.

use super::dormand_prince::{Stepped, step};
use super::events::{End, Event, LEAST_STEP};
use super::guard::Guard;
use super::law::{Law, Phase};
use super::model::{Phases, ReferenceModel};
use super::record::Record;

/// Marks the absence of a stop.
pub const NONE: usize = usize::MAX;

/// Rebound speed, in units of the size of the motion, below which bounces that end within
/// [`CHATTER_CYCLES`] are skipped. Skipping moves the point by the speed times that time, below
/// 1e-9 of the size of the motion.
const CHATTER_SPEED: f64 = 1e-6;

/// Longest duration of skipped bounces, drive cycles.
const CHATTER_CYCLES: f64 = 1e-3;

/// Number of events in a cycle above which a contact chatters by roundoff; bounces of restitution
/// 0.95 end within 300.
const MOST_EVENTS: usize = 20_000;

/// State of an integration. Time runs from zero in each drive cycle.
#[derive(Debug, Clone)]
pub struct Motion<const D: usize> {
    pub state: [f64; D],
    pub phases: Phases,
    pub size: f64,
    /// True when the last cycle had more than [`MOST_EVENTS`] events and the integration was ended.
    pub is_lost: bool,
    /// Contacts and energies since the start; `None` where they are not recorded.
    pub record: Option<Record>,
    length: f64,
}

/// Error of a step on random harvesters, relative to the size of the motion. Where a force grows with
/// the 1.2th power of the penetration, a cycle can add up to 2e4 of it.
pub const STEP_TOLERANCE: f64 = 2e-14;

/// Flow of a model with an error per step relative to the size of the motion.
#[derive(Debug, Clone, Copy)]
pub struct Flow<'m, const N: usize, const D: usize> {
    pub model: &'m ReferenceModel<N, D>,
    pub tolerance: f64,
    /// True where steps by Taylor series are taken; otherwise every step is one of Dormand and Prince.
    pub has_series: bool,
}

/// Progress within a drive cycle: time, largest norm of the state, and number of events.
struct Progress {
    t: f64,
    largest: f64,
    events: usize,
}

impl<const N: usize, const D: usize> Flow<'_, N, D> {
    /// Starts from a state at the start of a drive cycle.
    pub fn start(&self, state: [f64; D]) -> Motion<D> {
        let model = self.model;
        let phases = model.phases(&state);
        let size = model.weights.square(&state).sqrt().max(model.least_size());
        let mut motion = Motion {
            state,
            phases,
            size,
            is_lost: false,
            record: None,
            length: model.cycle_s / 64.0,
        };
        for p in 0..model.stops.len() {
            let [d, rate] = model.depth(&model.stops[p], &motion.state);
            if matches!(model.stops[p].law, Law::Rigid { .. }) && d >= 0.0 && rate >= 0.0 {
                self.impact(&mut motion, p, 0.0);
            }
        }
        motion
    }

    /// Advances by a drive cycle.
    pub fn cycle(&self, motion: &mut Motion<D>) {
        let end = self.model.cycle_s;
        let mut progress = Progress {
            t: 0.0,
            largest: 0.0,
            events: 0,
        };
        while progress.t < end && !motion.is_lost {
            if !self.has_series || !self.advance_by_series(motion, &mut progress) {
                self.advance_by_runge_kutta(motion, &mut progress);
            }
            let size = self.model.weights.square(&motion.state).sqrt();
            progress.largest = progress.largest.max(size);
            motion.size = motion.size.max(progress.largest);
        }
        motion.size = progress.largest.max(self.model.least_size());
        if let Some(record) = &mut motion.record {
            record.start_s += end;
        }
    }

    /// Takes a step by Taylor series; false where this method does not apply.
    fn advance_by_series(&self, motion: &mut Motion<D>, progress: &mut Progress) -> bool {
        let remaining = self.model.cycle_s - progress.t;
        let Some(step) = self.taylor_step(motion, progress.t, remaining) else {
            return false;
        };
        progress.t = if step.duration >= remaining {
            self.model.cycle_s
        } else {
            progress.t + step.duration
        };
        motion.state = step.state;
        if let (Some(record), Some(work)) = (&mut motion.record, step.work) {
            record.work = record.work.plus(&work, 1.0);
        }
        progress.largest = progress.largest.max(step.middle.sqrt());
        if let Some(guard) = step.event {
            self.pass(motion, guard, progress);
        }
        true
    }

    /// Tries a step of Dormand and Prince, and takes it if its error is small enough.
    fn advance_by_runge_kutta(&self, motion: &mut Motion<D>, progress: &mut Progress) {
        let (model, end, t) = (self.model, self.model.cycle_s, progress.t);
        let rate = model.rate(t, &motion.state, &motion.phases, NONE);
        let remaining = end - t;
        let is_last = motion.length >= remaining;
        let h = motion.length.min(remaining);
        let Stepped { state, error } = self.step(motion, t, h, &rate);
        // Steps grow slowly, so they remain as short as the contacts before and after them need.
        let next = if error.is_finite() {
            h * (0.9 * error.max(1e-12).powf(-0.125)).clamp(0.2, 4.0)
        } else {
            0.2 * h
        };
        // Not a number where a stage diverged because the step was much too long.
        if (error.is_nan() || error > 1.0) && h > LEAST_STEP * end {
            motion.length = next;
            return;
        }
        let complete = End {
            part: 1.0,
            state,
            rate: model.rate(t + h, &state, &motion.phases, NONE),
        };
        match self.event(motion, (t, h), &rate, complete) {
            Event::Unclear => motion.length = 0.5 * h,
            Event::None(complete) => {
                self.add_work(motion, (t, h), &rate);
                progress.t = if is_last { end } else { t + h };
                motion.state = complete.state;
                motion.length = if is_last {
                    motion.length.max(next)
                } else {
                    next
                };
            }
            Event::At(guard, there) => {
                self.add_work(motion, (t, there.part * h), &rate);
                progress.t += there.part * h;
                motion.state = there.state;
                self.pass(motion, guard, progress);
            }
        }
    }

    /// Passes an event at the present state.
    fn pass(&self, motion: &mut Motion<D>, guard: Guard, progress: &mut Progress) {
        progress.events += 1;
        motion.is_lost = progress.events > MOST_EVENTS;
        self.change(motion, guard, progress.t);
    }

    /// Takes a step of length `h` in the current phases; the error is relative to the tolerance.
    pub fn step(&self, motion: &Motion<D>, t: f64, h: f64, rate: &[f64; D]) -> Stepped<D> {
        let right = |t: f64, y: &[f64; D]| self.model.rate(t, y, &motion.phases, NONE);
        let mut next_step = step(right, (t, h), (&motion.state, rate), &self.model.weights);
        next_step.error /= self.tolerance * motion.size;
        next_step
    }

    /// Changes the phase of a contact when its event function vanishes.
    fn change(&self, motion: &mut Motion<D>, guard: Guard, t: f64) {
        let (Guard::Surface(p) | Guard::Push(p) | Guard::Hold(p)) = guard;
        let is_rigid = matches!(self.model.stops[p].law, Law::Rigid { .. });
        self.note_passage(motion, guard, t);
        self.note_push(motion, guard);
        motion.phases[p] = match (guard, motion.phases[p]) {
            (Guard::Surface(_), Phase::Free) if is_rigid => return self.impact(motion, p, t),
            (Guard::Surface(_), Phase::Free) | (Guard::Push(_), Phase::Slack) => Phase::Pushing,
            (Guard::Push(_), _) => Phase::Slack,
            (Guard::Surface(_) | Guard::Hold(_), _) => Phase::Free,
        };
    }

    /// Updates the damped stops that yield after an impact on another stop, which changes their speeds.
    fn push_after_impact(&self, motion: &mut Motion<D>, rigid: usize) {
        for (p, stop) in self.model.stops.iter().enumerate() {
            let phase = motion.phases[p];
            if p == rigid || !matches!(phase, Phase::Pushing | Phase::Slack) {
                continue;
            }
            let [d, rate] = self.model.depth(stop, &motion.state);
            let is_pushing = stop.law.push(d, rate) >= 0.0;
            if is_pushing != (phase == Phase::Pushing) {
                self.note_push(motion, Guard::Push(p));
                motion.phases[p] = if is_pushing {
                    Phase::Pushing
                } else {
                    Phase::Slack
                };
            }
        }
    }

    /// Applies an impact on a rigid stop; the point sticks where its acceleration ends the bounces
    /// soon.
    fn impact(&self, motion: &mut Motion<D>, p: usize, t: f64) {
        let stop = &self.model.stops[p];
        let Law::Rigid { e } = stop.law else { return };
        let [depth, before] = self.model.depth(stop, &motion.state);
        let pressed = self.model.depth(
            stop,
            &self.model.rate(t, &motion.state, &motion.phases, NONE),
        )[1];
        let after = e * before.max(0.0);
        let is_slow = after <= CHATTER_SPEED * stop.square.sqrt() * motion.size;
        let is_short = 2.0 * after <= CHATTER_CYCLES * self.model.cycle_s * pressed * (1.0 - e);
        // A bounce lower than the roundoff of its height has no end.
        let roundoff = self.model.roundoff(Guard::Surface(p), &motion.state);
        let is_unresolved = after * after <= 2.0 * pressed * roundoff;
        let rests = pressed > 0.0 && ((is_slow && is_short) || is_unresolved);
        let change = if rests { before } else { before + after };
        if let Some(record) = &mut motion.record {
            let kept = if rests { 0.0 } else { after };
            record.work.contact_j += 0.5 * (before * before - kept * kept) / stop.square;
            if before > 0.0 {
                record.begin(p, t, before);
            }
        }
        for i in 0..N {
            motion.state[i] -= depth * stop.shape[i] / stop.square;
            motion.state[N + i] -= change * stop.shape[i] / stop.square;
        }
        if rests {
            motion.phases[p] = Phase::Resting;
        }
        self.push_after_impact(motion, p);
    }
}
