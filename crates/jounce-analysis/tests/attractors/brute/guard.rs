//! Event functions of contacts, which stay positive within a phase, and their rates.

use super::law::{Law, Phase};
use super::model::{Phases, ReferenceModel, STOPS};

/// Function of the state that is positive as long as a contact stays in its phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guard {
    /// Distance from the surface: outside for an open contact, inside for a closed one.
    Surface(usize),
    /// Quantity with the sign of a damped force.
    Push(usize),
    /// Force needed from a rigid stop to hold its point.
    Hold(usize),
}

/// Fraction of a cycle for differences of a holding force.
const HOLD_DIFFERENCE: f64 = 1e-6;

/// List of event functions without allocation.
#[derive(Debug, Clone, Copy)]
pub struct Guards {
    list: [Guard; 2 * STOPS],
    count: usize,
}

impl Guards {
    /// Iterates over the active event functions.
    pub fn iter(&self) -> impl Iterator<Item = Guard> + '_ {
        self.list[..self.count].iter().copied()
    }

    fn push(&mut self, guard: Guard) {
        self.list[self.count] = guard;
        self.count += 1;
    }
}

impl<const N: usize, const D: usize> ReferenceModel<N, D> {
    /// Returns the event functions of the given phases.
    pub fn guards(&self, phases: &Phases) -> Guards {
        let mut guards = Guards {
            list: [Guard::Surface(0); 2 * STOPS],
            count: 0,
        };
        for (p, stop) in self.stops.iter().enumerate() {
            match (phases[p], stop.law) {
                (_, Law::Cubic { .. }) => {}
                (Phase::Resting, _) => guards.push(Guard::Hold(p)),
                (phase, law) => {
                    guards.push(Guard::Surface(p));
                    if phase != Phase::Free && law.is_damped() {
                        guards.push(Guard::Push(p));
                    }
                }
            }
        }
        guards
    }

    /// True for the surface of an open stop that faces a closed stop `p` at the same point, so that
    /// it cannot be reached before that one opens.
    pub fn is_closed_by(&self, guard: Guard, p: usize, phases: &Phases) -> bool {
        let Guard::Surface(q) = guard else {
            return false;
        };
        let (open, closed) = (&self.stops[q], &self.stops[p]);
        q != p
            && phases[q] == Phase::Free
            && (0..N).all(|i| open.shape[i] == -closed.shape[i])
            && open.gap + closed.gap >= 0.0
            && !matches!(closed.law, Law::Cubic { .. })
    }

    /// Value of an event function and its rate; the rate of a holding force is not needed, and NaN.
    #[inline(always)]
    pub fn guard(
        &self,
        guard: Guard,
        phases: &Phases,
        t: f64,
        (y, rate): (&[f64; D], &[f64; D]),
    ) -> [f64; 2] {
        match guard {
            Guard::Surface(p) => {
                let [d, speed] = self.depth(&self.stops[p], y);
                if phases[p] == Phase::Free {
                    [-d, -speed]
                } else {
                    [d, speed]
                }
            }
            Guard::Push(p) => {
                let stop = &self.stops[p];
                let [d, speed] = self.depth(stop, y);
                let (push, push_rate) = (
                    stop.law.push(d, speed),
                    stop.law.push_rate(speed, self.depth(stop, rate)[1]),
                );
                if phases[p] == Phase::Pushing {
                    [push, push_rate]
                } else {
                    [-push, -push_rate]
                }
            }
            Guard::Hold(p) => {
                let free = self.rate(t, y, phases, p);
                [self.depth(&self.stops[p], &free)[1], f64::NAN]
            }
        }
    }

    /// Value of an event function and its rate, which for a holding force is a difference over the
    /// motion.
    pub fn guard_with_rate(
        &self,
        guard: Guard,
        phases: &Phases,
        t: f64,
        (y, rate): (&[f64; D], &[f64; D]),
    ) -> [f64; 2] {
        let [value, slope] = self.guard(guard, phases, t, (y, rate));
        if !matches!(guard, Guard::Hold(_)) {
            return [value, slope];
        }
        let apart = HOLD_DIFFERENCE * self.cycle_s;
        let [before, after] = [-apart, apart].map(|s| {
            let near = std::array::from_fn(|i| y[i] + s * rate[i]);
            self.guard(guard, phases, t + s, (&near, rate))[0]
        });
        [value, 0.5 * (after - before) / apart]
    }

    /// Roundoff of an event function; zero for a holding force, of which only the sign is used.
    pub fn roundoff(&self, guard: Guard, y: &[f64; D]) -> f64 {
        let terms = |p: usize, from: usize| {
            (0..N)
                .map(|i| (self.stops[p].shape[i] * y[from + i]).abs())
                .sum::<f64>()
        };
        let depth = |p: usize| self.stops[p].gap.abs() + terms(p, 0);
        8.0 * f64::EPSILON
            * match guard {
                Guard::Surface(p) => depth(p),
                Guard::Push(p) => match self.stops[p].law {
                    Law::Viscous { k, c } => k * depth(p) + c * terms(p, N),
                    _ => 1.0,
                },
                Guard::Hold(_) => 0.0,
            }
    }

    /// Direction of an event function at zero: its rate, or the second derivative where the rate of
    /// a surface is roundoff.
    pub fn direction(
        &self,
        guard: Guard,
        phases: &Phases,
        slope: f64,
        (y, rate): (&[f64; D], &[f64; D]),
    ) -> f64 {
        let Guard::Surface(p) = guard else {
            return slope;
        };
        let stop = &self.stops[p];
        let roundoff = 8.0
            * f64::EPSILON
            * (0..N)
                .map(|i| (stop.shape[i] * y[N + i]).abs())
                .sum::<f64>();
        let acceleration = self.depth(stop, rate)[1];
        match phases[p] {
            _ if slope.abs() > roundoff => slope,
            Phase::Free => -acceleration,
            _ => acceleration,
        }
    }
}
