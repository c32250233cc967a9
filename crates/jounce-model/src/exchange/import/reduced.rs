//! Modal quantities of matrices, in their units and in SI units.

use super::damping::ModalDamping;
use super::{ImportSettings, ImportedModes};
use crate::exchange::projection::{Electrode, Projection};
use jounce_linalg::Mat;
use jounce_sparse::{LowestModes, SymmetricMatrix};
use jounce_spec::{Electrodes, Modal, ModalPatch};
use std::f64::consts::TAU;

/// An eigenvalue below this share of the magnitude of the shift, or of the next one, is that of a
/// rigid-body motion.
pub(super) const RIGID_SHARE: f64 = 1e-7;

/// Roundoff of `x^T A y` relative to the sum of the magnitudes of its terms.
const ROUNDOFF: f64 = 100.0 * f64::EPSILON;

/// Modal quantities in units of the matrices.
pub(super) struct Reduced {
    /// Mass-normalised shapes, and the mass times each.
    columns: Vec<Vec<f64>>,
    momenta: Vec<Vec<f64>>,
    frequency_hz: Vec<f64>,
    frequency_error: Vec<Option<f64>>,
    has_given_shapes: bool,
    /// `X^T K X`, without its roundoff.
    stiffness: Mat<f64>,
}

impl Reduced {
    /// Returns the modes of shapes with their frequencies, all ascending in frequency.
    pub(super) fn of_shapes(
        columns: Vec<Vec<f64>>,
        frequency_hz: Vec<f64>,
        stiffness: &SymmetricMatrix,
        mass: &SymmetricMatrix,
    ) -> Self {
        Self {
            momenta: columns.iter().map(|column| mass.product(column)).collect(),
            frequency_error: vec![None; columns.len()],
            has_given_shapes: true,
            stiffness: between(stiffness, &columns),
            columns,
            frequency_hz,
        }
    }

    /// Returns the modes of the eigenproblem.
    pub(super) fn of_lowest(
        modes: &LowestModes,
        stiffness: &SymmetricMatrix,
        mass: &SymmetricMatrix,
    ) -> Self {
        let is_rigid = |value: f64| value <= RIGID_SHARE * -modes.shift;
        let frequency = |value: &f64| match is_rigid(*value) {
            true => 0.0,
            false => value.sqrt() / TAU,
        };
        // Half the relative bound of the eigenvalue.
        let error = |(value, bound): (&f64, &f64)| match is_rigid(*value) {
            true => Some(0.0),
            false => Some(bound / (2.0 * value)),
        };
        let columns = modes.shape.column_iter();
        let columns = columns.map(|column| column.iter().copied().collect());
        let bounds = modes.eigenvalue.iter().zip(&modes.error_bound);
        Self {
            frequency_error: bounds.map(error).collect(),
            has_given_shapes: false,
            ..Self::of_shapes(
                columns.collect(),
                modes.eigenvalue.iter().map(frequency).collect(),
                stiffness,
                mass,
            )
        }
    }

    /// Frequencies of Rayleigh's quotients.
    fn rayleigh_hz(&self) -> Vec<f64> {
        let modes = 0..self.columns.len();
        modes
            .map(|mode| self.stiffness[(mode, mode)].max(0.0).sqrt() / TAU)
            .collect()
    }

    /// Modes of 0 Hz whose `x^T K x` is above roundoff, with the frequency of this quotient.
    fn set_to_zero_hz(&self) -> Vec<(usize, f64)> {
        let modes = self.rayleigh_hz().into_iter().enumerate();
        modes
            .filter(|(mode, rayleigh_hz)| self.frequency_hz[*mode] == 0.0 && *rayleigh_hz > 0.0)
            .collect()
    }

    /// Largest entry of `X^T K X` off its diagonal between elastic modes, relative to the root of the
    /// product of both entries on it.
    fn stiffness_orthogonality(&self) -> f64 {
        let mut largest: f64 = 0.0;
        for i in 0..self.columns.len() {
            for j in 0..i {
                let own = self.stiffness[(i, i)] * self.stiffness[(j, j)];
                if self.frequency_hz[i] > 0.0 && self.frequency_hz[j] > 0.0 && own > 0.0 {
                    largest = largest.max(self.stiffness[(i, j)].abs() / own.sqrt());
                }
            }
        }
        largest
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
        let frequency_hz = self.frequency_hz.clone();
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
            frequency_error: self.frequency_error.clone(),
            rayleigh_hz: self.rayleigh_hz(),
            has_given_shapes: self.has_given_shapes,
            orthogonality: self.orthogonality(),
            stiffness_orthogonality: self.stiffness_orthogonality(),
            damping_coupling: damping.as_ref().map_or(0.0, ModalDamping::coupling),
            set_to_zero_hz: self.set_to_zero_hz(),
            rigid_damping_per_s: damping
                .map_or_else(Vec::new, |damping| damping.of_rigid(&modal.frequency_hz)),
            modal,
        }
    }
}

/// Returns `X^T A X` without its roundoff.
pub(super) fn between(matrix: &SymmetricMatrix, columns: &[Vec<f64>]) -> Mat<f64> {
    let products: Vec<Product> = columns
        .iter()
        .map(|column| Product::new(matrix, column))
        .collect();
    Mat::from_fn(columns.len(), columns.len(), |i, j| {
        products[j].dot(&columns[i])
    })
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
