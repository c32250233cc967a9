//! A plant laid out for marching, and the tables of its step lengths, each made when first used.
//!
//! Steps have the lengths of [`super::level`], so that tables are shared by all runs of a plant, whatever its drive.

use super::answers::Answers;
use super::basis::{Basis, SMOOTH};
use super::cross_table::CrossTable;
use super::flight_table::FlightTable;
use super::flow::Flow;
use super::forced_flight::ForcedFlight;
use super::layout::Layout;
use super::table::{Sticking, Table};
use super::watch::Watch;
use crate::contact::Law;
use crate::plant::{BridgeState, Change, Meters, Plant, PlantError, Signal, Stop};
use crate::wide::WIDTH;
use std::sync::{Arc, OnceLock};

/// The basis of the force on a contact step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Shape {
    /// Inside a contact.
    Smooth,
    /// The first step of a contact.
    Onset,
}

impl Shape {
    /// Place in lists of both.
    pub(super) fn index(self) -> usize {
        usize::from(self == Shape::Onset)
    }
}

/// A plant with its step tables.
#[derive(Debug)]
pub struct Kernel {
    /// The plant.
    pub plant: Plant,
    /// Its energy meters.
    pub meters: Meters,
    /// Where its states stand in lanes.
    pub(super) layout: Layout,
    /// `A` in lanes.
    pub(super) generator: Flow,
    /// Largest `|eigenvalue|` of what steps resolve, rad/s.
    pub(super) fastest_rad_s: f64,
    /// Largest `|eigenvalue|` of all, rad/s.
    pub(super) stiffest_rad_s: f64,
    /// Who watches the marches of this kernel.
    pub watch: Watch,
    /// Per port: the basis of the first step of a contact, where it is not smooth.
    onset: Arc<Vec<Option<Basis>>>,
    /// They depend on the plant without its drives only, so that plants that differ in drives share them.
    levels: Arc<Vec<Level>>,
    /// The same plant in each other regime of its bridges, made when first entered; the first stays empty.
    regimes: Regimes,
    /// Those of the plant from which this one came by a change of drives or stops, whose tables they share.
    kin: Regimes,
}

type Regimes = Arc<Vec<OnceLock<Result<Kernel, PlantError>>>>;

/// The tables of one step length.
#[derive(Debug)]
struct Level {
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
    /// Prepares a plant for marching.
    ///
    /// # Errors
    /// [`PlantError::Undamped`].
    pub fn new(plant: Plant) -> Result<Self, PlantError> {
        let meters = Meters::new(&plant)?;
        let layout = Layout::of(&plant);
        Ok(Self {
            layout,
            generator: Flow::generator(&plant.diagonal.block, &layout),
            fastest_rad_s: plant.diagonal.block.fastest_resolved_rad_s().max(f64::MIN_POSITIVE),
            stiffest_rad_s: plant.fastest_rad_s().max(f64::MIN_POSITIVE),
            onset: Arc::new(onsets(&plant)),
            levels: Arc::new(levels(&plant)),
            regimes: regimes(&plant),
            kin: regimes(&plant),
            watch: Watch::default(),
            meters,
            plant,
        })
    }

    /// The same, its marches watched: they end with [`super::MarchError::Stopped`] when the watch says so.
    #[must_use]
    pub fn watched_by(self, watch: &Watch) -> Self {
        Self { watch: watch.clone(), regimes: regimes(&self.plant), ..self }
    }

    /// The same plant under other drives, the tables made so far kept.
    ///
    /// # Errors
    /// [`PlantError::UndampedResonance`].
    pub fn with_drives(&self, drives: Vec<crate::plant::Drive>) -> Result<Self, PlantError> {
        self.with_plant(self.plant.with_drives(drives)?)
    }

    /// The same plant under other signals, the tables made so far kept.
    ///
    /// # Errors
    /// None that the first plant did not have.
    pub fn with_signals(&self, signals: Vec<Signal>) -> Result<Self, PlantError> {
        self.with_plant(self.plant.with_signals(signals))
    }

    /// A plant that differs in its drives and signals only.
    fn with_plant(&self, plant: Plant) -> Result<Self, PlantError> {
        Ok(Self {
            meters: self.meters.with_drives(&plant)?,
            regimes: regimes(&plant),
            kin: Arc::clone(&self.kin),
            plant,
            layout: self.layout,
            generator: self.generator.clone(),
            fastest_rad_s: self.fastest_rad_s,
            stiffest_rad_s: self.stiffest_rad_s,
            onset: Arc::clone(&self.onset),
            levels: Arc::clone(&self.levels),
            watch: self.watch.clone(),
        })
    }

    /// The same plant against other stops; the tables made so far are kept where only gaps and stiffnesses differ.
    ///
    /// # Errors
    /// None that the first plant did not have.
    pub fn with_stops(&self, stops: Vec<Stop>) -> Result<Self, PlantError> {
        let alike = |a: &Stop, b: &Stop| a.shape == b.shape && onset_exponent(&a.law) == onset_exponent(&b.law);
        let before = &self.plant.system.stops;
        let fit = before.len() == stops.len() && before.iter().zip(&stops).all(|(a, b)| alike(a, b));
        let plant = self.plant.with_stops(stops);
        Ok(Self {
            layout: self.layout,
            generator: self.generator.clone(),
            fastest_rad_s: self.fastest_rad_s,
            stiffest_rad_s: self.stiffest_rad_s,
            meters: if fit { self.meters.clone() } else { self.meters.with_drives(&plant)? },
            onset: if fit { Arc::clone(&self.onset) } else { Arc::new(onsets(&plant)) },
            levels: if fit { Arc::clone(&self.levels) } else { Arc::new(levels(&plant)) },
            regimes: regimes(&plant),
            kin: Arc::clone(&self.kin),
            watch: self.watch.clone(),
            plant,
        })
    }

    /// The plant in a regime of its bridges.
    ///
    /// # Errors
    /// Those of [`Plant::new`] and [`Kernel::new`].
    pub fn in_regime(&self, regime: usize) -> Result<&Self, PlantError> {
        if regime == 0 {
            return Ok(self);
        }
        let make = || {
            let system = self.plant.system.in_regime(regime);
            let first = self.kin[regime].get_or_init(|| Self::new(Plant::new(system.clone())?)).as_ref().map_err(Clone::clone)?;
            let own = first.with_stops(system.stops)?.with_drives(system.drives)?.with_signals(system.signals)?;
            Ok(own.watched_by(&self.watch))
        };
        self.regimes[regime].get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// Rate of change of what one port sees per unit force of another, 1/kg of a velocity; 0 for displacements.
    pub(super) fn directly(&self, port: usize, seen: usize) -> f64 {
        let plant = &self.plant;
        match plant.guards.get(seen.wrapping_sub(plant.system.stops.len())) {
            Some(guard) if guard.change == Change::Switches => {
                plant.ports[seen].displacement.iter().zip(&plant.ports[port].force).map(|(row, b)| row * b).sum()
            }
            _ => 0.0,
        }
    }

    /// Row of the relative acceleration of a port, the contact forces left out: `(A^T c_v)`.
    pub fn acceleration_row(&self, port: usize) -> Vec<f64> {
        self.plant.diagonal.block.rate_row(&self.plant.ports[port].velocity)
    }

    /// Flow over a level.
    #[inline(always)]
    pub(super) fn flow(&self, level: i32) -> &Flow {
        let make = || Flow::over(&self.plant.diagonal.block, &self.layout, Self::length_s(level));
        self.levels[Self::index(level)].flow.get_or_init(make)
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

/// Places for all regimes of a plant whose bridges are blocked.
fn regimes(plant: &Plant) -> Regimes {
    let is_first = plant.system.bridges.iter().all(|bridge| bridge.state == BridgeState::default());
    let count = if is_first && !plant.system.bridges.is_empty() { plant.system.regimes() } else { 0 };
    Arc::new((0..count).map(|_| OnceLock::new()).collect())
}

fn levels(plant: &Plant) -> Vec<Level> {
    let count = plant.ports.len();
    let others = if count > 1 { count } else { 0 };
    let port = |_| PortLevel { seen: (0..others).map(|_| SeenLevel::default()).collect(), ..PortLevel::default() };
    let level = |_| Level { flow: OnceLock::new(), ports: (0..count).map(port).collect() };
    (Kernel::coarsest()..=Kernel::finest()).map(level).collect()
}

fn onsets(plant: &Plant) -> Vec<Option<Basis>> {
    plant.system.stops.iter().map(|stop| onset_exponent(&stop.law).and_then(Basis::onset)).collect()
}

/// Power of time with which the force of a contact starts.
fn onset_exponent(law: &Law) -> Option<f64> {
    match law {
        Law::Hertz(law) => Some(law.exponent),
        Law::HuntCrossley(law) => Some(law.elastic.exponent),
        Law::KelvinVoigt(_) | Law::Cubic(_) | Law::Rigid(_) => None,
    }
}

/// Lanes of a state are padded, and so is the step: seven nodes and its end.
const _: () = assert!(WIDTH == super::basis::NODES + 1);
