//! What must stay positive while every contact keeps its phase, with its rate, and what a contact does when it does not.

use super::law::{Law, Phase};
use super::model::{Phases, ReferenceModel, STOPS};

/// A function of the state that is positive as long as a contact keeps its phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guard {
    /// Distance from the surface: of a contact that is apart from outside, of another from inside.
    Surface(usize),
    /// What has the sign of a damped force.
    Push(usize),
    /// Force that a rigid stop must give to hold its point.
    Hold(usize),
}

/// A list of guards without allocation.
#[derive(Debug, Clone, Copy)]
pub struct Guards {
    list: [Guard; 2 * STOPS],
    count: usize,
}

impl Guards {
    /// The guards that are active.
    pub fn iter(&self) -> impl Iterator<Item = Guard> + '_ {
        self.list[..self.count].iter().copied()
    }

    fn push(&mut self, guard: Guard) {
        self.list[self.count] = guard;
        self.count += 1;
    }
}

impl<const N: usize, const D: usize> ReferenceModel<N, D> {
    /// The guards of some phases.
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

    /// Value of a guard and its rate; that of a holding force is not needed, and NaN.
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

    /// What of a guard is roundoff: nothing of a holding force, whose sign alone counts.
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

    /// Where a guard that is zero goes: its rate, or where that of a surface is roundoff, the rate of the rate.
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
