//! The tables of a step for all ports in contact: those of each, and what each does to the others.

use super::basis::NODES;
use super::cross_table::CrossTable;
use super::forced_flight::ForcedFlight;
use super::kernel::{Kernel, Shape};
use super::table::Table;
use crate::wide::Lane;
use std::borrow::Cow;

/// Length of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Of a level: its tables are shared.
    Level(i32),
    /// Any other: its tables are made for this step alone.
    Odd {
        /// The length, s.
        length_s: f64,
        /// The level wanted, not shorter.
        level: i32,
    },
}

impl Length {
    /// In seconds.
    pub fn seconds(self) -> f64 {
        match self {
            Length::Level(level) => Kernel::length_s(level),
            Length::Odd { length_s, .. } => length_s,
        }
    }

    /// The level, or the one that was wanted.
    pub fn level(self) -> i32 {
        match self {
            Length::Level(level) | Length::Odd { level, .. } => level,
        }
    }
}

/// Tables of a step for several ports, each in its basis.
#[derive(Debug, Clone)]
pub struct JointTables<'a> {
    /// The ports with their bases.
    pub ports: Vec<(usize, Shape)>,
    /// The length.
    pub length: Length,
    own: Vec<Cow<'a, Table>>,
    /// From the force of the first index to the port of the second, row by row; empty for one port.
    cross: Vec<Cow<'a, CrossTable>>,
}

impl<'a> JointTables<'a> {
    /// Of ports on a step.
    pub fn new(kernel: &'a Kernel, ports: &[(usize, Shape)], length: Length) -> Self {
        let own = |(port, shape): &(usize, Shape)| match length {
            Length::Level(level) => Cow::Borrowed(kernel.table(*port, *shape, level)),
            Length::Odd { length_s, .. } => Cow::Owned(Table::new(kernel, *port, kernel.basis(*port, *shape), length_s)),
        };
        let cross = |from: (usize, Shape), to: (usize, Shape)| match length {
            _ if from == to => Cow::Owned(CrossTable::default()),
            Length::Level(level) => Cow::Borrowed(kernel.cross([from, to], level)),
            Length::Odd { length_s, .. } => Cow::Owned(CrossTable::new(kernel, [from, to], length_s)),
        };
        let pairs = ports.iter().flat_map(|from| ports.iter().map(move |to| (*from, *to)));
        let several = ports.len() > 1;
        Self {
            ports: ports.to_vec(),
            length,
            own: ports.iter().map(own).collect(),
            cross: pairs.filter(|_| several).map(|(from, to)| cross(from, to)).collect(),
        }
    }

    /// Table of a port by its place among those of the step.
    #[inline(always)]
    pub fn own(&self, place: usize) -> &Table {
        &self.own[place]
    }

    /// What the force of one place does to another.
    #[inline(always)]
    pub fn cross(&self, from: usize, to: usize) -> &CrossTable {
        &self.cross[from * self.ports.len() + to]
    }

    /// Displacement and velocity of one place under the nodal forces of another, or of its own.
    #[inline(always)]
    pub fn answers(&self, from: usize, to: usize) -> [&[Lane; NODES]; 2] {
        if from == to {
            [&self.own(to).displacement.push, &self.own(to).velocity.push]
        } else {
            let cross = self.cross(from, to);
            [&cross.displacement, &cross.velocity]
        }
    }

    /// Largest displacement of a place under nodal forces of magnitude 1 at all of them, m/N.
    #[inline(always)]
    pub fn reach_m_n(&self, place: usize) -> f64 {
        let others = (0..self.ports.len()).filter(|from| *from != place).map(|from| self.cross(from, place).reach_m_n);
        self.own(place).reach_m_n + others.sum::<f64>()
    }

    /// The same of its velocity, m/(N s).
    #[inline(always)]
    pub fn reach_m_n_s(&self, place: usize) -> f64 {
        let others = (0..self.ports.len()).filter(|from| *from != place).map(|from| self.cross(from, place).reach_m_n_s);
        self.own(place).reach_m_n_s + others.sum::<f64>()
    }

    /// What the forces do to the flight of another port, in the order of the places.
    pub fn flights(&self, kernel: &'a Kernel, seen: usize) -> Vec<Cow<'a, ForcedFlight>> {
        let flight = |port: &(usize, Shape)| match self.length {
            Length::Level(level) => Cow::Borrowed(kernel.forced_flight(*port, seen, level)),
            Length::Odd { length_s, .. } => Cow::Owned(ForcedFlight::new(kernel, *port, seen, length_s)),
        };
        self.ports.iter().map(flight).collect()
    }
}
