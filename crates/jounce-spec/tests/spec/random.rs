//! Random valid specs.

use std::collections::BTreeMap;

use jounce_spec::*;
use proptest::prelude::*;

fn positive() -> impl Strategy<Value = f64> {
    (-9.0..9.0f64).prop_map(|exponent| 10f64.powf(exponent))
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![positive(), positive().prop_map(|x| -x), Just(0.0)]
}

fn name() -> impl Strategy<Value = String> {
    "[A-Za-z0-9_-]{1,8}".prop_filter("taken", |name| {
        !["ground", "nothing", "root", "end"].contains(&name.as_str())
    })
}

fn law() -> impl Strategy<Value = StopLaw> {
    let exponent = prop_oneof![Just(1.0), Just(1.5), 1.0..10.0f64];
    prop_oneof![
        (positive(), exponent.clone()).prop_map(|(stiffness, exponent)| StopLaw::Hertz {
            stiffness,
            exponent
        }),
        positive().prop_map(|stiffness_n_m| StopLaw::Spring { stiffness_n_m }),
        (positive(), positive()).prop_map(|(stiffness_n_m, damping_n_s_m)| StopLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m
        }),
        (positive(), exponent, positive()).prop_map(|(stiffness, exponent, damping_s_m)| {
            StopLaw::HuntCrossley {
                stiffness,
                exponent,
                damping_s_m,
            }
        }),
        (any_number(), any_number()).prop_map(|(stiffness_n_m, cubic_stiffness_n_m3)| {
            StopLaw::Cubic {
                stiffness_n_m,
                cubic_stiffness_n_m3,
            }
        }),
        (0.0..=1.0f64).prop_map(|restitution| StopLaw::Rigid { restitution }),
    ]
}

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

fn patch(beam: (String, Beam)) -> impl Strategy<Value = Patch> {
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
                d31_m_per_v: (start < 0.3).then_some(d31),
                d33_m_per_v: (start >= 0.3).then_some(d31),
                electrode_spacing_m: (start >= 0.3).then_some(thickness_m),
                capacitance_f: (width < 0.5).then_some(capacitance_f),
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
            },
        )
}

fn structure() -> impl Strategy<Value = Spec> {
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

fn points(spec: &Spec) -> Vec<String> {
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

fn stop(points: Vec<String>) -> impl Strategy<Value = Stop> {
    let side = prop_oneof![Just(Side::Positive), Just(Side::Negative)];
    let frames: Vec<String> = points
        .iter()
        .cloned()
        .chain(["ground".to_owned()])
        .collect();
    (
        prop::sample::select(points),
        prop::sample::select(frames),
        side,
        any_number(),
        law(),
    )
        .prop_map(|(at, frame, side, gap_m, law)| {
            let frame = if frame == at {
                "ground".to_owned()
            } else {
                frame
            };
            Stop {
                at,
                frame,
                side,
                gap_m,
                law,
            }
        })
}

fn drive(points: Vec<String>) -> impl Strategy<Value = Drive> {
    (
        prop::sample::select(points),
        positive(),
        1e-6..1e6f64,
        any_number(),
    )
        .prop_map(|(at, amplitude, frequency_hz, phase_rad)| Drive {
            at,
            kind: DriveKind::Force,
            signal: DriveSignal::Sine {
                amplitude,
                frequency_hz,
                phase_rad,
            },
        })
}

fn run() -> impl Strategy<Value = Run> {
    let start = prop_oneof![
        Just(Start::Rest),
        Just(Start::Linear),
        "[a-z \"\\\\\u{e9}]{0,8}[a-z]\\.json".prop_map(Start::State)
    ];
    (start, positive(), 0.001..=1.0f64, -12.0..-1.0f64).prop_map(
        |(start, duration_s, part, digits)| Run {
            start,
            duration_s,
            average_over_s: part * duration_s,
            tolerance: 10f64.powf(digits),
        },
    )
}

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
