//! Charge balance of a rectified circuit over the averaging window.
//!
//! ```text
//! Q = integral V / R dt + integral V / R_leak dt + C (V_end - V_start)
//! ```
//!
//! A regulator draws its conductance times the voltage and its held current instead of `V / R`.
//!
//! `Q` (C) is the charge through the diodes, which the integrator sums at the patches: displaced
//! charge minus stored charge. The right side is the charge at the storage (capacitance `C`, F,
//! voltage `V`), from its voltage integrated step by step over the record. The two sides have only
//! the motion in common.
//!
//! Validation: `crates/jounce-analysis/tests/integrate/circuits/charges.rs`, 4e-15 with a bridge
//! and both kinds of SSHI, with a stop, and with diodes whose current decays within 1e-9 to 1/4000
//! of a step; `crates/jounce-analysis/tests/impact_examples`, 2e-13 with a storage of 2000 times
//! the patch.

use super::{RunPlan, RunResult};
use jounce_dynamics::Kernel;
use jounce_model::plant::{Bridge, RectifierScheme};
use serde::Serialize;

/// Charge balance of one rectified circuit over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChargeResult {
    /// Name of the circuit.
    pub name: String,
    /// Charge through the diodes, C.
    pub passed_c: f64,
    /// Charge through the load or the regulator, C.
    pub load_c: f64,
    /// Charge through the leakage of the storage, C.
    pub leakage_c: f64,
    /// Change of the charge of the storage, C.
    pub storage_c: f64,
    /// Residual of the balance, relative to the largest of these charges.
    pub residual_relative: f64,
}

/// Returns the charge balance of every circuit whose diodes feed a capacitor. The run must record
/// its averaging window (see [`RunPlan::balancing`]); without this record the list is empty.
pub fn charges(kernel: &Kernel, result: &RunResult, plan: &RunPlan) -> Vec<ChargeResult> {
    let plant = &kernel.plant;
    let from_s = plan.duration_s - plan.average_over_s;
    let recorded = result
        .trajectory
        .segments()
        .first()
        .is_some_and(|first| first.start_s <= from_s * (1.0 + 1e-12));
    plant
        .system
        .bridges
        .iter()
        .enumerate()
        .filter(|_| recorded)
        .filter_map(|circuit| charge(kernel, result, plan, circuit))
        .collect()
}

/// Returns the charge balance of one circuit; `None` where its diodes feed no capacitor.
fn charge(
    kernel: &Kernel,
    result: &RunResult,
    plan: &RunPlan,
    (k, bridge): (usize, &Bridge),
) -> Option<ChargeResult> {
    let plant = &kernel.plant;
    let from_s = plan.duration_s - plan.average_over_s;
    let (capacitance_f, node) = (
        bridge.storage.capacitance_f()?,
        plant.electrical.bridges[k].storage?,
    );
    // SECE transfers energy and passes no charge.
    if matches!(bridge.scheme, RectifierScheme::Extraction { .. }) {
        return None;
    }
    let state_index = 2 * plant.system.modes.len() + node;
    let flux_v_s = result
        .trajectory
        .integral(kernel, from_s, plan.duration_s, state_index);
    let stored_v = result.end.voltage_v[node]
        - result
            .trajectory
            .physical_at(kernel, from_s)
            .get(state_index)
            .copied()
            .unwrap_or(f64::NAN);
    let rectified_c = result.rectified[k].mean_current_a * plan.average_over_s;
    let drawn_c = result.drawn_c.get(k).copied().unwrap_or(0.0);
    let (load_c, leakage_c) = (
        flux_v_s * bridge.storage.conductance_per_ohm() + drawn_c,
        bridge.leakage_ohm.map_or(0.0, |ohm| flux_v_s / ohm),
    );
    let storage_c = capacitance_f * stored_v;
    let largest_c = [rectified_c, load_c, leakage_c, storage_c]
        .iter()
        .fold(0.0_f64, |max, charge| max.max(charge.abs()));
    let residual_c = rectified_c - load_c - leakage_c - storage_c;
    let residual_relative = if largest_c > 0.0 {
        residual_c / largest_c
    } else {
        0.0
    };
    Some(ChargeResult {
        name: bridge.name.clone(),
        passed_c: rectified_c,
        load_c,
        leakage_c,
        storage_c,
        residual_relative,
    })
}
