//! Result of an estimate of the restitution.

use serde::Serialize;

/// Estimate of the coefficient of restitution. Ranges belong to the range of the yield strength.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestitutionResult {
    /// Coefficient of restitution, lowest and highest of both theories.
    pub restitution: [f64; 2],
    /// Coefficient with the pressure at the yield limit, Thornton (1997).
    pub perfectly_plastic: [f64; 2],
    /// Coefficient with the fully plastic pressure, Johnson (1985), at most 1.
    pub fully_plastic: [f64; 2],
    /// Speed of approach at which the softer body begins to yield, m/s; the coefficient is 1 below it.
    pub yield_speed_m_s: [f64; 2],
    /// Yield strength of the softer body, Pa.
    pub yield_strength_pa: [f64; 2],
    /// Effective modulus of both bodies, Pa.
    pub effective_modulus_pa: f64,
    /// Effective radius of both bodies, m.
    pub effective_radius_m: f64,
    /// Effective mass of both bodies, kg.
    pub effective_mass_kg: f64,
    /// Speed of approach, m/s.
    pub speed_m_s: f64,
    /// Sources of theories and materials.
    pub sources: Vec<String>,
}
