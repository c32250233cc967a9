//! Matrices of another program, reduced to modes.

mod damping;
mod reduced;
mod shapes;

use super::projection::Projection;
use super::{ExchangeFaults, MatrixSet};
use jounce_sparse::{MAX_DIMENSION, MatrixEntries, SparseError, SymmetricMatrix, lowest_modes};
use jounce_spec::Modal;
use reduced::Reduced;
use shapes::GivenShapes;

/// Accuracy of each eigenvalue.
const TOLERANCE: f64 = 1e-11;

/// Largest number of entries of a matrix with one column for each electrode or for the base.
const MAX_DENSE: usize = 100_000_000;

/// Matrices with few columns.
const DENSE: [&str; 6] = [
    "coupling",
    "capacitance",
    "conductance",
    "base",
    "shapes",
    "frequency_hz",
];

/// Number of modes, and the meaning of the numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportSettings {
    /// Number of modes, the lowest ones; without effect if the set contains `shapes`.
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
    /// Bound of the error of each frequency, relative; 0 for a rigid-body mode; `None` for given
    /// shapes.
    pub frequency_error: Vec<Option<f64>>,
    /// `sqrt(x^T K x / x^T M x) / (2 pi)` for each shape `x`, Hz: Rayleigh's quotient.
    pub rayleigh_hz: Vec<f64>,
    /// Whether the shapes were given with the matrices.
    pub has_given_shapes: bool,
    /// Largest entry of `X^T M X - 1`, for the mass-normalised shapes `X`.
    pub orthogonality: f64,
    /// Largest `|x^T K y| / sqrt(x^T K x  y^T K y)` of two elastic modes.
    pub stiffness_orthogonality: f64,
    /// Largest entry of the modal damping off its diagonal, which the modes leave out, relative to
    /// the diagonal; 0 without damping matrix, and where it is roundoff.
    pub damping_coupling: f64,
    /// Modes of 0 Hz whose frequency in the matrices is above roundoff: index and frequency, Hz.
    pub set_to_zero_hz: Vec<(usize, f64)>,
    /// Modes of 0 Hz whose damping in the matrices is above roundoff, and left out: index and
    /// damping, 1/s.
    pub rigid_damping_per_s: Vec<(usize, f64)>,
}

/// Reduces matrices to their lowest modes, or to the modes of the given `shapes`.
///
/// # Errors
/// All faults of the matrices and of their names; then the first of the eigenproblem.
pub fn import_modes(
    mut set: MatrixSet,
    settings: &ImportSettings,
) -> Result<ImportedModes, ExchangeFaults> {
    let mut faults: Vec<String> = set.matrix.iter().filter_map(entry_fault).collect();
    faults.extend(set.names.faults());
    if !faults.is_empty() {
        return Err(ExchangeFaults(faults));
    }
    let [mass, stiffness, damping] =
        ["mass", "stiffness", "damping"].map(|name| square(&mut set, name, &mut faults));
    let (Some(mass), Some(stiffness)) = (mass, stiffness) else {
        return Err(ExchangeFaults(faults));
    };
    let points = set.matrix.remove("points");
    faults.extend(wide_faults(&set));
    if !faults.is_empty() {
        return Err(ExchangeFaults(faults));
    }
    let dense = |name: &str| set.matrix.get(name).map(MatrixEntries::dense);
    let shapes = GivenShapes::new(
        dense("shapes"),
        dense("frequency_hz"),
        mass.size(),
        &mut faults,
    );
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
    let reduced = match shapes {
        Some(shapes) => shapes.reduced(&stiffness, &mass)?,
        None => {
            let modes = lowest_modes(&stiffness, &mass, settings.modes, TOLERANCE);
            Reduced::of_lowest(
                &modes.map_err(|error| error.to_string())?,
                &stiffness,
                &mass,
            )
        }
    };
    Ok(reduced.in_si(&projection, settings))
}

/// Returns the faults of matrices with too many columns to be held densely.
fn wide_faults(set: &MatrixSet) -> Vec<String> {
    let matrices = DENSE
        .into_iter()
        .filter_map(|name| set.matrix.get(name).map(|matrix| (name, matrix)));
    matrices
        .filter(|(_, matrix)| matrix.rows.saturating_mul(matrix.columns) > MAX_DENSE)
        .map(|(name, matrix)| {
            format!(
                "{name} is {} x {}, more than {MAX_DENSE} entries; its columns must be electrodes or modes, or 1 for base",
                matrix.rows, matrix.columns
            )
        })
        .collect()
}

/// Returns the fault of a matrix that is too large, or its first entry that lies outside it or is
/// not finite.
fn entry_fault((name, matrix): (&String, &MatrixEntries)) -> Option<String> {
    let (rows, columns) = (matrix.rows, matrix.columns);
    if rows.max(columns) > MAX_DIMENSION {
        return Some(format!(
            "{name} is {rows} x {columns}; at most {MAX_DIMENSION} rows and columns are read"
        ));
    }
    let is_wrong = |(row, column, value): &&(usize, usize, f64)| {
        *row >= rows || *column >= columns || !value.is_finite()
    };
    let (row, column, value) = matrix.entries.iter().find(is_wrong)?;
    let place = format!("{name}: entry ({}, {})", row + 1, column + 1);
    Some(match value.is_finite() {
        true => format!("{place} lies outside the {rows} x {columns} matrix"),
        false => format!("{place} is {value}; it must be finite"),
    })
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
