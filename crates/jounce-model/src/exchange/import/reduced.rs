//! Modal quantities of matrices, in their units and in SI units.

use super::damping::ModalDamping;
use super::{ImportSettings, ImportedModes};
use crate::exchange::projection::{Electrode, Projection};
use jounce_sparse::{LowestModes, SymmetricMatrix};
use jounce_spec::{Electrodes, Modal, ModalPatch};
use std::f64::consts::TAU;

/// An eigenvalue below this share of the magnitude of the shift is that of a rigid-body motion.
const RIGID_SHARE: f64 = 1e-7;

/// Roundoff of `x^T A y` relative to the sum of the magnitudes of its terms.
const ROUNDOFF: f64 = 100.0 * f64::EPSILON;

/// Modal quantities in units of the matrices.
pub(super) struct Reduced<'a> {
    modes: &'a LowestModes,
    stiffness: &'a SymmetricMatrix,
    /// Shapes, and the mass times each.
    pub(super) columns: Vec<Vec<f64>>,
    momenta: Vec<Vec<f64>>,
}

impl<'a> Reduced<'a> {
    pub(super) fn new(
        modes: &'a LowestModes,
        stiffness: &'a SymmetricMatrix,
        mass: &SymmetricMatrix,
    ) -> Self {
        let columns: Vec<Vec<f64>> = modes
            .shape
            .column_iter()
            .map(|column| column.iter().copied().collect())
            .collect();
        let momenta = columns.iter().map(|column| mass.product(column)).collect();
        Self {
            modes,
            stiffness,
            columns,
            momenta,
        }
    }

    fn is_rigid(&self, value: f64) -> bool {
        value <= RIGID_SHARE * -self.modes.shift
    }

    fn frequency_hz(&self) -> Vec<f64> {
        let frequency = |value: &f64| {
            if self.is_rigid(*value) {
                0.0
            } else {
                value.sqrt() / TAU
            }
        };
        self.modes.eigenvalue.iter().map(frequency).collect()
    }

    /// Half the relative bound of the eigenvalue.
    fn frequency_error(&self) -> Vec<f64> {
        let bounds = self.modes.eigenvalue.iter().zip(&self.modes.error_bound);
        let relative = |(value, bound): (&f64, &f64)| match self.is_rigid(*value) {
            true => 0.0,
            false => bound / (2.0 * value),
        };
        bounds.map(relative).collect()
    }

    /// Modes of 0 Hz whose `x^T K x` is above roundoff, with the frequency of this quotient.
    fn set_to_zero_hz(&self) -> Vec<(usize, f64)> {
        let rigid = self.modes.eigenvalue.iter().enumerate();
        rigid
            .filter(|(_, value)| self.is_rigid(**value))
            .filter_map(|(mode, _)| {
                let column = &self.columns[mode];
                let square = Product::new(self.stiffness, column).dot(column);
                (square > 0.0).then(|| (mode, square.sqrt() / TAU))
            })
            .collect()
    }

    /// Largest entry of `X^T M X - 1`.
    fn orthogonality(&self) -> f64 {
        let mut largest: f64 = 0.0;
        for (j, column) in self.columns.iter().enumerate() {
            for (k, momentum) in self.momenta.iter().enumerate() {
                let product: f64 = column.iter().zip(momentum).map(|(x, y)| x * y).sum();
                largest = largest.max((product - if j == k { 1.0 } else { 0.0 }).abs());
            }
        }
        largest
    }

    /// Returns the modes in SI units.
    pub(super) fn in_si(
        &self,
        projection: &Projection,
        settings: &ImportSettings,
    ) -> ImportedModes {
        let frequency_hz = self.frequency_hz();
        let damping = projection
            .damping
            .as_ref()
            .map(|damping| ModalDamping::new(damping, &self.columns));
        let damping_ratio = match &damping {
            Some(damping) => damping.ratios(&frequency_hz),
            None => of_list(&settings.damping_ratio, &frequency_hz),
        };
        // A modal coordinate of the matrices has the unit sqrt(mass) length, one of SI sqrt(kg) m.
        let root_mass = settings.mass_unit_kg.sqrt();
        let scaled =
            |values: Vec<f64>, factor: f64| values.into_iter().map(|x| factor * x).collect();
        let point = |(name, shape)| (name, scaled(shape, root_mass.recip()));
        let patch = |electrode: Electrode| {
            let patch = ModalPatch {
                coupling_n_per_v: scaled(electrode.coupling, root_mass * settings.length_unit_m),
                capacitance_f: electrode.capacitance_f,
                leakage_ohm: electrode.leakage_ohm,
                electrodes: Electrodes::default(),
            };
            (electrode.name, patch)
        };
        let points = projection.point_shapes(&self.columns);
        let electrodes = projection.electrodes(&self.columns);
        let modal = Modal {
            damping_ratio,
            participation_sqrt_kg: scaled(projection.participation(&self.momenta), root_mass),
            point: points.into_iter().map(point).collect(),
            patch: electrodes.into_iter().map(patch).collect(),
            frequency_hz,
        };
        ImportedModes {
            frequency_error: self.frequency_error(),
            orthogonality: self.orthogonality(),
            damping_coupling: damping.as_ref().map_or(0.0, ModalDamping::coupling),
            set_to_zero_hz: self.set_to_zero_hz(),
            rigid_damping_per_s: damping
                .map_or_else(Vec::new, |damping| damping.of_rigid(&modal.frequency_hz)),
            modal,
        }
    }
}

/// `A y` for a vector `y`, with the magnitudes of its sums.
pub(super) struct Product {
    value: Vec<f64>,
    magnitude: Vec<f64>,
}

impl Product {
    pub(super) fn new(matrix: &SymmetricMatrix, y: &[f64]) -> Self {
        let terms = |row: usize| matrix.row(row).map(|(column, value)| value * y[column]);
        let rows = || 0..y.len();
        Self {
            value: rows().map(|row| terms(row).sum()).collect(),
            magnitude: rows().map(|row| terms(row).map(f64::abs).sum()).collect(),
        }
    }

    /// Returns `x^T A y`, 0 where it is roundoff.
    pub(super) fn dot(&self, x: &[f64]) -> f64 {
        let sum: f64 = x.iter().zip(&self.value).map(|(x, value)| x * value).sum();
        let magnitudes = x.iter().zip(&self.magnitude);
        let magnitude: f64 = magnitudes.map(|(x, value)| x.abs() * value).sum();
        if sum.abs() > ROUNDOFF * magnitude {
            sum
        } else {
            0.0
        }
    }
}

/// The ratios of a list for the elastic modes in turn, its last one for all others.
fn of_list(ratios: &[f64], frequency_hz: &[f64]) -> Vec<f64> {
    let last = ratios.last().copied().unwrap_or(0.0);
    let mut next = ratios.iter().copied().chain(std::iter::repeat(last));
    let ratio = |frequency_hz: &f64| {
        if *frequency_hz > 0.0 {
            next.next().unwrap_or(last)
        } else {
            0.0
        }
    };
    frequency_hz.iter().map(ratio).collect()
}
