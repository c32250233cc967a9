//! The tables of a kernel, one set for each step length, each made when first used.

use super::answers::Answers;
use super::basis::{Basis, SMOOTH};
use super::cross_table::CrossTable;
use super::flight_table::FlightTable;
use super::flow::{Flow, SHORT};
use super::forced_flight::ForcedFlight;
use super::kernel::{Kernel, Shape};
use super::table::{Sticking, Table};
use crate::plant::Plant;
use smallvec::SmallVec;
use std::sync::OnceLock;

/// The tables of one step length.
#[derive(Debug)]
pub struct Level {
    flow: OnceLock<Flow>,
    ports: Vec<PortLevel>,
}

#[derive(Debug, Default)]
struct PortLevel {
    flight: OnceLock<FlightTable>,
    smooth: OnceLock<Box<Table>>,
    onset: OnceLock<Box<Table>>,
    sticking: OnceLock<Box<Sticking>>,
    /// Per basis: what each block answers inside the step.
    answers: [OnceLock<Vec<Answers>>; 2],
    /// What its force does to each port; empty for the only port.
    seen: Vec<SeenLevel>,
}

/// What the force of one port does to another, per basis of the force and of the other port, each smooth or onset.
#[derive(Debug, Default)]
struct SeenLevel {
    crosses: [[OnceLock<Box<CrossTable>>; 2]; 2],
    flights: [OnceLock<Box<ForcedFlight>>; 2],
}

impl Kernel {
    /// Flow over a level.
    #[inline(always)]
    pub(super) fn flow(&self, level: i32) -> &Flow {
        let make = || Flow::over(&self.plant.diagonal.block, &self.layout, Self::length_s(level));
        self.levels[Self::index(level)].flow.get_or_init(make)
    }

    /// A time cut into levels, longest first, until `|lambda| t` of what rests, s, is [`SHORT`]: their flows, and the rest.
    #[inline(always)]
    pub(super) fn flows_within(&self, time_s: f64) -> (SmallVec<[&Flow; 32]>, f64) {
        let (mut flows, mut rest_s) = (SmallVec::new(), time_s);
        while rest_s * self.stiffest_rad_s > SHORT {
            let level = Self::level_within(rest_s);
            flows.push(self.flow(level));
            rest_s -= Self::length_s(level);
        }
        (flows, rest_s)
    }

    /// Flight table of a level for a port.
    #[inline(always)]
    pub(super) fn flight(&self, port: usize, level: i32) -> &FlightTable {
        let make = || FlightTable::new(&self.plant.diagonal.block, &self.layout, &self.plant.ports[port], Self::length_s(level));
        self.levels[Self::index(level)].ports[port].flight.get_or_init(make)
    }

    /// Contact table of a level for a port.
    #[inline(always)]
    pub(super) fn table(&self, port: usize, shape: Shape, level: i32) -> &Table {
        let tables = &self.levels[Self::index(level)].ports[port];
        let slot = if shape == Shape::Smooth { &tables.smooth } else { &tables.onset };
        slot.get_or_init(|| Box::new(Table::new(self, port, self.basis(port, shape), Self::length_s(level))))
    }

    /// What each block answers inside a step of a level to the force of a port.
    pub(super) fn answers(&self, port: usize, shape: Shape, level: i32) -> &[Answers] {
        let make = || Answers::of_all(&self.plant.diagonal.block, self.basis(port, shape), Self::length_s(level));
        self.levels[Self::index(level)].ports[port].answers[shape.index()].get_or_init(make)
    }

    /// What rest of a port on its stop needs on a step of a level.
    pub(super) fn sticking(&self, port: usize, level: i32) -> &Sticking {
        let slot = &self.levels[Self::index(level)].ports[port].sticking;
        slot.get_or_init(|| Box::new(Sticking::new(self, port, &SMOOTH, Self::length_s(level))))
    }

    /// What the force of the first port does to the second on a level.
    pub(super) fn cross(&self, [port, seen]: [(usize, Shape); 2], level: i32) -> &CrossTable {
        let tables = &self.levels[Self::index(level)].ports[port.0].seen[seen.0];
        let slot = &tables.crosses[port.1.index()][seen.1.index()];
        slot.get_or_init(|| Box::new(CrossTable::new(self, [port, seen], Self::length_s(level))))
    }

    /// What the force of a port does to the flight of another on a level.
    pub(super) fn forced_flight(&self, port: (usize, Shape), seen: usize, level: i32) -> &ForcedFlight {
        let slot = &self.levels[Self::index(level)].ports[port.0].seen[seen].flights[port.1.index()];
        slot.get_or_init(|| Box::new(ForcedFlight::new(self, port, seen, Self::length_s(level))))
    }

    /// Basis of the force of a port.
    pub(super) fn basis(&self, port: usize, shape: Shape) -> &Basis {
        match (shape, &self.onset[port]) {
            (Shape::Onset, Some(basis)) => basis,
            _ => &SMOOTH,
        }
    }

    /// The basis in which a contact of a port starts.
    #[inline(always)]
    pub(super) fn first_shape(&self, port: usize) -> Shape {
        if self.onset[port].is_some() { Shape::Onset } else { Shape::Smooth }
    }
}

/// Places for the tables of every length.
pub fn levels(plant: &Plant) -> Vec<Level> {
    let count = plant.ports.len();
    let others = if count > 1 { count } else { 0 };
    let port = |_| PortLevel { seen: (0..others).map(|_| SeenLevel::default()).collect(), ..PortLevel::default() };
    let level = |_| Level { flow: OnceLock::new(), ports: (0..count).map(port).collect() };
    (Kernel::coarsest()..=Kernel::finest()).map(level).collect()
}
