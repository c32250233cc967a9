//! Circuits: every patch exists and carries one circuit or none on purpose, and wiring says something.

use std::cell::LazyCell;
use std::collections::BTreeMap;

use super::ValidationFaults;
use super::reference::{patches, unknown};
use crate::spec::nearest::clip;
use crate::spec::{Circuit, Electrodes, Spec, Wiring};

pub(super) fn check(spec: &Spec, broken: &mut ValidationFaults) {
    // Listed once, and only if something is wrong.
    let known = LazyCell::new(|| patches(spec));
    let mut carried: BTreeMap<&str, &str> = BTreeMap::new();
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
                let words = || known.iter().map(String::as_str);
                broken.push(key, || unknown("patch", patch, "patches", words));
            } else if carried.get(patch) == Some(&name.as_str()) {
                broken.push(key, || {
                    format!(
                        "patch \"{}\" stands twice in the list; name each patch once",
                        clip(patch)
                    )
                });
            } else if let Some(first) = carried.get(patch) {
                let text = || {
                    format!(
                        "patch \"{}\" carries circuit \"{}\" already; give each patch one circuit",
                        clip(patch),
                        clip(first)
                    )
                };
                broken.push(key, text);
            } else {
                carried.insert(patch, name);
            }
        }
        if circuit.inductance_h.is_none() && circuit.inductor == Wiring::Series {
            let text = || {
                "says how an inductor stands, but there is none; give `inductance` or leave it out"
                    .to_owned()
            };
            broken.push(|| format!("circuit.{name}.inductor"), text);
        }
        if circuit.resistance_ohm.is_finite() && circuit.battery_v.is_some() {
            let text = || {
                "has no effect: a battery takes the charge; leave it out, or give `storage` instead of `battery`".to_owned()
            };
            broken.push(|| format!("circuit.{name}.resistance"), text);
        }
        if circuit.leakage_ohm.is_some() && circuit.battery_v.is_some() {
            let text = || {
                "has no effect: the voltage of a battery is fixed; leave it out, or give `storage` instead of `battery`".to_owned()
            };
            broken.push(|| format!("circuit.{name}.leakage_resistance"), text);
        }
        if circuit.wiring == Wiring::Series && circuit.connections().count() == 1 {
            let text = || {
                "says how several patches are connected, but there is one; name them in `patches` or leave it out".to_owned()
            };
            broken.push(|| format!("circuit.{name}.wiring"), text);
        }
    }
    check_electrodes(spec, &carried, broken);
}

/// No patch floats by mistake, and none that is said to is in a circuit.
fn check_electrodes(spec: &Spec, carried: &BTreeMap<&str, &str>, broken: &mut ValidationFaults) {
    // Which patch is meant by a circuit that names none, or one that is not there, is not known.
    let named = |circuit: &Circuit| {
        circuit.connections().count() > 0
            && circuit
                .connections()
                .all(|(patch, _)| has_patch(spec, patch))
    };
    let all_named = spec.circuit.values().all(named);
    let own = spec
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
    for (path, name, electrodes) in own.chain(modal) {
        let key = || format!("{path}.electrodes");
        match (electrodes, carried.get(name.as_str())) {
            (Electrodes::Circuit, None) if all_named => {
                let text = "no circuit names this patch, so that it floats; name it in a [circuit.NAME], or give electrodes = \"open\"";
                broken.push(key, || text.to_owned());
            }
            (Electrodes::Open, Some(circuit)) => {
                let text = || {
                    format!(
                        "is \"open\", but circuit \"{}\" names this patch; leave one of them out",
                        clip(circuit)
                    )
                };
                broken.push(key, text);
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
