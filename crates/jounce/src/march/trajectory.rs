//! A recorded march: exact everywhere, not only at its steps.
//!
//! A segment keeps the state at its start and the polynomial of the contact force; the state at any time inside it is the
//! exact flow plus the Duhamel response, evaluated from its Legendre series.

use super::answers::Answers;
use super::basis::{NODES, legendre};
use super::factors::factored;
use super::kernel::{Kernel, Shape};
use super::response::parts;
use crate::plant::Size;
use crate::wide::Portable;
use std::collections::HashMap;

/// One step as it was taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// Time at its start, s.
    pub start_s: f64,
    /// Length, s.
    pub length_s: f64,
    /// State at its start less what the signals force, block coordinates.
    pub state: Vec<f64>,
    /// Size and slope of each signal at its start.
    pub sizes: Vec<Size>,
    /// Basis of the contact force and its values at the seven nodes, N; `None` in flight.
    pub force: Option<(Shape, [f64; NODES])>,
}

/// Consecutive segments.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory {
    segments: Vec<Segment>,
}

/// A state of a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    /// Time, s.
    pub time_s: f64,
    /// Block coordinates.
    pub state: Vec<f64>,
    /// Contact force, N.
    pub force_n: f64,
}

impl Trajectory {
    pub(super) fn push(&mut self, segment: Segment) {
        self.segments.push(segment);
    }

    /// The steps.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// States at ascending times; times outside the record are taken from its nearest segment.
    pub fn at(&self, kernel: &Kernel, times_s: &[f64]) -> Vec<Instant> {
        let mut made: HashMap<(u64, Shape), Vec<Answers>> = HashMap::new();
        let mut instants = Vec::with_capacity(times_s.len());
        let mut index = 0;
        for &time_s in times_s {
            while index + 1 < self.segments.len() && self.segments[index + 1].start_s <= time_s {
                index += 1;
            }
            let Some(segment) = self.segments.get(index) else { break };
            let answers = segment.force.map(|(shape, _)| {
                let length_s = segment.length_s;
                &*made.entry((length_s.to_bits(), shape)).or_insert_with(|| answers(kernel, shape, length_s))
            });
            instants.push(segment.at(kernel, time_s, answers.map(Vec::as_slice)));
        }
        instants
    }
}

/// Answers of all blocks on a step of one length.
fn answers(kernel: &Kernel, shape: Shape, length_s: f64) -> Vec<Answers> {
    let (w, basis) = (Portable::new(), kernel.basis(0, shape));
    let solved = |(_, part)| {
        let mut answers = Answers::default();
        answers.solve(w, &part, basis, length_s, (&factored(w, &[part], basis, length_s), 0));
        answers
    };
    parts(&kernel.plant.diagonal.block).map(solved).collect()
}

impl Segment {
    fn at(&self, kernel: &Kernel, time_s: f64, answers: Option<&[Answers]>) -> Instant {
        let after_s = time_s - self.start_s;
        let block = &kernel.plant.diagonal.block;
        let mut state = block.flow(after_s, &self.state);
        if !self.sizes.is_empty() {
            let forced = kernel.plant.forced(&self.sizes, after_s);
            state.iter_mut().zip(forced).for_each(|(y, forced)| *y += forced);
        }
        let mut force_n = 0.0;
        if let (Some((shape, force)), Some(answers)) = (self.force, answers) {
            let x = after_s / self.length_s;
            let functions = kernel.basis(0, shape).at(x.clamp(0.0, 1.0));
            force_n = functions.iter().zip(&force).map(|(b, f)| b * f).sum::<f64>().max(0.0);
            let column = &kernel.plant.ports[0].force;
            let powers = legendre(x, answers.iter().map(|answers| answers.first.len()).max().unwrap_or(0));
            for ((first, part), answers) in parts(block).zip(answers) {
                let sum = |series: &[crate::wide::Lane]| -> f64 {
                    series.iter().zip(&powers).map(|(lane, p)| p * (0..NODES).map(|j| force[j] * lane.0[j]).sum::<f64>()).sum()
                };
                let (one, two) = (sum(&answers.first), sum(&answers.second));
                for s in 0..part.states() {
                    let unit: [f64; 2] = std::array::from_fn(|i| if i == s { 1.0 } else { 0.0 });
                    let [f, g] = part.forced(&unit, &column[first..first + part.states()], self.length_s);
                    state[first + s] += f * one + g * two;
                }
            }
        }
        Instant { time_s, state, force_n }
    }
}
