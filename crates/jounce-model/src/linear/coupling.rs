//! Short-circuit and open-circuit frequencies, coupling factors and optimal loads.

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
    /// Clamped capacitance `C` of the patch, F.
    pub capacitance_f: f64,
    /// Resistance that equals the impedance of the capacitance at the short-circuit frequency,
    /// `1 / (w C)`, ohm: the optimal load of a weakly coupled patch.
    pub matched_resistance_ohm: f64,
    /// Resistance with the largest power under a sinusoid at the short-circuit frequency, for this
    /// patch and this mode only, ohm; 0 for a mode without damping.
    pub optimal_resistance_ohm: f64,
}

/// Returns the coupling of every mode with every patch:
/// `w_oc^2 = w_sc^2 (1 + theta^2 / (C w_sc^2))`.
///
/// At the short-circuit frequency the patch and the mode are an admittance
/// `Y = i w C + theta^2 / (2 zeta w)` across the load, so the power is largest at `R = 1 / |Y|`.
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
            let matched_resistance_ohm = 1.0 / (w * patch.capacitance_f);
            let damping_by_load = 0.5 * coupling_squared / modes.damping_ratio[mode];
            all.push(Coupling {
                patch: name.clone(),
                mode,
                short_circuit_hz: w / TAU,
                open_circuit_hz: w / TAU * (1.0 + coupling_squared).sqrt(),
                coupling_squared,
                capacitance_f: patch.capacitance_f,
                matched_resistance_ohm,
                optimal_resistance_ohm: matched_resistance_ohm / 1_f64.hypot(damping_by_load),
            });
        }
    }
    all
}
