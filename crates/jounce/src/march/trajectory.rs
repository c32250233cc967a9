//! A recorded march: exact everywhere, not only at its steps.
//!
//! A segment keeps the state at its start and the polynomial of the contact force; the state at any time inside it is the
//! exact flow plus the Duhamel response, evaluated from its Legendre series.

use super::collocation::{COLLOCATION, NODES, legendre};
use super::kernel::Kernel;
use super::table::{BlockResponse, block_responses};
use std::collections::HashMap;

/// One step as it was taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// Time at its start, s.
    pub start_s: f64,
    /// Length, s.
    pub length_s: f64,
    /// State at its start, block coordinates.
    pub state: Vec<f64>,
    /// Contact force at the seven nodes, N; `None` in flight.
    pub force_n: Option<[f64; NODES]>,
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
        let mut responses: HashMap<u64, Vec<BlockResponse>> = HashMap::new();
        let mut instants = Vec::with_capacity(times_s.len());
        let mut index = 0;
        for &time_s in times_s {
            while index + 1 < self.segments.len() && self.segments[index + 1].start_s <= time_s {
                index += 1;
            }
            let Some(segment) = self.segments.get(index) else { break };
            let force = kernel.plant.ports.first().map(|port| port.force.as_slice()).unwrap_or_default();
            let blocks = segment
                .force_n
                .map(|_| &*responses.entry(segment.length_s.to_bits()).or_insert_with(|| block_responses(kernel, force, segment.length_s)));
            instants.push(segment.at(kernel, time_s, blocks.map(Vec::as_slice)));
        }
        instants
    }
}

impl Segment {
    fn at(&self, kernel: &Kernel, time_s: f64, blocks: Option<&[BlockResponse]>) -> Instant {
        let after_s = time_s - self.start_s;
        let mut state = kernel.plant.diagonal.block.flow(after_s, &self.state);
        let mut force_n = 0.0;
        if let (Some(force), Some(blocks)) = (self.force_n, blocks) {
            let c = &*COLLOCATION;
            let series: [f64; NODES] = std::array::from_fn(|b| (0..NODES).map(|j| c.from_nodal[b][j] * force[j]).sum());
            let count = blocks.iter().flat_map(|block| block.time.iter().map(|time| time[0].len())).max().unwrap_or(NODES);
            let basis = legendre(after_s / self.length_s, count.max(NODES));
            force_n = series.iter().zip(&basis).map(|(f, p)| f * p).sum::<f64>().max(0.0);
            for block in blocks {
                for (state_index, time) in block.states.iter().zip(&block.time) {
                    for (b, factor) in series.iter().enumerate() {
                        state[*state_index] += factor * time[b].iter().zip(&basis).map(|(y, p)| y * p).sum::<f64>();
                    }
                }
            }
        }
        Instant { time_s, state, force_n }
    }
}
