//! Result of modes.

use super::PlateShapes;
use jounce_model::linear::Coupling;
use jounce_plot::ShapePatch;
use serde::Serialize;

/// Undamped short-circuit modes of a harvester.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModesResult {
    /// Modes in ascending frequency.
    pub modes: Vec<ModeResult>,
    /// Coupling of each patch with each mode; rigid-body modes have none.
    pub couplings: Vec<Coupling>,
    /// Names of the fixed masses.
    pub held: Vec<String>,
    /// Shapes at each point.
    #[serde(skip)]
    pub points: Vec<PointShape>,
    /// Capacitance and modal coupling of each patch.
    #[serde(skip)]
    pub patches: Vec<PatchCoupling>,
    /// Shapes along each beam.
    #[serde(skip)]
    pub beams: Vec<BeamShapes>,
    /// Shapes over each plate.
    #[serde(skip)]
    pub plates: Vec<PlateShapes>,
}

/// One mode.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ModeResult {
    /// Undamped short-circuit frequency, Hz; 0 for a rigid-body mode.
    pub frequency_hz: f64,
    /// Damping ratio (1 = critical).
    pub damping_ratio: f64,
    /// Estimated relative error of the frequency.
    pub discretisation_error: f64,
}

/// Modes at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct PointShape {
    /// Name of the point.
    pub name: String,
    /// Mass-normalised displacement of each mode, kg^-1/2.
    pub shape_per_sqrt_kg: Vec<f64>,
}

/// Capacitance and modal coupling of one patch.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchCoupling {
    /// Name of the patch.
    pub name: String,
    /// Clamped capacitance, F.
    pub capacitance_f: f64,
    /// Force per voltage along each mass-normalised mode, N/V per kg^1/2.
    pub coupling_n_per_v: Vec<f64>,
}

/// Modes along one beam.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamShapes {
    /// Name of the beam.
    pub name: String,
    /// Distances from the root, m.
    pub place_m: Vec<f64>,
    /// Mass-normalised displacement of each mode at each place, kg^-1/2.
    pub shapes_per_sqrt_kg: Vec<Vec<f64>>,
    /// Patches on the beam.
    pub(super) patches: Vec<ShapePatch>,
}
