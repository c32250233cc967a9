//! The linear plant with its ports, tones and outputs.

use super::diagonal::stiff::check_speeds;
use super::{
    Across, Diagonal, Electrical, EventFunction, Forcing, PlantError, Signal, SignalIntegrals,
    System, Tone,
};
use crate::drive::Travel;
use jounce_linalg::{Mat, c64, column};
use std::sync::Arc;

/// A diagonalised electromechanical system.
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// System from which the plant was made.
    pub system: System,
    /// Electrical states of the system.
    pub electrical: Electrical,
    /// Diagonal form; plants that differ in drives, signals or stops share it.
    pub diagonal: Arc<Diagonal>,
    /// One per distinct drive frequency.
    pub tones: Vec<Tone>,
    /// One per signal, in the order of `system.signals`.
    pub forcings: Vec<Forcing>,
    /// One per signal: displacement of its base, if a stop depends on it.
    pub travels: Vec<Option<Arc<Travel>>>,
    /// One per stop, in the order of `system.stops`, then one per event function.
    pub ports: Vec<Port>,
    /// Event functions of the bridges.
    pub guards: Vec<EventFunction>,
}

/// Port of a scalar nonlinearity: rows and column in block coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Port {
    /// Row of the displacement towards the stop, m.
    pub displacement: Vec<f64>,
    /// Row of the velocity towards the stop, m/s.
    pub velocity: Vec<f64>,
    /// Column of a compressive unit force, per N.
    pub force: Vec<f64>,
    /// Complex displacement of each tone, m, including the motions of bases.
    pub steady_m: Vec<c64>,
    /// Part of it due to the motions of bases, m.
    pub approach_m: Vec<c64>,
    /// Displacement per displacement of the base that each signal moves.
    pub approach: Vec<f64>,
    /// Velocity lost towards the stop per unit impulse, 1/kg.
    pub mobility_per_kg: f64,
    /// Threshold of the displacement, m.
    pub gap_m: f64,
}

impl Plant {
    /// Diagonalises a system and finds its steady state under the drives.
    ///
    /// # Errors
    /// Every variant of [`PlantError`] that concerns the linear system.
    pub fn new(system: System) -> Result<Self, PlantError> {
        let electrical = Electrical::of(&system);
        check_speeds(&system, &electrical)?;
        let diagonal = Arc::new(Diagonal::of(&system, &electrical)?);
        let (tones, forcings, ports) = (Vec::new(), Vec::new(), Vec::new());
        let guards = system.guards();
        let mut plant = Self {
            system,
            electrical,
            diagonal,
            tones,
            forcings,
            travels: Vec::new(),
            ports,
            guards,
        };
        plant.tones = plant.make_tones()?;
        plant.forcings = plant
            .system
            .signals
            .iter()
            .map(|signal| Forcing::of(&plant, signal))
            .collect();
        plant.ports = plant.make_ports();
        plant.approach();
        Ok(plant)
    }

    /// Returns this plant under other drives; the diagonal form is reused.
    ///
    /// # Errors
    /// [`PlantError::UndampedResonance`].
    pub fn with_drives(&self, drives: Vec<super::Drive>) -> Result<Self, PlantError> {
        let mut plant = self.clone();
        plant.system.drives = drives;
        plant.tones = plant.make_tones()?;
        plant.ports = plant.make_ports();
        plant.approach();
        Ok(plant)
    }

    /// Returns this plant under other signals.
    pub fn with_signals(&self, signals: Vec<Signal>) -> Self {
        let mut plant = self.clone();
        plant.forcings = signals
            .iter()
            .map(|signal| Forcing::of(&plant, signal))
            .collect();
        plant.system.signals = signals;
        plant.approach();
        plant
    }

    /// Returns the magnitude of the motion at the ports, m: the largest steady amplitude or
    /// absolute gap of all ports; 0 without ports.
    pub fn scale_m(&self) -> f64 {
        let size = |(port, stop): (&Port, &super::Stop)| {
            port.steady_m
                .iter()
                .fold(stop.gap_m.abs(), |max, s| max.max(s.norm()))
        };
        self.ports
            .iter()
            .zip(&self.system.stops)
            .map(size)
            .fold(0.0, f64::max)
    }

    /// Returns this plant with other stops.
    pub fn with_stops(&self, stops: Vec<super::Stop>) -> Self {
        let mut plant = self.clone();
        plant.system.stops = stops;
        plant.ports = plant.make_ports();
        plant.approach();
        plant
    }

    /// Returns the number of states.
    pub fn len(&self) -> usize {
        self.diagonal.block.len()
    }

    /// True without states.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the row of `sum_i shape_i q_i` in block coordinates.
    pub fn displacement_row(&self, shape: &[f64]) -> Vec<f64> {
        self.row(shape, 0)
    }

    /// Returns the row of `sum_i shape_i q_i'` in block coordinates.
    pub fn velocity_row(&self, shape: &[f64]) -> Vec<f64> {
        self.row(shape, self.system.modes.len())
    }

    /// Returns the row of `q_i'` in block coordinates.
    pub(super) fn modal_velocity_row(&self, mode: usize) -> Vec<f64> {
        let (matrix, state) = (&self.diagonal.to_physical, self.system.modes.len() + mode);
        (0..self.len()).map(|j| matrix[(state, j)]).collect()
    }

    /// Returns the row of the voltage of patch number `patch` (in the order of
    /// `system.modes.patch`) in block coordinates.
    pub fn voltage_row(&self, patch: usize) -> Vec<f64> {
        let mut values = vec![0.0; self.electrical.nodes.len()];
        self.electrical.patch[patch]
            .iter()
            .for_each(|(node, factor)| values[*node] += factor);
        self.row(&values, 2 * self.system.modes.len())
    }

    /// Returns the row of the voltage across the resistor of load number `load` (in the order of
    /// `system.loads`) in block coordinates.
    pub fn load_voltage_row(&self, load: usize) -> Vec<f64> {
        let first = 2 * self.system.modes.len();
        match self.electrical.load[load] {
            None => vec![0.0; self.len()],
            Some(Across::Node(node)) => self.row(&[1.0], first + node),
            Some(Across::Inductor(inductor, resistance_ohm)) => self.row(
                &[resistance_ohm],
                first + self.electrical.nodes.len() + inductor,
            ),
        }
    }

    /// Returns the column of a modal force `shape` in block coordinates.
    pub fn force_column(&self, shape: &[f64]) -> Vec<f64> {
        let (n, inverse) = (self.system.modes.len(), &self.diagonal.from_physical);
        (0..self.len())
            .map(|i| {
                shape
                    .iter()
                    .enumerate()
                    .map(|(j, s)| inverse[(i, n + j)] * s)
                    .sum()
            })
            .collect()
    }

    /// Returns the column of a signal of unit value in block coordinates.
    pub(super) fn signal_column(&self, signal: &Signal) -> Vec<f64> {
        let Some(storage) = self.drawn_node(signal) else {
            return self.force_column(&signal.shape);
        };
        let (state, inverse) = (
            2 * self.system.modes.len() + storage,
            &self.diagonal.from_physical,
        );
        let rate = -1.0 / self.electrical.nodes[storage].capacitance_f;
        (0..self.len())
            .map(|i| inverse[(i, state)] * rate)
            .collect()
    }

    /// Returns the row of the power of a signal of unit value in block coordinates.
    pub(super) fn signal_power_row(&self, signal: &Signal) -> Vec<f64> {
        match self.drawn_node(signal) {
            None => self.velocity_row(&signal.shape),
            Some(storage) => self.row(&[-1.0], 2 * self.system.modes.len() + storage),
        }
    }

    /// Returns the energy put in by a signal alone, J, from the integrals of all signals. Voltages
    /// are measured from their zeros.
    pub fn signal_energy_j(&self, signal: usize, integrals: &SignalIntegrals) -> f64 {
        let row = self.signal_power_row(&self.system.signals[signal]);
        let states = row.iter().zip(&integrals.states[signal]);
        let tones = self.steady_output(&row);
        states.map(|(r, y)| r * y).sum::<f64>()
            + tones
                .iter()
                .zip(&integrals.tones[signal])
                .map(|(steady, turn)| (steady * turn).re)
                .sum::<f64>()
    }

    /// Returns the node from which a signal draws its current.
    fn drawn_node(&self, signal: &Signal) -> Option<usize> {
        self.electrical.bridges.get(signal.drawn_from?)?.storage
    }

    /// Returns the column of a unit acceleration of the base in block coordinates, per m/s^2.
    pub fn base_column(&self) -> Vec<f64> {
        let against: Vec<f64> = self
            .system
            .modes
            .participation_sqrt_kg
            .iter()
            .map(|participation| -participation)
            .collect();
        self.force_column(&against)
    }

    /// Returns the largest `|eigenvalue|`, rad/s.
    pub fn fastest_rad_s(&self) -> f64 {
        self.diagonal
            .block
            .eigenvalues()
            .iter()
            .fold(0.0, |max, l| max.max(l.norm()))
    }

    pub(super) fn row(&self, values: &[f64], first: usize) -> Vec<f64> {
        let matrix = &self.diagonal.to_physical;
        (0..self.len())
            .map(|j| {
                values
                    .iter()
                    .enumerate()
                    .map(|(i, v)| v * matrix[(first + i, j)])
                    .sum()
            })
            .collect()
    }

    fn make_ports(&self) -> Vec<Port> {
        let stops = self.system.stops.iter().map(|stop| self.port(stop));
        stops
            .chain(self.guards.iter().map(|guard| self.guard_port(guard)))
            .collect()
    }

    fn port(&self, stop: &super::Stop) -> Port {
        let shape = &stop.shape;
        let displacement = self.displacement_row(shape);
        let approach_m = self.approach_of_tones(stop);
        let reaction: Vec<f64> = shape.iter().map(|s| -s).collect();
        Port {
            steady_m: self
                .steady_output(&displacement)
                .iter()
                .zip(&approach_m)
                .map(|(entry, bases)| entry + bases)
                .collect(),
            approach_m,
            approach: Vec::new(),
            displacement,
            velocity: self.velocity_row(shape),
            force: self.force_column(&reaction),
            mobility_per_kg: shape.iter().map(|s| s * s).sum(),
            gap_m: stop.gap_m,
        }
    }
}

/// Returns the product of a matrix and a vector, column by column.
pub fn product(matrix: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; matrix.nrows()];
    let (pairs, last) = vector.as_chunks::<2>();
    for (k, [x, y]) in pairs.iter().enumerate() {
        let columns = column(matrix, 2 * k).iter().zip(column(matrix, 2 * k + 1));
        for (sum, (a, b)) in sum.iter_mut().zip(columns) {
            *sum = *sum + a * x + b * y;
        }
    }
    for factor in last {
        for (sum, entry) in sum.iter_mut().zip(column(matrix, vector.len() - 1)) {
            *sum += entry * factor;
        }
    }
    sum
}

/// Returns the product of a real row and a complex vector.
pub fn dot(row: &[f64], vector: &[c64]) -> c64 {
    row.iter().zip(vector).map(|(r, v)| *v * *r).sum()
}
