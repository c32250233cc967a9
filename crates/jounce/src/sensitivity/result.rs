//! Result of sensitivities.

use serde::Serialize;

/// Derivatives of the results of a periodic orbit with respect to keys of the spec.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SensitivityResult {
    /// Id of the orbit, as in `basins`.
    pub at: String,
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Results of the orbit: the mean power first, then peaks.
    pub quantities: Vec<OrbitResult>,
    /// Keys with their derivatives, the largest relative one of the mean power first.
    pub keys: Vec<KeySensitivity>,
    /// Turning point of the orbit that is nearest to the surface of a stop; `null` without one.
    pub grazing: Option<OrbitGrazing>,
    /// Keys without derivatives, with the reason.
    pub failed: Vec<FailedKey>,
}

/// A result of an orbit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrbitResult {
    /// Name: `mean_power`, `voltage.PATCH`, `strain.PATCH`, `contact_force.STOP`,
    /// `displacement.STOP`, `nearest_fold`, `nearest_peak` or `peak_power`.
    pub name: String,
    /// SI unit; empty for a strain.
    pub unit: &'static str,
    /// Value, SI.
    pub value: f64,
}

/// A key with its derivatives.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KeySensitivity {
    /// Dotted path.
    pub key: String,
    /// SI unit; empty for a plain number.
    pub unit: String,
    /// Value, SI.
    pub value: f64,
    /// Derivative of each result, in the order of `quantities`.
    pub derivatives: Vec<KeyDerivative>,
    /// Change of the key that brings the orbit to the nearest grazing, to first order, SI; `null` where
    /// it is not known.
    pub grazing_change: Option<f64>,
}

/// The grazing that is nearest to an orbit. The derivatives of the results are those of the side of
/// the orbit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OrbitGrazing {
    /// Name of the stop.
    pub stop: String,
    /// `maximum`, where a contact begins to exist at the grazing, or `minimum`, where one is divided.
    pub turning_point: &'static str,
    /// Side of the orbit: `contact` where the turning point is past the surface, else `no-contact`.
    pub side: &'static str,
    /// Derivatives on the other side: `continuous` where they are the same at the grazing, `jump`
    /// where they differ, or `unbounded` where they grow without bound on the side with contact.
    pub across: &'static str,
}

/// Derivative of a result with respect to a key.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct KeyDerivative {
    /// Derivative, SI.
    pub derivative: f64,
    /// Relative change of the result per relative change of the key, d ln result / d ln key.
    pub relative: f64,
    /// Estimated error of `relative`.
    pub relative_error: f64,
}

/// A key without derivatives.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FailedKey {
    /// Dotted path.
    pub key: String,
    /// The reason.
    pub reason: String,
}
