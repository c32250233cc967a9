//! Tables of a kernel, one set for each step length, computed at the first use.

use super::contact::{ContactTable, StickingTable};
use super::cross::CrossTable;
use crate::flight::forced::ForcedFlight;
use crate::flight::table::FlightTable;
use crate::flow::{Flow, MAX_SERIES_ARGUMENT};
use crate::force_response::basis::{BasisFunctions, SMOOTH_BASIS};
use crate::force_response::step_response::StepResponse;
use crate::kernel::{ForceBasis, Kernel};
use jounce_model::plant::Plant;
use smallvec::SmallVec;
use std::sync::OnceLock;

/// Tables of one step length.
#[derive(Debug)]
pub struct StepTables {
    flow: OnceLock<Flow>,
    ports: Vec<PortTables>,
}

#[derive(Debug, Default)]
struct PortTables {
    flight: OnceLock<FlightTable>,
    smooth: OnceLock<Box<ContactTable>>,
    onset: OnceLock<Box<ContactTable>>,
    sticking: OnceLock<Box<StickingTable>>,
    /// For each basis, the responses of the blocks inside the step.
    responses: [OnceLock<Vec<StepResponse>>; 2],
    /// Effect of the force on each port; empty for a single port.
    cross_ports: Vec<CrossPortTables>,
}

/// Effect of the force of one port on another, per basis of the force and of the other port, each
/// smooth or onset.
#[derive(Debug, Default)]
struct CrossPortTables {
    crosses: [[OnceLock<Box<CrossTable>>; 2]; 2],
    flights: [OnceLock<Box<ForcedFlight>>; 2],
}

impl Kernel {
    /// Returns the flow over a level.
    #[inline(always)]
    pub(crate) fn flow(&self, level: i32) -> &Flow {
        let make = || {
            Flow::over(
                &self.plant.diagonal.block,
                &self.layout,
                Self::length_s(level),
            )
        };
        self.levels[Self::index(level)].flow.get_or_init(make)
    }

    /// Splits a time into levels, longest first, until `|lambda| t` of the remainder, s, is
    /// [`MAX_SERIES_ARGUMENT`]; returns their flows and the remainder.
    #[inline(always)]
    pub(crate) fn flows_within(&self, time_s: f64) -> (SmallVec<[&Flow; 32]>, f64) {
        let (mut flows, mut rest_s) = (SmallVec::new(), time_s);
        while rest_s * self.stiffest_rad_s > MAX_SERIES_ARGUMENT {
            let level = Self::level_within(rest_s);
            flows.push(self.flow(level));
            rest_s -= Self::length_s(level);
        }
        (flows, rest_s)
    }

    /// Returns the flight table of a level for a port.
    #[inline(always)]
    pub(crate) fn flight(&self, port: usize, level: i32) -> &FlightTable {
        let make = || {
            FlightTable::new(
                &self.plant.diagonal.block,
                &self.layout,
                &self.plant.ports[port],
                Self::length_s(level),
            )
        };
        self.levels[Self::index(level)].ports[port]
            .flight
            .get_or_init(make)
    }

    /// Returns the contact table of a level for a port.
    #[inline(always)]
    pub(crate) fn table(&self, port: usize, shape: ForceBasis, level: i32) -> &ContactTable {
        let tables = &self.levels[Self::index(level)].ports[port];
        let slot = if shape == ForceBasis::Smooth {
            &tables.smooth
        } else {
            &tables.onset
        };
        slot.get_or_init(|| {
            Box::new(ContactTable::new(
                self,
                port,
                self.basis(port, shape),
                Self::length_s(level),
            ))
        })
    }

    /// Returns the responses of the blocks to the force of a port inside a step of a level.
    pub(crate) fn responses(&self, port: usize, shape: ForceBasis, level: i32) -> &[StepResponse] {
        let make = || {
            StepResponse::of_all(
                &self.plant.diagonal.block,
                self.basis(port, shape),
                Self::length_s(level),
            )
        };
        self.levels[Self::index(level)].ports[port].responses[shape.index()].get_or_init(make)
    }

    /// Returns the tables of sticking for a port on a step of a level.
    pub(crate) fn sticking(&self, port: usize, level: i32) -> &StickingTable {
        let slot = &self.levels[Self::index(level)].ports[port].sticking;
        slot.get_or_init(|| {
            Box::new(StickingTable::new(
                self,
                port,
                &SMOOTH_BASIS,
                Self::length_s(level),
            ))
        })
    }

    /// Returns the effect of the force of the first port on the second on a level.
    pub(crate) fn cross(
        &self,
        [port, other_port]: [(usize, ForceBasis); 2],
        level: i32,
    ) -> &CrossTable {
        let tables = &self.levels[Self::index(level)].ports[port.0].cross_ports[other_port.0];
        let slot = &tables.crosses[port.1.index()][other_port.1.index()];
        slot.get_or_init(|| {
            Box::new(CrossTable::new(
                self,
                [port, other_port],
                Self::length_s(level),
            ))
        })
    }

    /// Returns the effect of the force of a port on the flight of another on a level.
    pub(crate) fn forced_flight(
        &self,
        port: (usize, ForceBasis),
        other_port: usize,
        level: i32,
    ) -> &ForcedFlight {
        let slot = &self.levels[Self::index(level)].ports[port.0].cross_ports[other_port].flights
            [port.1.index()];
        slot.get_or_init(|| {
            Box::new(ForcedFlight::new(
                self,
                port,
                other_port,
                Self::length_s(level),
            ))
        })
    }

    /// Returns the basis of the force of a port.
    pub(crate) fn basis(&self, port: usize, shape: ForceBasis) -> &BasisFunctions {
        match (shape, &self.onset[port]) {
            (ForceBasis::Onset, Some(basis)) => basis,
            _ => &SMOOTH_BASIS,
        }
    }

    /// Returns the basis of the next step of a port: the first step of a contact, or a later one.
    #[inline(always)]
    pub(crate) fn shape(&self, port: usize, is_first: bool) -> ForceBasis {
        if is_first && self.onset[port].is_some() {
            ForceBasis::Onset
        } else {
            ForceBasis::Smooth
        }
    }
}

/// Creates empty tables for every length.
pub fn levels(plant: &Plant) -> Vec<StepTables> {
    let count = plant.ports.len();
    let others = if count > 1 { count } else { 0 };
    let port = |_| PortTables {
        cross_ports: (0..others).map(|_| CrossPortTables::default()).collect(),
        ..PortTables::default()
    };
    let level = |_| StepTables {
        flow: OnceLock::new(),
        ports: (0..count).map(port).collect(),
    };
    (Kernel::coarsest()..=Kernel::finest()).map(level).collect()
}
