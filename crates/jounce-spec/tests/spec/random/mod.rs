//! Random valid specs.

mod excitation;
mod structure;
mod value;

use std::collections::BTreeMap;

use jounce_spec::*;
use proptest::prelude::*;

use excitation::{drive, run, stop};
use structure::{patch, points, structure};
use value::{name, positive};

/// Generates a valid spec of any structure, with any laws, circuits and drives.
pub fn spec() -> impl Strategy<Value = Spec> {
    structure().prop_flat_map(|spec| {
        let patches: Vec<_> = spec.beam.clone().into_iter().map(patch).collect();
        let stops = prop::collection::btree_map(name(), stop(points(&spec)), 0..4);
        let drives = prop::collection::btree_map(name(), drive(points(&spec)), 0..3);
        let ratios = prop::collection::vec(0.0..1.0f64, 0..5);
        let reduction = (-12.0..-1.0f64).prop_map(|digits| Reduction {
            modes: 8,
            mesh_tolerance: 10f64.powf(digits),
        });
        let circuit = prop::collection::vec((name(), positive()), 8);
        (
            (Just(spec), patches, stops, drives),
            (run(), ratios, reduction, 0.0..1.0f64, circuit),
        )
            .prop_map(assemble)
    })
}

/// A resistor; in a quarter of the cases with an inductor and a list of one patch.
fn circuit(patch: String, resistance_ohm: f64) -> Circuit {
    let many = resistance_ohm.to_bits().is_multiple_of(4);
    let direct = Circuit::resistor(
        if many { String::new() } else { patch.clone() },
        resistance_ohm,
    );
    Circuit {
        patches: if many {
            vec![format!("-{patch}")]
        } else {
            Vec::new()
        },
        inductance_h: many.then_some(resistance_ohm),
        inductor: if many {
            Wiring::Series
        } else {
            Wiring::Parallel
        },
        ..direct
    }
}

/// No body lies inside a rigid stop, and no free mass inside any stop: gaps are positive there. A
/// mass has an initial velocity where no beam is clamped to it and no file specifies the start.
fn separate(spec: &mut Spec) {
    let free = |point: &str| {
        spec.mass
            .get(point.split('.').next().unwrap())
            .is_some_and(|mass| mass.on == "nothing")
    };
    let carried = |point: &str| {
        spec.beam
            .get(point.split('.').next().unwrap())
            .is_some_and(|beam| beam.root != "ground")
    };
    let touching: Vec<String> = (spec.stop.iter())
        .filter(|(_, stop)| {
            matches!(stop.law, StopLaw::Rigid { .. })
                || [&stop.at, &stop.frame]
                    .iter()
                    .any(|point| free(point) || carried(point))
        })
        .map(|(name, _)| name.clone())
        .collect();
    touching.iter().for_each(|name| {
        let stop = spec.stop.get_mut(name).unwrap();
        stop.gap_m = stop.gap_m.abs();
    });
    let from_file = matches!(spec.run.start, Start::State(_));
    for (name, mass) in &mut spec.mass {
        if from_file || spec.beam.values().any(|beam| beam.root == *name) {
            mass.velocity_m_s = None;
        }
    }
}

type Things = (
    Spec,
    Vec<Patch>,
    BTreeMap<String, Stop>,
    BTreeMap<String, Drive>,
);
type Settings = (Run, Vec<f64>, Reduction, f64, Vec<(String, f64)>);

fn assemble(
    ((mut spec, patches, stop, drive), (run, ratios, reduction, beyond, loads)): (Things, Settings),
) -> Spec {
    spec.patch = patches
        .into_iter()
        .enumerate()
        .map(|(index, patch)| (format!("p{index}"), patch))
        .collect();
    let modal = spec.modal.iter().flat_map(|(body, modal)| {
        modal
            .patch
            .keys()
            .map(move |patch| format!("{body}.{patch}"))
    });
    let names: Vec<String> = spec.patch.keys().cloned().chain(modal).collect();
    spec.circuit = names
        .into_iter()
        .zip(loads)
        .map(|(patch, (name, resistance_ohm))| (name, circuit(patch, resistance_ohm)))
        .collect();
    // If two circuits have one name, the second is used; the patch of the first is left open.
    let connected: Vec<String> = spec
        .circuit
        .values()
        .flat_map(|circuit| circuit.connections().map(|(patch, _)| patch.to_owned()))
        .collect();
    let modal = spec.modal.iter_mut().flat_map(|(body, modal)| {
        let patches = modal.patch.iter_mut();
        patches.map(move |(name, patch)| (format!("{body}.{name}"), &mut patch.electrodes))
    });
    let direct = spec
        .patch
        .iter_mut()
        .map(|(name, patch)| (name.clone(), &mut patch.electrodes));
    direct
        .chain(modal)
        .filter(|(name, _)| !connected.contains(name))
        .for_each(|(_, electrodes)| *electrodes = Electrodes::Open);
    // A thin skin without mass prints and reads its unused density like any other value.
    let mut spec = Spec {
        stop,
        drive,
        run,
        reduction,
        damping: Damping {
            ratios,
            beyond: Some(beyond),
        },
        ..spec
    };
    separate(&mut spec);
    spec
}
