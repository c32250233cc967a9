//! Circuits: every patch exists and carries one circuit, and wiring says something.

use std::cell::LazyCell;
use std::collections::BTreeMap;

use super::Broken;
use super::reference::{patches, unknown};
use crate::spec::nearest::clip;
use crate::spec::{Spec, Wiring};

pub(super) fn check(spec: &Spec, broken: &mut Broken) {
    // Listed once, and only if something is wrong.
    let known = LazyCell::new(|| patches(spec));
    let mut carried: BTreeMap<&str, &str> = BTreeMap::new();
    for (name, circuit) in &spec.circuit {
        let key = || if circuit.patch.is_empty() { format!("circuit.{name}.patches") } else { format!("circuit.{name}.patch") };
        for (patch, _) in circuit.connections() {
            if !has_patch(spec, patch) {
                let words = || known.iter().map(String::as_str);
                broken.push(key, || unknown("patch", patch, "patches", words));
            } else if carried.get(patch) == Some(&name.as_str()) {
                broken.push(key, || format!("patch \"{}\" stands twice in the list; name each patch once", clip(patch)));
            } else if let Some(first) = carried.get(patch) {
                let text = || format!("patch \"{}\" carries circuit \"{}\" already; give each patch one circuit", clip(patch), clip(first));
                broken.push(key, text);
            } else {
                carried.insert(patch, name);
            }
        }
        if circuit.inductance_h.is_none() && circuit.inductor == Wiring::Series {
            let text = || "says how an inductor stands, but there is none; give `inductance` or leave it out".to_owned();
            broken.push(|| format!("circuit.{name}.inductor"), text);
        }
        if circuit.resistance_ohm.is_finite() && circuit.battery_v.is_some() {
            let text = || "has no effect: a battery takes the charge; leave it out, or give `storage` instead of `battery`".to_owned();
            broken.push(|| format!("circuit.{name}.resistance"), text);
        }
        if circuit.leakage_ohm.is_some() && circuit.battery_v.is_some() {
            let text =
                || "has no effect: the voltage of a battery is fixed; leave it out, or give `storage` instead of `battery`".to_owned();
            broken.push(|| format!("circuit.{name}.leakage_resistance"), text);
        }
        if circuit.wiring == Wiring::Series && circuit.connections().count() == 1 {
            let text = || "says how several patches are connected, but there is one; name them in `patches` or leave it out".to_owned();
            broken.push(|| format!("circuit.{name}.wiring"), text);
        }
    }
}

fn has_patch(spec: &Spec, name: &str) -> bool {
    let Some((body, patch)) = name.split_once('.') else { return spec.patch.contains_key(name) };
    spec.modal.get(body).is_some_and(|modal| modal.patch.contains_key(patch))
}
