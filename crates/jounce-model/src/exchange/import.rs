//! Matrices of another program, reduced to modes.

use super::projection::{Electrode, Projection};
use super::{ExchangeFaults, MatrixSet};
use jounce_linalg::Mat;
use jounce_sparse::{LowestModes, MatrixEntries, SparseError, SymmetricMatrix, lowest_modes};
use jounce_spec::{Electrodes, Modal, ModalPatch};
use std::f64::consts::TAU;

/// Accuracy of each eigenvalue.
const TOLERANCE: f64 = 1e-11;

/// An eigenvalue below this share of the magnitude of the shift is that of a rigid-body motion.
const RIGID_SHARE: f64 = 1e-7;

/// Largest number of entries of a matrix with one column for each electrode or for the base.
const MAX_DENSE: usize = 100_000_000;

/// Number of modes, and the meaning of the numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportSettings {
    /// Number of modes, the lowest ones.
    pub modes: usize,
    /// Damping ratio of each elastic mode, the last one for all further modes; without effect if the
    /// set contains `damping`.
    pub damping_ratio: Vec<f64>,
    /// Unit of the mass, kg.
    pub mass_unit_kg: f64,
    /// Unit of displacements, m; the unit of time is the second.
    pub length_unit_m: f64,
}

/// A structure of another program as modes.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedModes {
    /// The modes, in SI units.
    pub modal: Modal,
    /// Bound of the error of each frequency, relative; 0 for a rigid-body mode.
    pub frequency_error: Vec<f64>,
    /// Largest entry of `X^T M X - 1`, for the shapes `X`.
    pub orthogonality: f64,
    /// Largest entry of the modal damping off its diagonal, which the modes leave out, relative to
    /// the diagonal; 0 without damping matrix.
    pub damping_coupling: f64,
}

/// Reduces matrices to their lowest modes.
///
/// # Errors
/// All faults of the matrices and of their names; then the first of the eigenproblem.
pub fn import_modes(
    mut set: MatrixSet,
    settings: &ImportSettings,
) -> Result<ImportedModes, ExchangeFaults> {
    let mut faults = Vec::new();
    let [mass, stiffness, damping] =
        ["mass", "stiffness", "damping"].map(|name| square(&mut set, name, &mut faults));
    let (Some(mass), Some(stiffness)) = (mass, stiffness) else {
        return Err(ExchangeFaults(faults));
    };
    let points = set.matrix.remove("points");
    for name in ["coupling", "capacitance", "conductance", "base"] {
        if let Some(matrix) = set.matrix.get(name)
            && matrix.rows.saturating_mul(matrix.columns) > MAX_DENSE
        {
            faults.push(format!(
                "{name} is {} x {}, more than {MAX_DENSE} entries; its columns must be electrodes, or 1 for base",
                matrix.rows, matrix.columns
            ));
        }
    }
    if !faults.is_empty() {
        return Err(ExchangeFaults(faults));
    }
    let dense = |name: &str| set.matrix.get(name).map(MatrixEntries::dense);
    let projection = Projection {
        damping,
        coupling: dense("coupling"),
        capacitance: dense("capacitance"),
        conductance: dense("conductance"),
        points,
        base: dense("base"),
        names: set.names,
        size: mass.size(),
    };
    faults.extend(projection.faults());
    if stiffness.size() != mass.size() {
        let error = SparseError::SizeMismatch {
            stiffness: stiffness.size(),
            mass: mass.size(),
        };
        faults.push(error.to_string());
    }
    if !faults.is_empty() {
        return Err(ExchangeFaults(faults));
    }
    let modes = lowest_modes(&stiffness, &mass, settings.modes, TOLERANCE);
    let modes = modes.map_err(|error| error.to_string())?;
    Ok(in_si(&modes, &mass, &projection, settings))
}

/// Takes a square matrix out of a set; `None` if it is absent or has a fault.
fn square(set: &mut MatrixSet, name: &str, faults: &mut Vec<String>) -> Option<SymmetricMatrix> {
    let Some(matrix) = set.matrix.remove(name) else {
        if name != "damping" {
            faults.push(format!(
                "{name} is missing; mass and stiffness are required"
            ));
        }
        return None;
    };
    let read = matrix
        .symmetric()
        .map_err(|error| faults.push(format!("{name}: {error}")));
    read.ok()
}

/// Modal quantities in units of the matrices.
struct Reduced<'a> {
    modes: &'a LowestModes,
    /// Shapes, and the mass times each.
    columns: Vec<Vec<f64>>,
    momenta: Vec<Vec<f64>>,
}

impl Reduced<'_> {
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
}

fn in_si(
    modes: &LowestModes,
    mass: &SymmetricMatrix,
    projection: &Projection,
    settings: &ImportSettings,
) -> ImportedModes {
    let columns: Vec<Vec<f64>> = modes
        .shape
        .column_iter()
        .map(|column| column.iter().copied().collect())
        .collect();
    let momenta = columns.iter().map(|column| mass.product(column)).collect();
    let reduced = Reduced {
        modes,
        columns,
        momenta,
    };
    let frequency_hz = reduced.frequency_hz();
    let modal_damping = projection.modal_damping(&reduced.columns);
    let damping_ratio = match &modal_damping {
        Some(modal) => of_matrix(modal, &frequency_hz),
        None => of_list(&settings.damping_ratio, &frequency_hz),
    };
    // A modal coordinate of the matrices has the unit sqrt(mass) length, one of SI sqrt(kg) m.
    let root_mass = settings.mass_unit_kg.sqrt();
    let scaled = |values: Vec<f64>, factor: f64| values.into_iter().map(|x| factor * x).collect();
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
    let modal = Modal {
        frequency_hz,
        damping_ratio,
        participation_sqrt_kg: scaled(projection.participation(&reduced.momenta), root_mass),
        point: projection
            .point_shapes(&reduced.columns)
            .into_iter()
            .map(point)
            .collect(),
        patch: projection
            .electrodes(&reduced.columns)
            .into_iter()
            .map(patch)
            .collect(),
    };
    ImportedModes {
        modal,
        frequency_error: reduced.frequency_error(),
        orthogonality: orthogonality(&reduced),
        damping_coupling: modal_damping.map_or(0.0, |modal| off_diagonal(&modal)),
    }
}

/// Largest entry of `X^T M X - 1`.
fn orthogonality(reduced: &Reduced<'_>) -> f64 {
    let mut largest: f64 = 0.0;
    for (j, column) in reduced.columns.iter().enumerate() {
        for (k, momentum) in reduced.momenta.iter().enumerate() {
            let product: f64 = column.iter().zip(momentum).map(|(x, y)| x * y).sum();
            largest = largest.max((product - if j == k { 1.0 } else { 0.0 }).abs());
        }
    }
    largest
}

/// Ratios `c_ii / (2 w_i)`; 0 for rigid-body modes.
fn of_matrix(modal: &Mat<f64>, frequency_hz: &[f64]) -> Vec<f64> {
    let ratio = |(i, frequency_hz): (usize, &f64)| match *frequency_hz > 0.0 {
        true => modal[(i, i)] / (2.0 * TAU * frequency_hz),
        false => 0.0,
    };
    frequency_hz.iter().enumerate().map(ratio).collect()
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

/// Largest entry off the diagonal relative to the root of the product of both entries on it.
fn off_diagonal(modal: &Mat<f64>) -> f64 {
    let mut largest: f64 = 0.0;
    for i in 0..modal.nrows() {
        for j in 0..i {
            let both = (modal[(i, i)] * modal[(j, j)]).abs().sqrt();
            if modal[(i, j)] != 0.0 {
                largest = largest.max(modal[(i, j)].abs() / both);
            }
        }
    }
    largest
}
