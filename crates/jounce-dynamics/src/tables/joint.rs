//! Tables of a step for all ports in contact: one for each port and one for each effect on another
//! port.

use super::contact::ContactTable;
use super::cross::CrossTable;
use super::step_tables::StepTables;
use crate::force_response::basis::NODES;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::small_list::SmallList;
use jounce_simd::F64x8;

/// Length of a step: its tables and its level.
#[derive(Debug, Clone, Copy)]
pub struct StepLength<'a> {
    /// Tables.
    pub tables: &'a StepTables,
    /// Level of this length, or a longer one where it lies between two levels.
    pub level: i32,
}

impl StepLength<'_> {
    /// Returns the length in seconds.
    pub fn seconds(self) -> f64 {
        self.tables.length_s
    }

    /// True for the length of the level.
    pub fn is_level(self) -> bool {
        self.tables.length_s == Kernel::length_s(self.level)
    }
}

/// Tables of a step for several ports, each in its basis.
#[derive(Debug, Clone)]
pub struct JointTables<'a> {
    /// Ports with their bases.
    pub ports: SmallList<(usize, ForceBasis)>,
    /// Length of the step.
    pub length: StepLength<'a>,
    contact_tables: SmallList<&'a ContactTable>,
    /// From the force of the first index to the port of the second, row by row, without the
    /// diagonal.
    cross: SmallList<&'a CrossTable>,
}

impl<'a> JointTables<'a> {
    /// Collects the tables of ports on a step.
    pub fn new(kernel: &Kernel, ports: &[(usize, ForceBasis)], length: StepLength<'a>) -> Self {
        let pairs = ports.iter().flat_map(|from| {
            ports
                .iter()
                .filter(move |to| to.0 != from.0)
                .map(move |to| [*from, *to])
        });
        Self {
            ports: SmallList::from_slice(ports),
            length,
            contact_tables: ports
                .iter()
                .map(|port| length.tables.contact(kernel, *port))
                .collect(),
            cross: pairs
                .map(|pair| length.tables.cross(kernel, pair))
                .collect(),
        }
    }

    /// Returns the table of a port by its index among the ports of the step.
    #[inline(always)]
    pub fn table(&self, index: usize) -> &ContactTable {
        self.contact_tables[index]
    }

    /// Returns the effect of the force of one port on another, by their indices.
    #[inline(always)]
    pub fn cross(&self, from: usize, to: usize) -> &CrossTable {
        self.cross[from * (self.ports.len() - 1) + to - usize::from(to > from)]
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
