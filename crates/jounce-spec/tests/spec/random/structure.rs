//! Random structures: beams, patches, masses and structures given by their modes.

use jounce_spec::*;
use proptest::prelude::*;

use super::value::{any_number, name, positive};

fn mass() -> impl Strategy<Value = Mass> {
    (positive(), positive(), 0.0..1.0f64, any::<bool>()).prop_map(
        |(mass_kg, stiffness_n_m, damping_ratio, free)| Mass {
            on: if free { "nothing" } else { "ground" }.to_owned(),
            mass_kg,
            rotary_inertia_kg_m2: 0.0,
            stiffness_n_m: (!free).then_some(stiffness_n_m),
            damping_ratio: (!free).then_some(damping_ratio),
            velocity_m_s: free.then_some(stiffness_n_m),
            friction_n_s_m: (free && damping_ratio < 0.5).then_some(damping_ratio),
        },
    )
}

fn beam() -> impl Strategy<Value = Beam> {
    let points = prop::collection::btree_map(name(), 0.0..1.0f64, 0..4);
    (
        (positive(), positive(), positive()),
        (positive(), positive()),
        points,
    )
        .prop_map(
            |((length_m, width_m, thickness_m), (e, density), parts)| Beam {
                material: String::new(),
                length_m,
                width_m,
                thickness_m,
                youngs_modulus_pa: e,
                density_kg_m3: density,
                root: "ground".to_owned(),
                root_stiffness_n_m_rad: (e > 1.0).then_some(density),
                point: parts
                    .into_iter()
                    .map(|(name, part)| (name, part * length_m))
                    .collect(),
            },
        )
}

fn modal() -> impl Strategy<Value = Modal> {
    (1..6usize).prop_flat_map(|modes| {
        let list = || prop::collection::vec(any_number(), modes);
        let patch = (list(), positive()).prop_map(|(coupling_n_per_v, capacitance_f)| ModalPatch {
            leakage_ohm: (capacitance_f > 1.0).then_some(capacitance_f),
            coupling_n_per_v,
            capacitance_f,
            electrodes: Electrodes::Circuit,
        });
        let frequencies = prop::collection::vec(0.0..1e5f64, modes).prop_map(|mut list| {
            list.sort_by(f64::total_cmp);
            list
        });
        let ratios = prop::collection::vec(0.0..1.0f64, modes);
        let participation = prop_oneof![Just(Vec::new()), list()];
        let maps = (
            prop::collection::btree_map(name(), list(), 1..4),
            prop::collection::btree_map(name(), patch, 0..3),
        );
        (frequencies, ratios, participation, maps).prop_map(
            |(frequency_hz, damping_ratio, participation_sqrt_kg, (point, patch))| Modal {
                frequency_hz,
                damping_ratio,
                participation_sqrt_kg,
                point,
                patch,
            },
        )
    })
}

pub fn patch(beam: (String, Beam)) -> impl Strategy<Value = Patch> {
    let section = prop_oneof![Just(Section::ThinSkin), Just(Section::Laminate)];
    let position = (0.0..0.5f64, 0.01..0.49f64);
    (
        position,
        0.01..=1.0f64,
        positive(),
        (positive(), positive(), any_number(), positive()),
        section,
    )
        .prop_map(
            move |(
                (start, length),
                width,
                thickness_m,
                (e, density, d31, capacitance_f),
                section,
            )| Patch {
                on: beam.0.clone(),
                face: if start < 0.25 {
                    Face::Top
                } else {
                    Face::Bottom
                },
                material: if start < 0.1 {
                    "PZT-5A".to_owned()
                } else {
                    String::new()
                },
                start_m: start * beam.1.length_m,
                length_m: length * beam.1.length_m,
                width_m: width * beam.1.width_m,
                thickness_m,
                youngs_modulus_pa: e,
                density_kg_m3: density,
                d31_m_per_v: (start < 0.3).then_some(1e-7 * d31.sin()),
                d33_m_per_v: (start >= 0.3).then_some(1e-7 * d31.sin()),
                electrode_spacing_m: (start >= 0.3).then_some(thickness_m),
                capacitance_f: (width < 0.5).then_some(capacitance_f.min(1.0)),
                permittivity_f_m: (width >= 0.5).then_some(capacitance_f),
                electrodes: Electrodes::Circuit,
                strain_limit: None,
                leakage_ohm: (start < 0.2).then_some(capacitance_f),
                section,
                pores: Default::default(),
                foils: PatchFoils {
                    thickness_m: (start >= 0.2).then_some(thickness_m),
                    ..PatchFoils::default()
                },
                on_plate: Default::default(),
                across: Default::default(),
            },
        )
}

pub fn structure() -> impl Strategy<Value = Spec> {
    let beams = prop::collection::btree_map(name(), beam(), 0..3);
    let masses = prop::collection::btree_map(name(), mass(), 1..3);
    let modals = prop::collection::btree_map(name(), modal(), 0..3);
    (beams, masses, modals, any::<bool>()).prop_map(|(mut beam, mut mass, mut modal, carried)| {
        modal.retain(|name, _| !beam.contains_key(name));
        if carried {
            beam.values_mut()
                .for_each(|beam| beam.root = mass.keys().next().unwrap().clone());
            mass.values_mut()
                .for_each(|mass| mass.friction_n_s_m = None);
        }
        let mut gravity = Gravity::default();
        if mass.values().any(|mass| mass.on == "nothing") {
            gravity.acceleration_m_s2 = Some(9.81);
            modal.values_mut().for_each(|modal| {
                modal
                    .participation_sqrt_kg
                    .resize(modal.frequency_hz.len(), 0.5)
            });
        }
        Spec {
            beam,
            mass,
            modal,
            gravity,
            ..Spec::default()
        }
    })
}

pub fn points(spec: &Spec) -> Vec<String> {
    let ends = spec.beam.keys().map(|name| format!("{name}.end"));
    let named = spec.beam.iter().flat_map(|(body, beam)| {
        beam.point
            .keys()
            .map(move |point| format!("{body}.{point}"))
    });
    let modal = spec.modal.iter().flat_map(|(body, modal)| {
        modal
            .point
            .keys()
            .map(move |point| format!("{body}.{point}"))
    });
    spec.mass
        .keys()
        .cloned()
        .chain(ends)
        .chain(named)
        .chain(modal)
        .collect()
}
