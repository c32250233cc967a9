//! Contacts and energies of an integration.

use super::dormand_prince::{WEIGHTS, step};
use super::flow::{Flow, Motion, NONE};
use super::guard::Guard;
use super::law::{Law, Phase};
use std::cell::Cell;

/// Begin or end of a contact.
#[derive(Debug, Clone, Copy)]
pub struct Passage {
    pub stop: usize,
    pub begins: bool,
    pub time_s: f64,
    /// Magnitude of the speed towards or off the stop, m/s.
    pub speed_m_s: f64,
}

/// Energies since the start without that of the load, J.
#[derive(Debug, Clone, Copy, Default)]
pub struct Work {
    /// Of drive and gravity.
    pub input_j: f64,
    pub damping_j: f64,
    pub leak_j: f64,
    /// Lost in contacts.
    pub contact_j: f64,
}

impl Work {
    /// Returns the sum with a multiple of another.
    pub fn plus(&self, other: &Self, factor: f64) -> Self {
        Self {
            input_j: self.input_j + factor * other.input_j,
            damping_j: self.damping_j + factor * other.damping_j,
            leak_j: self.leak_j + factor * other.leak_j,
            contact_j: self.contact_j + factor * other.contact_j,
        }
    }
}

/// Contacts and energies since the start.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Start of the present drive cycle, s.
    pub start_s: f64,
    pub passages: Vec<Passage>,
    pub work: Work,
}

impl Record {
    /// Notes the begin of a contact at a time of the present cycle.
    pub fn begin(&mut self, stop: usize, t: f64, speed_m_s: f64) {
        self.passages.push(Passage {
            stop,
            begins: true,
            time_s: self.start_s + t,
            speed_m_s,
        });
    }
}

impl<const N: usize, const D: usize> Flow<'_, N, D> {
    /// Adds the energies of a Runge-Kutta step of length `h` from a motion, if they are recorded: the
    /// powers at its stages with the weights of the method.
    pub fn add_work(&self, motion: &mut Motion<D>, (t, h): (f64, f64), rate: &[f64; D]) {
        let Some(record) = &motion.record else {
            return;
        };
        let phases = &motion.phases;
        let power = |t: f64, y: &[f64; D]| self.model.powers(t, y, phases);
        let first = power(t, &motion.state);
        let work = Cell::new(record.work.plus(&first, WEIGHTS[0] * h));
        let stage = Cell::new(1);
        let right = |t: f64, y: &[f64; D]| {
            let weight = WEIGHTS[stage.replace(stage.get() + 1)];
            if weight != 0.0 {
                work.set(work.get().plus(&power(t, y), weight * h));
            }
            self.model.rate(t, y, phases, NONE)
        };
        step(right, (t, h), (&motion.state, rate), &self.model.weights);
        if let Some(record) = &mut motion.record {
            record.work = work.get();
        }
    }

    /// Notes that a stop starts or ends to push while the point is past its surface, if energies are
    /// recorded: the energy of a stop that no longer pushes is lost.
    pub fn note_push(&self, motion: &mut Motion<D>, guard: Guard) {
        let Guard::Push(p) = guard else { return };
        let stop = &self.model.stops[p];
        let stored_j = stop.law.stored(self.model.depth(stop, &motion.state)[0]);
        let sign = if motion.phases[p] == Phase::Slack {
            -1.0
        } else {
            1.0
        };
        if let Some(record) = &mut motion.record {
            record.work.contact_j += sign * stored_j;
        }
    }

    /// Energy of the stops that a point has passed and that do not push, J.
    pub fn slack_j(&self, motion: &Motion<D>) -> f64 {
        let stops = self.model.stops.iter().zip(&motion.phases);
        let slack = stops.filter(|(_, phase)| **phase == Phase::Slack);
        slack
            .map(|(stop, _)| stop.law.stored(self.model.depth(stop, &motion.state)[0]))
            .sum()
    }

    /// Notes that a point passes the surface of a stop that yields, or leaves a rigid one on which it
    /// sticks, if contacts are recorded.
    pub fn note_passage(&self, motion: &mut Motion<D>, guard: Guard, t: f64) {
        let (Guard::Surface(p) | Guard::Hold(p)) = guard else {
            return;
        };
        let stop = &self.model.stops[p];
        if matches!(stop.law, Law::Rigid { .. }) && motion.phases[p] != Phase::Resting {
            return;
        }
        let speed_m_s = self.model.depth(stop, &motion.state)[1].abs();
        let begins = motion.phases[p] == Phase::Free;
        if let Some(record) = &mut motion.record {
            record.passages.push(Passage {
                stop: p,
                begins,
                time_s: record.start_s + t,
                speed_m_s,
            });
        }
    }
}
