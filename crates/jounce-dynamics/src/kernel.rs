//! Plant prepared for integration.
//!
//! Steps have the lengths of [`crate::tables::step_size`], so that all runs of a plant share their
//! tables, whatever the drive.

use crate::excitation::tables::ExcitationTables;
use crate::flow::Flow;
use crate::flow::layout::StateLayout;
use crate::force_response::basis::BasisFunctions;
use crate::ports::per_port::PerPort;
use crate::ports::phasor::Phasor;
use crate::ports::state::PortRows;
use crate::ports::vectors::PortVectors;
use crate::tables::step_tables::{StepTables, levels};
use jounce_control::Control;
use jounce_model::contact::Law;
use jounce_model::plant::{
    BridgeChange, BridgeState, Meters, Plant, PlantError, Quadratics, Signal, Stop,
};
use jounce_simd::LANES;
use std::sync::{Arc, OnceLock};

/// Basis of the force on a contact step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ForceBasis {
    /// Inside a contact.
    Smooth,
    /// Basis of the first step of a contact.
    Onset,
}

impl ForceBasis {
    /// Returns the index in lists of both bases.
    pub(super) fn index(self) -> usize {
        usize::from(self == ForceBasis::Onset)
    }
}

/// Plant with its step tables.
#[derive(Debug)]
pub struct Kernel {
    /// Plant.
    pub plant: Plant,
    /// Quadratic forms of the energy meters.
    quadratics: Arc<Quadratics>,
    /// Energy meters under the drives, computed at the first use.
    meters: OnceLock<Meters>,
    /// Rows and flows under the signals, computed at the first use.
    excitation: OnceLock<Arc<ExcitationTables>>,
    /// Rows of each port, and one where there is no port, computed at the first use.
    rows: OnceLock<PerPort<Arc<PortRows>>>,
    /// Layout of the state in SIMD vectors.
    pub(super) layout: StateLayout,
    /// `A` in SIMD vectors.
    pub(super) generator: Flow,
    /// Largest `|eigenvalue|` that steps resolve, rad/s.
    pub(super) fastest_rad_s: f64,
    /// Largest `|eigenvalue|`, rad/s.
    pub(super) stiffest_rad_s: f64,
    /// Control of the integrations of this kernel.
    pub control: Control,
    /// Vectors of each port for its force and the meters of its work.
    pub(super) vectors: Arc<Vec<PortVectors>>,
    /// For each port, the basis of the first step of a contact, where it is not smooth.
    pub(super) onset: Arc<Vec<Option<BasisFunctions>>>,
    /// Step tables. They depend only on the plant without its drives, so that plants with other
    /// drives share them.
    pub(super) levels: Arc<Vec<StepTables>>,
    /// Kernels in the other conduction states of the bridges, built when first entered; the first
    /// entry stays empty.
    state_kernels: StateKernels,
    /// Conduction states of the kernel from which this one was derived by a change of drives or
    /// stops; their tables are shared.
    kin: StateKernels,
}

type StateKernels = Arc<Vec<OnceLock<Result<Kernel, PlantError>>>>;

impl Kernel {
    /// Prepares a plant for integration.
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
            state_kernels: empty_kernels(&plant),
            kin: empty_kernels(&plant),
            control: Control::default(),
            quadratics,
            meters: OnceLock::from(meters),
            excitation: OnceLock::new(),
            rows: OnceLock::new(),
            plant,
        })
    }

    /// Returns this kernel under a control: its integrations end with
    /// [`super::IntegrationError::Stopped`] after a stop request.
    #[must_use]
    pub fn with_control(self, control: &Control) -> Self {
        Self {
            control: control.clone(),
            state_kernels: empty_kernels(&self.plant),
            ..self
        }
    }

    /// Returns this kernel under other drives, with the existing tables.
    ///
    /// # Errors
    /// [`PlantError::UndampedResonance`].
    pub fn with_drives(&self, drives: Vec<jounce_model::plant::Drive>) -> Result<Self, PlantError> {
        Ok(self.with_plant(self.plant.with_drives(drives)?))
    }

    /// Returns this kernel under other signals, with the existing tables.
    pub fn with_signals(&self, signals: Vec<Signal>) -> Self {
        self.with_plant(self.plant.with_signals(signals))
    }

    /// Returns the kernel of a plant that differs in its drives and signals only.
    fn with_plant(&self, plant: Plant) -> Self {
        Self {
            quadratics: Arc::clone(&self.quadratics),
            meters: OnceLock::new(),
            excitation: OnceLock::new(),
            rows: OnceLock::new(),
            state_kernels: empty_kernels(&plant),
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

    /// Returns this kernel with other stops; the existing tables are retained where only gaps and
    /// stiffnesses differ.
    pub fn with_stops(&self, stops: Vec<Stop>) -> Self {
        let is_same_kind = |a: &Stop, b: &Stop| {
            a.shape == b.shape
                && a.bases == b.bases
                && onset_exponent(&a.law) == onset_exponent(&b.law)
        };
        let before = &self.plant.system.stops;
        let fit = before.len() == stops.len()
            && before.iter().zip(&stops).all(|(a, b)| is_same_kind(a, b));
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
            excitation: OnceLock::new(),
            rows: OnceLock::new(),
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
            state_kernels: empty_kernels(&plant),
            kin: Arc::clone(&self.kin),
            control: self.control.clone(),
            plant,
        }
    }

    /// Returns the energy meters.
    pub fn meters(&self) -> &Meters {
        self.meters
            .get_or_init(|| Meters::under(&self.quadratics, &self.plant))
    }

    /// Returns the rows of each port.
    pub(crate) fn port_rows(&self) -> &PerPort<Arc<PortRows>> {
        self.rows.get_or_init(|| {
            let plant = &self.plant;
            let tones = Phasor::of_all(plant, 0.0);
            let rows = |port| Arc::new(PortRows::new(plant, &self.layout, &tones, port));
            PerPort::new(plant.ports.len(), rows)
        })
    }

    /// Returns the rows and flows under the signals.
    pub(crate) fn excitation_tables(&self) -> Arc<ExcitationTables> {
        let tables = || Arc::new(ExcitationTables::of(self));
        Arc::clone(self.excitation.get_or_init(tables))
    }

    /// Returns the kernel in a conduction state of its bridges.
    ///
    /// # Errors
    /// Errors of [`Plant::new`] and [`Kernel::new`].
    pub fn in_conduction_state(&self, conduction_state: usize) -> Result<&Self, PlantError> {
        if conduction_state == 0 {
            return Ok(self);
        }
        let make = || {
            let system = self.plant.system.in_conduction_state(conduction_state);
            let first = self.kin[conduction_state]
                .get_or_init(|| Self::new(Plant::new(system.clone())?))
                .as_ref()
                .map_err(Clone::clone)?;
            let base = first
                .with_stops(system.stops)
                .with_drives(system.drives)?
                .with_signals(system.signals);
            Ok(base.with_control(&self.control))
        };
        self.state_kernels[conduction_state]
            .get_or_init(make)
            .as_ref()
            .map_err(Clone::clone)
    }

    /// Returns the direct rate of change of an output of one port per unit force of another, 1/kg
    /// for a velocity; 0 for displacements.
    pub(super) fn direct_gain(&self, port: usize, other_port: usize) -> f64 {
        let plant = &self.plant;
        match plant
            .guards
            .get(other_port.wrapping_sub(plant.system.stops.len()))
        {
            Some(guard) if guard.change == BridgeChange::Switches => plant.ports[other_port]
                .displacement
                .iter()
                .zip(&plant.ports[port].force)
                .map(|(row, b)| row * b)
                .sum(),
            _ => 0.0,
        }
    }

    /// Returns the row of the relative acceleration of a port without the contact forces:
    /// `(A^T c_v)`.
    pub fn acceleration_row(&self, port: usize) -> Vec<f64> {
        self.plant
            .diagonal
            .block
            .rate_row(&self.plant.ports[port].velocity)
    }
}

/// Creates empty entries for all conduction states of a plant whose bridges are blocked.
fn empty_kernels(plant: &Plant) -> StateKernels {
    let is_first = plant
        .system
        .bridges
        .iter()
        .all(|bridge| bridge.state == BridgeState::default());
    let count = if is_first && !plant.system.bridges.is_empty() {
        plant.system.conduction_states()
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

/// Returns the power of time with which the force of a contact starts.
fn onset_exponent(law: &Law) -> Option<f64> {
    match law {
        Law::Hertz(law) => Some(law.exponent),
        Law::HuntCrossley(law) => Some(law.elastic.exponent),
        Law::KelvinVoigt(_) | Law::Cubic(_) | Law::Table(_) | Law::Rigid(_) => None,
    }
}

/// The state is padded to complete vectors; a step fills one: seven nodes and its end.
const _: () = assert!(LANES == crate::force_response::basis::NODES + 1);
