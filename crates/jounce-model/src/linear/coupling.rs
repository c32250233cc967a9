//! Short-circuit and open-circuit frequencies and coupling factors.

use crate::structure::Modes;
use std::f64::consts::TAU;

/// Coupling of one mode with one patch.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Coupling {
    /// Patch.
    pub patch: String,
    /// Mode number, from 0.
    pub mode: usize,
    /// Frequency with the patch short-circuited, Hz.
    pub short_circuit_hz: f64,
    /// Frequency with the patch open, this mode only, Hz.
    pub open_circuit_hz: f64,
    /// Modal coupling `theta^2 / (C w^2)`.
    pub coupling_squared: f64,
}

/// Returns the coupling of every mode with every patch:
/// `w_oc^2 = w_sc^2 (1 + theta^2 / (C w_sc^2))`.
pub fn couplings(modes: &Modes) -> Vec<Coupling> {
    let mut all = Vec::new();
    for (name, patch) in &modes.patch {
        for (mode, (w, theta)) in modes
            .frequency_rad_s
            .iter()
            .zip(&patch.coupling_n_per_v)
            .enumerate()
            .filter(|(_, (w, _))| **w > 0.0)
        {
            let coupling_squared = theta * theta / (patch.capacitance_f * w * w);
            all.push(Coupling {
                patch: name.clone(),
                mode,
                short_circuit_hz: w / TAU,
                open_circuit_hz: w / TAU * (1.0 + coupling_squared).sqrt(),
                coupling_squared,
            });
        }
    }
    all
}
