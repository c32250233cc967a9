//! The flow over drive cycles: steps of controlled error between events, each event located by repeating its step with a part of its length.
//!
//! A step is taken only when no guard changes its sign in it. A guard that is positive at both ends and falls at first and rises at last
//! has a minimum between: where the cubic through values and rates comes near zero there, the minimum is found and its sign seen.

use super::dormand_prince::{Stepped, step};
use super::guard::Guard;
use super::law::{Law, Phase};
use super::model::{Model, Phases};

/// No stop's number.
const NONE: usize = usize::MAX;

/// Part of a cycle below which a step is not halved any more: an event that is this near has happened.
const LEAST_STEP: f64 = 1e-14;

/// Rebound speed in units of the size of the motion below which bounces that die away within [`CHATTER_CYCLES`] are left out. What is left
/// out moves the point by the speed times that time, below 1e-9 of the size of the motion.
const CHATTER_SPEED: f64 = 1e-6;

/// Longest time of bounces that are left out, drive cycles.
const CHATTER_CYCLES: f64 = 1e-3;

/// Rise of the cubic's minimum above zero, relative to the larger end, below which the minimum itself is sought: the cubic is wrong by less
/// where a step turns no mode by more than a radian.
const NEAR: f64 = 0.05;

/// Part of a step to which an event is located.
const LOCATED: f64 = 1e-15;

/// Events of a cycle above which a contact rattles by roundoff; a bounce of restitution 0.95 dies away within 300.
const MOST_EVENTS: usize = 20_000;

/// A motion on its way. Time runs from zero in each drive cycle.
#[derive(Debug, Clone)]
pub struct Motion<const D: usize> {
    pub state: [f64; D],
    pub phases: Phases,
    pub size: f64,
    /// Events of the last cycle outgrew [`MOST_EVENTS`]: the motion is not followed any more.
    pub is_lost: bool,
    length: f64,
}

/// A step's end: part of the step, state and rate there.
struct End<const D: usize> {
    part: f64,
    state: [f64; D],
    rate: [f64; D],
}

/// The flow of a model with an error per step relative to the size of the motion.
#[derive(Debug, Clone, Copy)]
pub struct Flow<'m, const N: usize, const D: usize> {
    pub model: &'m Model<N, D>,
    pub tolerance: f64,
}

impl<const N: usize, const D: usize> Flow<'_, N, D> {
    /// A motion from a state at the start of a drive cycle.
    pub fn start(&self, state: [f64; D]) -> Motion<D> {
        let model = self.model;
        let phases = model.phases(&state);
        let size = model.weights.square(&state).sqrt().max(model.least_size());
        let mut motion = Motion { state, phases, size, is_lost: false, length: model.cycle_s / 64.0 };
        for p in 0..model.stops.len() {
            let [d, rate] = model.depth(&model.stops[p], &motion.state);
            if matches!(model.stops[p].law, Law::Rigid { .. }) && d >= 0.0 && rate >= 0.0 {
                self.strike(&mut motion, p, 0.0);
            }
        }
        motion
    }

    /// Advances by a drive cycle.
    pub fn cycle(&self, motion: &mut Motion<D>) {
        let (model, end) = (self.model, self.model.cycle_s);
        let (mut t, mut largest, mut events) = (0.0, 0.0_f64, 0);
        let mut rate = model.rate(0.0, &motion.state, &motion.phases, NONE);
        while t < end && !motion.is_lost {
            let remaining = end - t;
            let is_last = motion.length >= remaining;
            let h = motion.length.min(remaining);
            let Stepped { state, error } = self.step(motion, t, h, &rate);
            // Steps grow slowly, so that they stay as short as the contact before and behind them needs.
            let next = if error.is_finite() { h * (0.9 * error.max(1e-12).powf(-0.125)).clamp(0.2, 4.0) } else { 0.2 * h };
            // Not a number where a stage ran far away: the step was much too long.
            if (error.is_nan() || error > 1.0) && h > LEAST_STEP * end {
                motion.length = next;
                continue;
            }
            let whole = End { part: 1.0, state, rate: model.rate(t + h, &state, &motion.phases, NONE) };
            match self.event(motion, (t, h), &rate, whole) {
                Event::Unclear => motion.length = 0.5 * h,
                Event::None(whole) => {
                    t = if is_last { end } else { t + h };
                    (motion.state, rate) = (whole.state, whole.rate);
                    motion.length = if is_last { motion.length.max(next) } else { next };
                }
                Event::At(guard, there) => {
                    t += there.part * h;
                    events += 1;
                    motion.is_lost = events > MOST_EVENTS;
                    motion.state = there.state;
                    self.change(motion, guard, t);
                    rate = model.rate(t, &motion.state, &motion.phases, NONE);
                }
            }
            largest = largest.max(model.weights.square(&motion.state).sqrt());
            motion.size = motion.size.max(largest);
        }
        motion.size = largest.max(model.least_size());
    }

    fn step(&self, motion: &Motion<D>, t: f64, h: f64, rate: &[f64; D]) -> Stepped<D> {
        let right = |t: f64, y: &[f64; D]| self.model.rate(t, y, &motion.phases, NONE);
        let mut stepped = step(right, (t, h), (&motion.state, rate), &self.model.weights);
        stepped.error /= self.tolerance * motion.size;
        stepped
    }

    /// The first event of a step, if there is one.
    fn event(&self, motion: &Motion<D>, (t, h): (f64, f64), rate: &[f64; D], whole: End<D>) -> Event<D> {
        let phases = &motion.phases;
        let mut end = whole;
        let mut found = None;
        // Each guard is seen over what the guards before it have left of the step.
        for guard in self.model.guards(phases).iter() {
            let start = self.model.guard(guard, phases, t, (&motion.state, rate));
            let last = self.model.guard(guard, phases, t + end.part * h, (&end.state, &end.rate));
            let roundoff = self.model.roundoff(guard, &motion.state);
            let is_negative = last[0] < -roundoff;
            let negative = if is_negative { Some(end.part) } else { self.dip(motion, (t, h), rate, (guard, &start, &last, end.part)) };
            let is_at_zero = start[0] <= roundoff;
            let leaves = self.model.direction(guard, phases, start[1], (&motion.state, rate)) > 0.0;
            let there = match negative {
                None => continue,
                // A contact that starts at its surface and does not leave it changes at once.
                Some(_) if is_at_zero && !leaves => 0.0,
                // One that leaves it and is back within the step needs a shorter one.
                Some(part) if is_at_zero && part * h > LEAST_STEP * self.model.cycle_s => return Event::Unclear,
                Some(_) if is_at_zero => 0.0,
                Some(part) => self.root(motion, (t, h), rate, (guard, roundoff, part)),
            };
            end = self.part(motion, (t, h), rate, there);
            found = Some(guard);
        }
        match found {
            Some(guard) => Event::At(guard, end),
            None => Event::None(end),
        }
    }

    /// The step's state at a part of it.
    fn part(&self, motion: &Motion<D>, (t, h): (f64, f64), rate: &[f64; D], part: f64) -> End<D> {
        let state = self.step(motion, t, part * h, rate).state;
        End { part, state, rate: self.model.rate(t + part * h, &state, &motion.phases, NONE) }
    }

    /// Where a guard that is positive at both ends is negative between, if it is.
    fn dip(
        &self,
        motion: &Motion<D>,
        (t, h): (f64, f64),
        rate: &[f64; D],
        (guard, start, last, part): (Guard, &[f64; 2], &[f64; 2], f64),
    ) -> Option<f64> {
        // A holding force has no rate here, and both comparisons are false.
        let falls_and_rises = start[1] < 0.0 && last[1] > 0.0;
        if !falls_and_rises || cubic_minimum(start, last, part * h) > NEAR * start[0].max(last[0]) {
            return None;
        }
        // The minimum by the secant through rates, kept between both ends.
        let (mut low, mut high) = ((0.0, start[1]), (part, last[1]));
        for _ in 0..40 {
            let middle = 0.5 * (low.0 + high.0);
            let secant = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            let width = high.0 - low.0;
            let at = if secant > low.0 + 0.01 * width && secant < high.0 - 0.01 * width { secant } else { middle };
            let end = self.part(motion, (t, h), rate, at);
            let [value, slope] = self.model.guard(guard, &motion.phases, t + at * h, (&end.state, &end.rate));
            if value < -self.model.roundoff(guard, &motion.state) {
                return Some(at);
            }
            // No way down is left that reaches zero.
            if value > slope.abs() * width * h || width < 1e-9 {
                return None;
            }
            if slope < 0.0 { low = (at, slope) } else { high = (at, slope) }
        }
        None
    }

    /// The part of a step at which a guard that is positive at first and negative at `high` vanishes: Newton's method within a bracket.
    fn root(&self, motion: &Motion<D>, (t, h): (f64, f64), rate: &[f64; D], (guard, roundoff, high): (Guard, f64, f64)) -> f64 {
        let (mut low, mut high) = (0.0, high);
        let mut at = 0.5 * high;
        for _ in 0..100 {
            let end = self.part(motion, (t, h), rate, at);
            let [value, slope] = self.model.guard(guard, &motion.phases, t + at * h, (&end.state, &end.rate));
            if value > 0.0 {
                low = at
            } else {
                high = at
            }
            if value.abs() <= 0.25 * roundoff {
                return at;
            }
            // Behind the event: a holding force that has vanished must not be there any more.
            if high - low < LOCATED {
                return high;
            }
            let next = at - value / (slope * h);
            let is_inside = next > low && next < high;
            at = if is_inside { next } else { 0.5 * (low + high) };
        }
        high
    }

    /// What a contact does when its guard vanishes.
    fn change(&self, motion: &mut Motion<D>, guard: Guard, t: f64) {
        let (Guard::Surface(p) | Guard::Push(p) | Guard::Hold(p)) = guard;
        let is_rigid = matches!(self.model.stops[p].law, Law::Rigid { .. });
        motion.phases[p] = match (guard, motion.phases[p]) {
            (Guard::Surface(_), Phase::Free) if is_rigid => return self.strike(motion, p, t),
            (Guard::Surface(_), Phase::Free) | (Guard::Push(_), Phase::Slack) => Phase::Pushing,
            (Guard::Push(_), _) => Phase::Slack,
            (Guard::Surface(_) | Guard::Hold(_), _) => Phase::Free,
        };
    }

    /// An impact on a rigid stop; where what presses the point ends its bounces soon, it rests.
    fn strike(&self, motion: &mut Motion<D>, p: usize, t: f64) {
        let stop = &self.model.stops[p];
        let Law::Rigid { e } = stop.law else { return };
        let [depth, before] = self.model.depth(stop, &motion.state);
        let pressed = self.model.depth(stop, &self.model.rate(t, &motion.state, &motion.phases, NONE))[1];
        let after = e * before.max(0.0);
        let is_slow = after <= CHATTER_SPEED * stop.square.sqrt() * motion.size;
        let rests = is_slow && 2.0 * after <= CHATTER_CYCLES * self.model.cycle_s * pressed * (1.0 - e) && pressed > 0.0;
        let change = if rests { before } else { before + after };
        for i in 0..N {
            motion.state[i] -= depth * stop.shape[i] / stop.square;
            motion.state[N + i] -= change * stop.shape[i] / stop.square;
        }
        if rests {
            motion.phases[p] = Phase::Resting;
        }
    }
}

enum Event<const D: usize> {
    /// No guard changes its sign.
    None(End<D>),
    /// The first guard that does, and where.
    At(Guard, End<D>),
    /// A contact leaves its surface and returns within the step: the step is too long.
    Unclear,
}

/// Least value between the ends of the cubic with two values and rates over a length.
fn cubic_minimum(start: &[f64; 2], last: &[f64; 2], length: f64) -> f64 {
    let (a, b) = (start[1] * length, last[1] * length);
    let rise = last[0] - start[0];
    let (second, third) = (3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise);
    // a + 2 second x + 3 third x^2 = 0, the root where the slope rises.
    let root = (second * second - 3.0 * a * third).max(0.0).sqrt();
    let x = (-a / (second + root)).clamp(0.0, 1.0);
    start[0] + x * (a + x * (second + x * third))
}
