//! Tables of one step length, each computed at the first use.

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
    /// Length, s.
    pub length_s: f64,
    flow: OnceLock<Flow>,
    ports: Vec<PortTables>,
}

#[derive(Debug, Default)]
struct PortTables {
    flight: OnceLock<FlightTable>,
    /// For each basis.
    contacts: [OnceLock<Box<ContactTable>>; 2],
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

impl StepTables {
    /// Creates empty tables of a length for a number of ports.
    pub fn new(ports: usize, length_s: f64) -> Self {
        let others = if ports > 1 { ports } else { 0 };
        let port = |_| PortTables {
            cross_ports: (0..others).map(|_| CrossPortTables::default()).collect(),
            ..PortTables::default()
        };
        Self {
            length_s,
            flow: OnceLock::new(),
            ports: (0..ports).map(port).collect(),
        }
    }

    /// Returns the flow.
    #[inline(always)]
    pub fn flow(&self, kernel: &Kernel) -> &Flow {
        let block = &kernel.plant.diagonal.block;
        self.flow
            .get_or_init(|| Flow::over(block, &kernel.layout, self.length_s))
    }

    /// Returns the flight table of a port.
    #[inline(always)]
    pub fn flight(&self, kernel: &Kernel, port: usize) -> &FlightTable {
        let plant = &kernel.plant;
        self.ports[port].flight.get_or_init(|| {
            FlightTable::new(
                &plant.diagonal.block,
                &kernel.layout,
                &plant.ports[port],
                self.length_s,
            )
        })
    }

    /// Returns the contact table of a port.
    #[inline(always)]
    pub fn contact(&self, kernel: &Kernel, (port, shape): (usize, ForceBasis)) -> &ContactTable {
        self.ports[port].contacts[shape.index()].get_or_init(|| {
            Box::new(ContactTable::new(
                kernel,
                port,
                kernel.basis(port, shape),
                self.length_s,
            ))
        })
    }

    /// Returns the responses of the blocks to the force of a port inside the step.
    pub fn responses(
        &self,
        kernel: &Kernel,
        (port, shape): (usize, ForceBasis),
    ) -> &[StepResponse] {
        self.ports[port].responses[shape.index()].get_or_init(|| {
            StepResponse::of_all(
                &kernel.plant.diagonal.block,
                kernel.basis(port, shape),
                self.length_s,
            )
        })
    }

    /// Returns the tables of sticking of a port.
    pub fn sticking(&self, kernel: &Kernel, port: usize) -> &StickingTable {
        self.ports[port].sticking.get_or_init(|| {
            Box::new(StickingTable::new(
                kernel,
                port,
                &SMOOTH_BASIS,
                self.length_s,
            ))
        })
    }

    /// Returns the effect of the force of the first port on the second.
    pub fn cross(
        &self,
        kernel: &Kernel,
        [port, other_port]: [(usize, ForceBasis); 2],
    ) -> &CrossTable {
        let tables = &self.ports[port.0].cross_ports[other_port.0];
        tables.crosses[port.1.index()][other_port.1.index()]
            .get_or_init(|| Box::new(CrossTable::new(kernel, [port, other_port], self.length_s)))
    }

    /// Returns the effect of the force of a port on the flight of another.
    pub fn forced_flight(
        &self,
        kernel: &Kernel,
        port: (usize, ForceBasis),
        other_port: usize,
    ) -> &ForcedFlight {
        let tables = &self.ports[port.0].cross_ports[other_port];
        tables.flights[port.1.index()]
            .get_or_init(|| Box::new(ForcedFlight::new(kernel, port, other_port, self.length_s)))
    }
}

impl Kernel {
    /// Returns the tables of a level.
    #[inline(always)]
    pub(crate) fn tables(&self, level: i32) -> &StepTables {
        &self.levels[Self::index(level)]
    }

    /// Splits a time into levels, longest first, until `|lambda| t` of the remainder, s, is
    /// [`MAX_SERIES_ARGUMENT`]; returns their flows and the remainder.
    #[inline(always)]
    pub(crate) fn flows_within(&self, time_s: f64) -> (SmallVec<[&Flow; 32]>, f64) {
        let (mut flows, mut rest_s) = (SmallVec::new(), time_s);
        while rest_s * self.stiffest_rad_s > MAX_SERIES_ARGUMENT {
            let level = Self::level_within(rest_s);
            flows.push(self.tables(level).flow(self));
            rest_s -= Self::length_s(level);
        }
        (flows, rest_s)
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

/// Creates empty tables for every level.
pub fn levels(plant: &Plant) -> Vec<StepTables> {
    (Kernel::coarsest()..=Kernel::finest())
        .map(|level| StepTables::new(plant.ports.len(), Kernel::length_s(level)))
        .collect()
}
