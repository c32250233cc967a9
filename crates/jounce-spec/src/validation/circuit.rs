//! Circuits: every patch exists, has at most one circuit, and floats only if `electrodes` is
//! `"open"`.

use std::cell::LazyCell;
use std::collections::BTreeMap;

use super::ValidationFaults;
use super::reference::{patches, unknown};
use crate::nearest::clip;
use crate::{Circuit, Electrodes, Spec, Wiring};

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    // Listed once, and only if there is a fault.
    let known = LazyCell::new(|| patches(spec));
    let mut circuit_of: BTreeMap<&str, &str> = BTreeMap::new();
    for (name, circuit) in &spec.circuit {
        let key = || {
            if circuit.patch.is_empty() {
                format!("circuit.{name}.patches")
            } else {
                format!("circuit.{name}.patch")
            }
        };
        for (patch, _) in circuit.connections() {
            if !has_patch(spec, patch) {
                faults.push(key, || {
                    let known: Vec<&str> = known.iter().map(String::as_str).collect();
                    unknown("patch", patch, "patches", &known)
                });
            } else if circuit_of.get(patch) == Some(&name.as_str()) {
                faults.push(key, || {
                    format!(
                        "patch \"{}\" is listed twice; list each patch once",
                        clip(patch)
                    )
                });
            } else if let Some(first) = circuit_of.get(patch) {
                let text = || {
                    format!(
                        "patch \"{}\" already has circuit \"{}\"; give each patch one circuit",
                        clip(patch),
                        clip(first)
                    )
                };
                faults.push(key, text);
            } else {
                circuit_of.insert(patch, name);
            }
        }
        check_unused_keys(name, circuit, faults);
    }
    check_electrodes(spec, &circuit_of, faults);
}

/// No key is without effect.
fn check_unused_keys(name: &str, circuit: &Circuit, faults: &mut ValidationFaults) {
    let has_battery = circuit.battery_v.is_some();
    let unused = [
        (
            circuit.inductance_h.is_none() && circuit.inductor == Wiring::Series,
            "inductor",
            "has no effect without an inductor; give `inductance`, or omit it",
        ),
        (
            circuit.resistance_ohm.is_finite() && has_battery,
            "resistance",
            "has no effect with a battery, which takes the charge; omit it, or give `storage` instead of `battery`",
        ),
        (
            circuit.leakage_ohm.is_some() && has_battery,
            "leakage_resistance",
            "has no effect with a battery, whose voltage is fixed; omit it, or give `storage` instead of `battery`",
        ),
        (
            circuit.wiring == Wiring::Series && circuit.connections().count() == 1,
            "wiring",
            "has no effect with a single patch; list several in `patches`, or omit it",
        ),
    ];
    for (is_unused, key, text) in unused {
        if is_unused {
            faults.push(|| format!("circuit.{name}.{key}"), || text.to_owned());
        }
    }
}

/// Every patch is in a circuit or has open electrodes, but not both.
fn check_electrodes(spec: &Spec, circuit_of: &BTreeMap<&str, &str>, faults: &mut ValidationFaults) {
    // If a circuit names no patch or a patch that does not exist, the intended patch is unknown.
    let named = |circuit: &Circuit| {
        circuit.connections().count() > 0
            && circuit
                .connections()
                .all(|(patch, _)| has_patch(spec, patch))
    };
    let all_named = spec.circuit.values().all(named);
    let parts = spec
        .patch
        .iter()
        .map(|(name, patch)| (format!("patch.{name}"), name.clone(), patch.electrodes));
    let modal = spec.modal.iter().flat_map(|(body, modal)| {
        let patches = modal.patch.iter();
        patches.map(move |(name, patch)| {
            (
                format!("modal.{body}.patch.{name}"),
                format!("{body}.{name}"),
                patch.electrodes,
            )
        })
    });
    for (path, name, electrodes) in parts.chain(modal) {
        let key = || format!("{path}.electrodes");
        match (electrodes, circuit_of.get(name.as_str())) {
            (Electrodes::Circuit, None) if all_named => {
                let text = "no circuit names this patch, so its electrodes float; name it in a [circuit.NAME], or set electrodes = \"open\"";
                faults.push(key, || text.to_owned());
            }
            (Electrodes::Open, Some(circuit)) => {
                let text = || {
                    format!(
                        "is \"open\", but circuit \"{}\" names this patch; remove one of the two",
                        clip(circuit)
                    )
                };
                faults.push(key, text);
            }
            _ => {}
        }
    }
}

fn has_patch(spec: &Spec, name: &str) -> bool {
    let Some((body, patch)) = name.split_once('.') else {
        return spec.patch.contains_key(name);
    };
    spec.modal
        .get(body)
        .is_some_and(|modal| modal.patch.contains_key(patch))
}
