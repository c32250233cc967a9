//! Branches as JSON.

use super::bandwidth;
use jounce_core::analysis::{Bandwidth, Bifurcation, Branch as Curve, BranchPoint};
use jounce_core::run::ExceededLimit;

/// Converts a branch with its points and bifurcations.
pub fn branch_to_json(
    branch: &Curve,
    exceeded: &[Vec<ExceededLimit>],
    width: Option<&Bandwidth>,
) -> serde_json::Value {
    let points: Vec<_> = branch
        .points
        .iter()
        .zip(exceeded)
        .map(|(point, exceeded)| point_to_json(point, exceeded))
        .collect();
    let bifurcations: Vec<_> = branch
        .bifurcations
        .iter()
        .map(bifurcation_to_json)
        .collect();
    serde_json::json!({
        "period_cycles": branch.period_cycles,
        "points": points,
        "bifurcations": bifurcations,
        "not_proved": branch.not_proved,
        "endings": branch.endings,
        "not_followed": branch.not_followed,
        "peak": width.map(|width| width.peak),
        "half_power_bandwidth": width.map(bandwidth::to_json),
    })
}

fn point_to_json(point: &BranchPoint, exceeded: &[ExceededLimit]) -> serde_json::Value {
    let orbit = &point.orbit;
    serde_json::json!({
        "parameter": point.parameter,
        "mean_power_w": orbit.mean_power_w,
        "voltage_rms_v": orbit.voltage_rms_v,
        "stable": orbit.is_stable(),
        "stability_undecided": orbit.is_stability_undecided(),
        "floquet_max_abs": orbit.floquet_max_abs(),
        "contacts_per_period": orbit.contacts,
        "max_penetration_m": orbit.max_penetration_m,
        "displacement_peak_m": orbit.displacement_peak_m,
        "error_estimate": orbit.error_estimate,
        "warnings": exceeded,
    })
}

fn bifurcation_to_json(bifurcation: &Bifurcation) -> serde_json::Value {
    let mut value = serde_json::json!({
        "kind": bifurcation.kind,
        "parameter": bifurcation.at.parameter,
        "mean_power_w": bifurcation.at.orbit.mean_power_w,
        "displacement_peak_m": bifurcation.at.orbit.displacement_peak_m,
        "contacts_per_period": bifurcation.at.orbit.contacts,
    });
    for (key, name) in [("level", &bifurcation.level), ("stop", &bifurcation.stop)] {
        if let Some(name) = name {
            value[key] = name.as_str().into();
        }
    }
    value
}
