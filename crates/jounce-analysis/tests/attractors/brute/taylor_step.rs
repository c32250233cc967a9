//! Step by a Taylor series, up to the first event.

use super::first_root::{first_root, value_and_slope};
use super::flow::{Flow, Motion};
use super::guard::Guard;
use super::law::{Law, Phase};
use super::model::Phases;
use super::record::Work;
use super::taylor::{Coefficients, Force, ORDER, Series};

/// An event function must grow by this many times its roundoff over a step that starts at its zero.
const CLEAR: f64 = 1e4;

/// Largest distance past the zero of a holding force, relative to the length of the step.
const MAX_PAST_ZERO: f64 = 1e-10;

/// End of a step by a series.
pub struct TaylorEnd<const D: usize> {
    pub state: [f64; D],
    /// Duration of the step.
    pub duration: f64,
    /// Event at the end.
    pub event: Option<Guard>,
    /// Square of the norm in the middle of the step.
    pub middle: f64,
    /// Energies of the step, where they are recorded.
    pub work: Option<Work>,
}

/// Value of a polynomial vector.
pub fn vector<const D: usize>(series: &[[f64; D]; ORDER + 1], s: f64) -> [f64; D] {
    vector_from(0, series, s)
}

/// Value of the components from number `first` on; zero in the others.
#[inline(always)]
fn vector_from<const D: usize>(first: usize, series: &[[f64; D]; ORDER + 1], s: f64) -> [f64; D] {
    let mut y = [0.0; D];
    for k in (0..=ORDER).rev() {
        (first..D).for_each(|i| y[i] = y[i] * s + series[k][i]);
    }
    y
}

/// Nodes and weights of the quadrature of Gauss and Legendre on `[-1, 1]`, each for both signs:
/// Abramowitz and Stegun, *Handbook of Mathematical Functions*, table 25.4, n = 8.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_47],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// Time integral of the square of the voltage over a step. The square turns twice as fast as the
/// state; with eight nodes its error is below 1e-11 where the voltage turns by three radians.
fn energy<const D: usize>(series: &Series<D>, end: f64) -> f64 {
    let half = 0.5 * end;
    let nodes: [f64; 8] = std::array::from_fn(|i| {
        let node = GAUSS[i / 2][0];
        half * if i % 2 == 0 { 1.0 - node } else { 1.0 + node }
    });
    let (mut voltage, mut speed) = ([0.0; 8], [0.0; 8]);
    for k in (0..=ORDER).rev() {
        let (v, t) = (series.state[k][D - 2], k as f64 * series.time[k]);
        for i in 0..8 {
            voltage[i] = voltage[i] * nodes[i] + v;
            speed[i] = if k > 0 {
                speed[i] * nodes[i] + t
            } else {
                speed[i]
            };
        }
    }
    (0..8)
        .map(|i| half * GAUSS[i / 2][1] * voltage[i] * voltage[i] * speed[i])
        .sum()
}

/// Sum of the absolute terms.
fn terms(p: &Coefficients, s: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * s + c.abs())
}

impl<const N: usize, const D: usize> Flow<'_, N, D> {
    /// Takes a step from a time with at most a given duration, to the next event. `None` where this
    /// method does not apply: in some phases, and where the motion grazes a surface.
    pub fn taylor_step(&self, motion: &Motion<D>, t: f64, remaining: f64) -> Option<TaylorEnd<D>> {
        let model = self.model;
        let force = model.series_force(&motion.phases)?;
        let root = self.start_root(motion, force)?;
        let series = model.series((t, &motion.state), &motion.phases, (force, root));
        let is_time = force.root() == 1.0;
        let longest = if is_time { remaining } else { f64::INFINITY };
        let length = self.length(&series, motion.size, force).min(longest);
        if !length.is_finite() || length <= 0.0 {
            return None;
        }
        let (mut end, mut event) = self.first_event(&series, motion, force, length)?;
        let mut duration = if is_time {
            end
        } else {
            value_and_slope(&series.time, end)[0]
        };
        if duration > remaining {
            // The event lies after the end of the cycle.
            (end, event) = (time_root(&series.time, remaining, end), None);
            duration = remaining;
        }
        let mut state = vector(&series.state, end);
        state[D - 1] += model.load_power(energy(&series, end));
        state.iter().all(|y| y.is_finite()).then(|| TaylorEnd {
            state,
            duration,
            event,
            middle: model.weights.square(&vector(&series.state, 0.5 * end)),
            work: (motion.record.is_some()).then(|| self.work(t, &series, end, &motion.phases)),
        })
    }

    /// Energies of a step from a time.
    fn work(&self, t: f64, series: &Series<D>, end: f64, phases: &Phases) -> Work {
        let half = 0.5 * end;
        let mut work = Work::default();
        let mut stops = self.model.stops.iter().zip(phases);
        let loses = stops.any(|(stop, phase)| *phase == Phase::Pushing && stop.law.is_damped());
        // Displacements matter in damped contacts only.
        let first = if loses { 0 } else { N };
        for [node, weight] in GAUSS {
            for at in [half * (1.0 - node), half * (1.0 + node)] {
                let [after, speed] = value_and_slope(&series.time, at);
                let powers =
                    self.model
                        .powers(t + after, &vector_from(first, &series.state, at), phases);
                work = work.plus(&powers, half * weight * speed);
            }
        }
        work
    }

    /// The variable `u` of a force; `None` for a contact that starts at its surface and does not
    /// clearly enter it.
    fn start_root(&self, motion: &Motion<D>, force: Force) -> Option<f64> {
        let Some(p) = force.stop() else {
            return Some(0.0);
        };
        let stop = &self.model.stops[p];
        let [d, speed] = self.model.depth(stop, &motion.state);
        let is_at_surface = d <= self.model.roundoff(Guard::Surface(p), &motion.state);
        match force {
            Force::Cubic { .. } => Some(d),
            _ if is_at_surface => {
                let terms = (0..N).map(|i| (stop.shape[i] * motion.state[N + i]).abs());
                let roundoff = 8.0 * f64::EPSILON * terms.sum::<f64>();
                (speed > CLEAR * roundoff).then_some(0.0)
            }
            Force::Root2 { .. } => Some(d.sqrt()),
            Force::Root5 { .. } => Some(d.powf(0.2)),
            _ => Some(d),
        }
    }

    /// End of a step of a given length, and the event that ends it; `None` where an event function
    /// starts at its zero and does not clearly leave it.
    fn first_event(
        &self,
        series: &Series<D>,
        motion: &Motion<D>,
        force: Force,
        length: f64,
    ) -> Option<(f64, Option<Guard>)> {
        let (model, phases) = (self.model, &motion.phases);
        let (mut end, mut event) = (length, None);
        for guard in model.guards(phases).iter() {
            let is_closed = |p| model.is_closed_by(guard, p, phases);
            if end == 0.0 || force.stop().is_some_and(is_closed) {
                continue;
            }
            let (polynomial, roundoff) = self.event_series(series, motion, (guard, force), end);
            if let Some(mut at) = first_zero(&polynomial, roundoff, end)? {
                if matches!(guard, Guard::Hold(_)) {
                    at = past_zero(&polynomial, roundoff, at)?;
                }
                (end, event) = (at, Some(guard));
            }
        }
        Some((end, event))
    }

    /// Length of a step whose last two terms are below the error of a step.
    pub fn length(&self, series: &Series<D>, size: f64, force: Force) -> f64 {
        let model = self.model;
        let error = self.tolerance * size;
        let fastest = (0..N)
            .map(|i| model.weights.0[i])
            .fold(model.angular(), f64::max);
        let of_state = |k: usize| {
            let term = model.weights.square(&series.state[k]).sqrt() / error;
            let time = series.time[k].abs() * fastest / self.tolerance;
            term.max(if k > 1 { time } else { 0.0 })
                .powf(-1.0 / k as f64)
        };
        let mut length = of_state(ORDER - 1).min(of_state(ORDER));
        if force.stop().is_some() {
            let u = &series.root;
            let largest = u[0].abs().max(u[1].abs() * length);
            for k in [ORDER - 1, ORDER] {
                length =
                    length.min((u[k].abs() / (self.tolerance * largest)).powf(-1.0 / k as f64));
            }
        }
        length
    }

    /// Series of an event function, with its roundoff.
    fn event_series(
        &self,
        series: &Series<D>,
        motion: &Motion<D>,
        (guard, force): (Guard, Force),
        end: f64,
    ) -> (Coefficients, f64) {
        let (Guard::Surface(p) | Guard::Push(p) | Guard::Hold(p)) = guard;
        let stop = &self.model.stops[p];
        if matches!(guard, Guard::Hold(_)) {
            return (series.hold, 8.0 * f64::EPSILON * terms(&series.hold, end));
        }
        let is_surface = matches!(guard, Guard::Surface(_));
        if is_surface && force.stop() == Some(p) {
            return (series.root, f64::EPSILON * terms(&series.root, end));
        }
        let roundoff = self.model.roundoff(guard, &motion.state);
        let sign = match (is_surface, motion.phases[p]) {
            (true, Phase::Free) | (false, Phase::Slack) => -1.0,
            _ => 1.0,
        };
        let mut polynomial = [0.0; ORDER + 1];
        for (k, coefficient) in polynomial.iter_mut().enumerate() {
            let [along, speed] = stop.along(&series.state[k]);
            let constant = if k == 0 { 1.0 } else { 0.0 };
            *coefficient = sign
                * match (is_surface, stop.law) {
                    (true, _) => along - constant * stop.gap,
                    (false, Law::Viscous { k, c }) => k * (along - constant * stop.gap) + c * speed,
                    (false, Law::Power { a, .. } | Law::Table { a, .. }) => constant + a * speed,
                    (false, _) => constant,
                };
        }
        (polynomial, roundoff)
    }
}

/// First zero of an event function; `None` where it starts at zero and does not clearly leave it.
fn first_zero(polynomial: &Coefficients, roundoff: f64, end: f64) -> Option<Option<f64>> {
    if polynomial[0] > roundoff {
        return first_root(polynomial, end, 0.25 * roundoff).ok();
    }
    // A contact that starts at its surface and does not leave it changes at once.
    if polynomial[1] * end < -CLEAR * roundoff {
        return Some(Some(0.0));
    }
    if polynomial[1] * end <= CLEAR * roundoff {
        return None;
    }
    let mut quotient = [0.0; ORDER + 1];
    quotient[..ORDER].copy_from_slice(&polynomial[1..]);
    first_root(&quotient, end, 0.0).ok()
}

/// Point just past a zero that a polynomial falls through: a holding force that has vanished must not
/// press there. `None` where it falls too slowly.
fn past_zero(polynomial: &Coefficients, roundoff: f64, at: f64) -> Option<f64> {
    let [value, slope] = value_and_slope(polynomial, at);
    let past = (value.max(0.0) + roundoff) / -slope;
    (past > 0.0 && past < MAX_PAST_ZERO * at).then_some(at + past)
}

/// Point before `end` where the time, which grows up to there, has a value.
fn time_root(time: &Coefficients, value: f64, end: f64) -> f64 {
    let (mut low, mut high) = (0.0, end);
    let mut at = 0.5 * end;
    for _ in 0..200 {
        let [t, slope] = value_and_slope(time, at);
        if t < value {
            low = at
        } else {
            high = at
        }
        if (t - value).abs() <= f64::EPSILON * value || high - low <= f64::EPSILON * end {
            break;
        }
        let next = at - (t - value) / slope;
        at = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
    }
    at
}
