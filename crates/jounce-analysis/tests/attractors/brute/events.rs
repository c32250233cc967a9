//! The first event of a step, located by repeating the step with a fraction of its length.
//!
//! A step is accepted only when no event function changes its sign in it. An event function that is
//! positive at both ends, decreasing at the start and increasing at the end, has a minimum between.
//! If the cubic through values and rates comes near zero there, the sign of the actual minimum is
//! computed.

use super::flow::{Flow, Motion, NONE};
use super::guard::Guard;

/// Fraction of a cycle below which a step is not halved further: an event this near counts as
/// having happened.
pub const LEAST_STEP: f64 = 1e-14;

/// Value of the cubic's minimum, relative to the larger end, below which the actual minimum is
/// computed. The error of the cubic is smaller where no mode turns by more than a radian in a step.
const NEAR: f64 = 0.05;

/// Fraction of a step to which an event is located.
const LOCATED: f64 = 1e-15;

/// End of a step: fraction of the step, state and rate there.
pub struct End<const D: usize> {
    pub part: f64,
    pub state: [f64; D],
    pub rate: [f64; D],
}

/// Event that ends a step.
pub enum Event<const D: usize> {
    /// No event function changes its sign.
    None(End<D>),
    /// First event function that changes its sign, and the end of the step there.
    At(Guard, End<D>),
    /// A contact leaves its surface and returns within the step: the step is too long.
    Unclear,
}

impl<const N: usize, const D: usize> Flow<'_, N, D> {
    /// Returns the first event of a step.
    pub fn event(
        &self,
        motion: &Motion<D>,
        (t, h): (f64, f64),
        rate: &[f64; D],
        complete: End<D>,
    ) -> Event<D> {
        let phases = &motion.phases;
        let mut end = complete;
        let mut event = None;
        // Each event function is checked over the part of the step before the events found so far.
        for guard in self.model.guards(phases).iter() {
            let start = self
                .model
                .guard_with_rate(guard, phases, t, (&motion.state, rate));
            let last = self.model.guard_with_rate(
                guard,
                phases,
                t + end.part * h,
                (&end.state, &end.rate),
            );
            let roundoff = self.model.roundoff(guard, &motion.state);
            let is_negative = last[0] < -roundoff;
            let negative = if is_negative {
                Some(end.part)
            } else {
                self.local_minimum(motion, (t, h), rate, (guard, &start, &last, end.part))
            };
            let is_at_zero = start[0] <= roundoff;
            let leaves = self
                .model
                .direction(guard, phases, start[1], (&motion.state, rate))
                > 0.0;
            let there = match negative {
                None => continue,
                // A contact that starts at its surface and does not leave it changes at once.
                Some(_) if is_at_zero && !leaves => 0.0,
                // A contact that leaves the surface and returns within the step needs a shorter
                // step.
                Some(part) if is_at_zero && part * h > LEAST_STEP * self.model.cycle_s => {
                    return Event::Unclear;
                }
                Some(_) if is_at_zero => 0.0,
                Some(part) => self.root(motion, (t, h), rate, (guard, roundoff, part)),
            };
            end = self.state_at_fraction(motion, (t, h), rate, there);
            event = Some(guard);
        }
        match event {
            Some(guard) => Event::At(guard, end),
            None => Event::None(end),
        }
    }

    /// State at a fraction of a step.
    fn state_at_fraction(
        &self,
        motion: &Motion<D>,
        (t, h): (f64, f64),
        rate: &[f64; D],
        part: f64,
    ) -> End<D> {
        let state = self.step(motion, t, part * h, rate).state;
        End {
            part,
            state,
            rate: self.model.rate(t + part * h, &state, &motion.phases, NONE),
        }
    }

    /// Finds the point where an event function that is positive at both ends is negative between,
    /// if there is one.
    fn local_minimum(
        &self,
        motion: &Motion<D>,
        (t, h): (f64, f64),
        rate: &[f64; D],
        (guard, start, last, part): (Guard, &[f64; 2], &[f64; 2], f64),
    ) -> Option<f64> {
        let falls_and_rises = start[1] < 0.0 && last[1] > 0.0;
        if !falls_and_rises || cubic_minimum(start, last, part * h) > NEAR * start[0].max(last[0]) {
            return None;
        }
        // The minimum by the secant through rates, inside the bracket.
        let (mut low, mut high) = ((0.0, start[1]), (part, last[1]));
        for _ in 0..40 {
            let middle = 0.5 * (low.0 + high.0);
            let secant = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            let width = high.0 - low.0;
            let at = if secant > low.0 + 0.01 * width && secant < high.0 - 0.01 * width {
                secant
            } else {
                middle
            };
            let end = self.state_at_fraction(motion, (t, h), rate, at);
            let [value, slope] = self.model.guard_with_rate(
                guard,
                &motion.phases,
                t + at * h,
                (&end.state, &end.rate),
            );
            if value < -self.model.roundoff(guard, &motion.state) {
                return Some(at);
            }
            // The remaining decrease cannot reach zero.
            if value > slope.abs() * width * h || width < 1e-9 {
                return None;
            }
            if slope < 0.0 {
                low = (at, slope)
            } else {
                high = (at, slope)
            }
        }
        None
    }

    /// Fraction of a step at which an event function that is positive at the start and negative at
    /// `high` vanishes: Newton's method in a bracket.
    fn root(
        &self,
        motion: &Motion<D>,
        (t, h): (f64, f64),
        rate: &[f64; D],
        (guard, roundoff, high): (Guard, f64, f64),
    ) -> f64 {
        let (mut low, mut high) = (0.0, high);
        let mut at = 0.5 * high;
        for _ in 0..100 {
            let end = self.state_at_fraction(motion, (t, h), rate, at);
            let [value, slope] =
                self.model
                    .guard(guard, &motion.phases, t + at * h, (&end.state, &end.rate));
            if value > 0.0 {
                low = at
            } else {
                high = at
            }
            if value.abs() <= 0.25 * roundoff {
                return at;
            }
            // Beyond the event: a holding force that has vanished must be zero there.
            if high - low < LOCATED {
                return high;
            }
            let next = at - value / (slope * h);
            let is_inside = next > low && next < high;
            at = if is_inside { next } else { 0.5 * (low + high) };
        }
        high
    }
}

/// Smallest value, inside a length, of the cubic with the given values and rates at its ends.
fn cubic_minimum(start: &[f64; 2], last: &[f64; 2], length: f64) -> f64 {
    let (a, b) = (start[1] * length, last[1] * length);
    let rise = last[0] - start[0];
    let (second, third) = (3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise);
    // a + 2 second x + 3 third x^2 = 0, the root where the slope rises.
    let root = (second * second - 3.0 * a * third).max(0.0).sqrt();
    let x = (-a / (second + root)).clamp(0.0, 1.0);
    start[0] + x * (a + x * (second + x * third))
}
