//! Result of an import.

use serde::Serialize;

/// A structure of another program as modes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImportResult {
    /// Modes in ascending frequency.
    pub modes: Vec<ImportedMode>,
    /// Names of the points.
    pub points: Vec<String>,
    /// Names of the electrodes, which are the patches of the structure.
    pub electrodes: Vec<String>,
    /// Whether the shapes were given with the matrices.
    pub has_given_shapes: bool,
    /// Largest deviation of the mass-normalised shapes from orthonormal ones.
    pub orthogonality: f64,
    /// Largest product of two elastic shapes with the stiffness, relative to the root of the product
    /// of their own.
    pub stiffness_orthogonality: f64,
    /// Largest damping between two modes relative to their own; the structure leaves it out.
    pub damping_coupling: f64,
    /// The structure as part of a spec, `[modal.NAME]`.
    pub spec: String,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// One mode.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ImportedMode {
    /// Undamped short-circuit frequency, Hz; 0 for a rigid-body mode.
    pub frequency_hz: f64,
    /// Damping ratio (1 = critical).
    pub damping_ratio: f64,
    /// Bound of the relative error of the frequency, without that of roundoff; `None` for given
    /// shapes.
    pub frequency_error: Option<f64>,
    /// Frequency of Rayleigh's quotient of the shape with stiffness and mass, Hz.
    pub rayleigh_hz: f64,
}
