//! Tables of a step for all ports in contact: one for each port and one for each effect on another
//! port.

use super::contact::ContactTable;
use super::cross::CrossTable;
use crate::flight::forced::ForcedFlight;
use crate::force_response::basis::NODES;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::small_list::{SharedOrOwned, SmallList};
use jounce_simd::F64x8;

/// Length of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepLength {
    /// Length of a level: its tables are shared.
    Level(i32),
    /// Any other length: its tables are computed for this step only.
    Odd {
        /// Length, s.
        length_s: f64,
        /// Desired level, not shorter.
        level: i32,
    },
}

impl StepLength {
    /// Returns the length in seconds.
    pub fn seconds(self) -> f64 {
        match self {
            StepLength::Level(level) => Kernel::length_s(level),
            StepLength::Odd { length_s, .. } => length_s,
        }
    }

    /// Returns the level, or the desired one.
    pub fn level(self) -> i32 {
        match self {
            StepLength::Level(level) | StepLength::Odd { level, .. } => level,
        }
    }

    /// Returns the table of a port on a step of this length.
    pub fn table(
        self,
        kernel: &Kernel,
        (port, shape): (usize, ForceBasis),
    ) -> SharedOrOwned<'_, ContactTable> {
        match self {
            StepLength::Level(level) => SharedOrOwned::Shared(kernel.table(port, shape, level)),
            StepLength::Odd { length_s, .. } => SharedOrOwned::Own(Box::new(ContactTable::new(
                kernel,
                port,
                kernel.basis(port, shape),
                length_s,
            ))),
        }
    }

    /// Returns the effect of the force of a port on the flight of another.
    pub fn flight(
        self,
        kernel: &Kernel,
        port: (usize, ForceBasis),
        other_port: usize,
    ) -> SharedOrOwned<'_, ForcedFlight> {
        match self {
            StepLength::Level(level) => {
                SharedOrOwned::Shared(kernel.forced_flight(port, other_port, level))
            }
            StepLength::Odd { length_s, .. } => SharedOrOwned::Own(Box::new(ForcedFlight::new(
                kernel, port, other_port, length_s,
            ))),
        }
    }
}

/// Tables of a step for several ports, each in its basis.
#[derive(Debug, Clone)]
pub struct JointTables<'a> {
    /// Ports with their bases.
    pub ports: SmallList<(usize, ForceBasis)>,
    /// Length of the step.
    pub length: StepLength,
    contact_tables: SmallList<SharedOrOwned<'a, ContactTable>>,
    /// From the force of the first index to the port of the second, row by row, without the
    /// diagonal.
    cross: SmallList<SharedOrOwned<'a, CrossTable>>,
}

impl<'a> JointTables<'a> {
    /// Collects the tables of ports on a step.
    pub fn new(kernel: &'a Kernel, ports: &[(usize, ForceBasis)], length: StepLength) -> Self {
        let cross = |from: (usize, ForceBasis), to: (usize, ForceBasis)| match length {
            StepLength::Level(level) => SharedOrOwned::Shared(kernel.cross([from, to], level)),
            StepLength::Odd { length_s, .. } => {
                SharedOrOwned::Own(Box::new(CrossTable::new(kernel, [from, to], length_s)))
            }
        };
        let pairs = ports.iter().flat_map(|from| {
            ports
                .iter()
                .filter(move |to| to.0 != from.0)
                .map(move |to| (*from, *to))
        });
        Self {
            ports: SmallList::from_slice(ports),
            length,
            contact_tables: ports
                .iter()
                .map(|port| length.table(kernel, *port))
                .collect(),
            cross: pairs.map(|(from, to)| cross(from, to)).collect(),
        }
    }

    /// Returns the table of a port by its index among the ports of the step.
    #[inline(always)]
    pub fn table(&self, index: usize) -> &ContactTable {
        &self.contact_tables[index]
    }

    /// Returns the effect of the force of one port on another, by their indices.
    #[inline(always)]
    pub fn cross(&self, from: usize, to: usize) -> &CrossTable {
        &self.cross[from * (self.ports.len() - 1) + to - usize::from(to > from)]
    }

    /// Returns displacement and velocity of one port under the nodal forces of another, or its own.
    #[inline(always)]
    pub fn responses(&self, from: usize, to: usize) -> [&[F64x8; NODES]; 2] {
        if from == to {
            [
                &self.table(to).displacement.push,
                &self.table(to).velocity.push,
            ]
        } else {
            let cross = self.cross(from, to);
            [&cross.displacement, &cross.velocity]
        }
    }

    /// Returns the largest displacement of a port under nodal forces of magnitude 1 at all ports,
    /// m/N.
    #[inline(always)]
    pub fn reach_m_n(&self, index: usize) -> f64 {
        let others = (0..self.ports.len())
            .filter(|from| *from != index)
            .map(|from| self.cross(from, index).reach_m_n);
        self.table(index).reach_m_n + others.sum::<f64>()
    }

    /// Returns the largest velocity of a port under nodal forces of magnitude 1 at all ports, m/(N
    /// s).
    #[inline(always)]
    pub fn reach_m_n_s(&self, index: usize) -> f64 {
        let others = (0..self.ports.len())
            .filter(|from| *from != index)
            .map(|from| self.cross(from, index).reach_m_n_s);
        self.table(index).reach_m_n_s + others.sum::<f64>()
    }
}
