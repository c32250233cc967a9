//! A plant laid out for marching.
//!
//! Steps have the lengths of [`super::step_size`], so that their tables are shared by all runs of a plant, whatever its drive.

use super::basis::BasisFunctions;
use super::control::Control;
use super::flow::Flow;
use super::layout::StateLayout;
use super::port_vectors::PortVectors;
use super::table_cache::{StepTables, levels};
use crate::contact::Law;
use crate::plant::{
    BridgeChange, BridgeState, Meters, Plant, PlantError, Quadratics, Signal, Stop,
};
use crate::simd::LANES;
use std::sync::{Arc, OnceLock};

/// The basis of the force on a contact step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ForceBasis {
    /// Inside a contact.
    Smooth,
    /// The first step of a contact.
    Onset,
}

impl ForceBasis {
    /// Place in lists of both.
    pub(super) fn index(self) -> usize {
        usize::from(self == ForceBasis::Onset)
    }
}

/// A plant with its step tables.
#[derive(Debug)]
pub struct Kernel {
    /// The plant.
    pub plant: Plant,
    /// What its energy meters make of states, ...
    quadratics: Arc<Quadratics>,
    /// ... and the meters under its drives, made when first asked for.
    meters: OnceLock<Meters>,
    /// Where its states stand in lanes.
    pub(super) layout: StateLayout,
    /// `A` in lanes.
    pub(super) generator: Flow,
    /// Largest `|eigenvalue|` of what steps resolve, rad/s.
    pub(super) fastest_rad_s: f64,
    /// Largest `|eigenvalue|` of all, rad/s.
    pub(super) stiffest_rad_s: f64,
    /// Who watches the marches of this kernel.
    pub control: Control,
    /// Per port: what its force pushes and what its work is metered by.
    pub(super) vectors: Arc<Vec<PortVectors>>,
    /// Per port: the basis of the first step of a contact, where it is not smooth.
    pub(super) onset: Arc<Vec<Option<BasisFunctions>>>,
    /// They depend on the plant without its drives only, so that plants that differ in drives share them.
    pub(super) levels: Arc<Vec<StepTables>>,
    /// The same plant in each other regime of its bridges, made when first entered; the first stays empty.
    regimes: Regimes,
    /// Those of the plant from which this one came by a change of drives or stops, whose tables they share.
    kin: Regimes,
}

type Regimes = Arc<Vec<OnceLock<Result<Kernel, PlantError>>>>;

impl Kernel {
    /// Prepares a plant for marching.
    ///
    /// # Errors
    /// [`PlantError::Undamped`].
    pub fn new(plant: Plant) -> Result<Self, PlantError> {
        let quadratics = Arc::new(Quadratics::of(&plant)?);
        let meters = Meters::under(&quadratics, &plant);
        let layout = StateLayout::of(&plant);
        Ok(Self {
            layout,
            generator: Flow::generator(&plant.diagonal.block, &layout),
            fastest_rad_s: plant
                .diagonal
                .block
                .fastest_resolved_rad_s()
                .max(f64::MIN_POSITIVE),
            stiffest_rad_s: plant.fastest_rad_s().max(f64::MIN_POSITIVE),
            vectors: Arc::new(PortVectors::of_all(&plant, &meters, &layout)),
            onset: Arc::new(onsets(&plant)),
            levels: Arc::new(levels(&plant)),
            regimes: regimes(&plant),
            kin: regimes(&plant),
            control: Control::default(),
            quadratics,
            meters: OnceLock::from(meters),
            plant,
        })
    }

    /// The same, its marches watched: they end with [`super::IntegrationError::Stopped`] when the control says so.
    #[must_use]
    pub fn with_control(self, control: &Control) -> Self {
        Self {
            control: control.clone(),
            regimes: regimes(&self.plant),
            ..self
        }
    }

    /// The same plant under other drives, the tables made so far kept.
    ///
    /// # Errors
    /// [`PlantError::UndampedResonance`].
    pub fn with_drives(&self, drives: Vec<crate::plant::Drive>) -> Result<Self, PlantError> {
        Ok(self.with_plant(self.plant.with_drives(drives)?))
    }

    /// The same plant under other signals, the tables made so far kept.
    pub fn with_signals(&self, signals: Vec<Signal>) -> Self {
        self.with_plant(self.plant.with_signals(signals))
    }

    /// A plant that differs in its drives and signals only.
    fn with_plant(&self, plant: Plant) -> Self {
        Self {
            quadratics: Arc::clone(&self.quadratics),
            meters: OnceLock::new(),
            regimes: regimes(&plant),
            kin: Arc::clone(&self.kin),
            plant,
            layout: self.layout,
            generator: self.generator.clone(),
            fastest_rad_s: self.fastest_rad_s,
            stiffest_rad_s: self.stiffest_rad_s,
            vectors: Arc::clone(&self.vectors),
            onset: Arc::clone(&self.onset),
            levels: Arc::clone(&self.levels),
            control: self.control.clone(),
        }
    }

    /// The same plant against other stops; the tables made so far are kept where only gaps and stiffnesses differ.
    pub fn with_stops(&self, stops: Vec<Stop>) -> Self {
        let alike = |a: &Stop, b: &Stop| {
            a.shape == b.shape
                && a.bases == b.bases
                && onset_exponent(&a.law) == onset_exponent(&b.law)
        };
        let before = &self.plant.system.stops;
        let fit =
            before.len() == stops.len() && before.iter().zip(&stops).all(|(a, b)| alike(a, b));
        let plant = self.plant.with_stops(stops);
        let meters = if fit {
            self.meters.clone()
        } else {
            OnceLock::from(Meters::under(&self.quadratics, &plant))
        };
        let vectors = match meters.get() {
            Some(meters) if !fit => Arc::new(PortVectors::of_all(&plant, meters, &self.layout)),
            _ => Arc::clone(&self.vectors),
        };
        Self {
            vectors,
            layout: self.layout,
            generator: self.generator.clone(),
            fastest_rad_s: self.fastest_rad_s,
            stiffest_rad_s: self.stiffest_rad_s,
            quadratics: Arc::clone(&self.quadratics),
            meters,
            onset: if fit {
                Arc::clone(&self.onset)
            } else {
                Arc::new(onsets(&plant))
            },
            levels: if fit {
                Arc::clone(&self.levels)
            } else {
                Arc::new(levels(&plant))
            },
            regimes: regimes(&plant),
            kin: Arc::clone(&self.kin),
            control: self.control.clone(),
            plant,
        }
    }

    /// The energy meters.
    pub fn meters(&self) -> &Meters {
        self.meters
            .get_or_init(|| Meters::under(&self.quadratics, &self.plant))
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
            let first = self.kin[regime]
                .get_or_init(|| Self::new(Plant::new(system.clone())?))
                .as_ref()
                .map_err(Clone::clone)?;
            let own = first
                .with_stops(system.stops)
                .with_drives(system.drives)?
                .with_signals(system.signals);
            Ok(own.with_control(&self.control))
        };
        self.regimes[regime]
            .get_or_init(make)
            .as_ref()
            .map_err(Clone::clone)
    }

    /// Rate of change of what one port sees per unit force of another, 1/kg of a velocity; 0 for displacements.
    pub(super) fn directly(&self, port: usize, seen: usize) -> f64 {
        let plant = &self.plant;
        match plant
            .guards
            .get(seen.wrapping_sub(plant.system.stops.len()))
        {
            Some(guard) if guard.change == BridgeChange::Switches => plant.ports[seen]
                .displacement
                .iter()
                .zip(&plant.ports[port].force)
                .map(|(row, b)| row * b)
                .sum(),
            _ => 0.0,
        }
    }

    /// Row of the relative acceleration of a port, the contact forces left out: `(A^T c_v)`.
    pub fn acceleration_row(&self, port: usize) -> Vec<f64> {
        self.plant
            .diagonal
            .block
            .rate_row(&self.plant.ports[port].velocity)
    }
}

/// Places for all regimes of a plant whose bridges are blocked.
fn regimes(plant: &Plant) -> Regimes {
    let is_first = plant
        .system
        .bridges
        .iter()
        .all(|bridge| bridge.state == BridgeState::default());
    let count = if is_first && !plant.system.bridges.is_empty() {
        plant.system.regimes()
    } else {
        0
    };
    Arc::new((0..count).map(|_| OnceLock::new()).collect())
}

fn onsets(plant: &Plant) -> Vec<Option<BasisFunctions>> {
    plant
        .system
        .stops
        .iter()
        .map(|stop| onset_exponent(&stop.law).and_then(BasisFunctions::onset))
        .collect()
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
const _: () = assert!(LANES == super::basis::NODES + 1);
