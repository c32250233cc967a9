//! Random small harvesters: the energy balance holds for any plant, law and drive.

use crate::plants::{from_rest, kernel};
use jounce_dynamics::{IntegrationError, Integrator, WorkCount};
use jounce_model::contact::{Cubic, Hertz, HuntCrossley, KelvinVoigt, Law, Rigid, Table};
use jounce_model::plant::{Drive, Load, Stop, System};
use jounce_model::structure::{Modes, PatchModes};
use jounce_spec::ForceCurve;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

fn law() -> impl Strategy<Value = Law> {
    let exponent = prop_oneof![Just(1.0), Just(1.5), 1.0..2.5f64];
    prop_oneof![
        (2.0..6.0f64, exponent.clone()).prop_map(|(decades, exponent)| Law::Hertz(Hertz {
            stiffness: 10f64.powf(decades),
            exponent
        })),
        (2.0..5.0f64, -1.0..1.0f64).prop_map(|(k, c)| {
            Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m: 10f64.powf(k),
                damping_n_s_m: 10f64.powf(c),
            })
        }),
        (2.0..6.0f64, exponent, 0.01..1.0f64).prop_map(|(decades, exponent, damping_s_m)| {
            Law::HuntCrossley(HuntCrossley {
                elastic: Hertz {
                    stiffness: 10f64.powf(decades),
                    exponent,
                },
                damping_s_m,
            })
        }),
        (-100.0..1e3f64, 4.0..8.0f64).prop_map(|(stiffness_n_m, k)| Law::Cubic(Cubic {
            stiffness_n_m,
            cubic_stiffness_n_m3: 10f64.powf(k)
        })),
        table(),
    ]
}

/// Tables of two to six points that harden or soften.
fn table() -> impl Strategy<Value = Law> {
    let steps = prop::collection::vec((-5.0..-2.5f64, 1.0..5.0f64), 1..6);
    let damping = prop_oneof![Just(0.0), 0.01..1.0f64];
    (steps, damping).prop_map(|(steps, damping_s_m)| {
        let mut point = (0.0, 0.0);
        let points = steps.iter().map(|(length, stiffness)| {
            let length_m = 10f64.powf(*length);
            point = (
                point.0 + length_m,
                point.1 + length_m * 10f64.powf(*stiffness),
            );
            point
        });
        let (at, force): (Vec<f64>, Vec<f64>) = points.unzip();
        Law::Table(Table::new(
            ForceCurve::through(&at, &force).unwrap(),
            damping_s_m,
        ))
    })
}

fn modes() -> impl Strategy<Value = Modes> {
    let mode = (
        0.0..2.5f64,
        0.001..0.2f64,
        prop_oneof![-8.0..-0.5f64, 0.5..8.0f64],
        0.1..1.0f64,
        -0.02..0.02f64,
    );
    (prop::collection::vec(mode, 1..5), -8.0..-6.0f64).prop_map(|(modes, capacitance)| Modes {
        frequency_rad_s: modes.iter().map(|mode| TAU * 10f64.powf(mode.0)).collect(),
        damping_ratio: modes.iter().map(|mode| mode.1).collect(),
        shape: BTreeMap::from([
            ("tip".into(), modes.iter().map(|mode| mode.2).collect()),
            ("base".into(), modes.iter().map(|mode| mode.3).collect()),
        ]),
        patch: BTreeMap::from([(
            "patch".into(),
            PatchModes {
                coupling_n_per_v: modes.iter().map(|mode| mode.4).collect(),
                capacitance_f: 10f64.powf(capacitance),
                leakage_ohm: None,
                strain: Vec::new(),
            },
        )]),
        participation_sqrt_kg: vec![0.0; modes.len()],
        base_sqrt_kg: BTreeMap::new(),
        discretisation_error: vec![0.0; modes.len()],
        ..Modes::default()
    })
}

prop_compose! {
    fn harvester()(modes in modes(), law in law(), resistance in 3.0..7.0f64, gap in -1e-3..5e-3f64, amplitude_n in 0.1..50.0f64,
        frequency_hz in 2.0..60.0f64) -> System {
        System {
            loads: vec![Load::resistor("load", "patch", 10f64.powf(resistance))],
            stops: vec![Stop { name: "stop".into(), shape: modes.shape["tip"].clone(), gap_m: gap, law, bases: Vec::new() }],
            drives: vec![Drive { name: "drive".into(), shape: modes.shape["base"].clone(), amplitude_n, frequency_hz, phase_rad: 0.3, base: None }],
            signals: Vec::new(), bridges: Vec::new(), dashpots: Vec::new(),
            modes: modes.into(),
        }
    }
}

fn any_law() -> impl Strategy<Value = Law> {
    prop_oneof![
        3 => law(),
        1 => (0.0..1.0f64).prop_map(|restitution| Law::Rigid(Rigid { restitution })),
    ]
}

/// Stops between tip, base and ground; every second one touches at the start.
fn stops(modes: &Modes) -> impl Strategy<Value = Vec<Stop>> + use<> {
    let (tip, base) = (modes.shape["tip"].clone(), modes.shape["base"].clone());
    let gap = prop_oneof![Just(0.0), -1e-3..5e-3f64];
    prop::collection::vec((0..2_usize, any_law(), gap), 2..4).prop_map(move |parts| {
        let stop = |(index, (place, law, gap_m)): (usize, (usize, Law, f64))| {
            let between: Vec<f64> = tip
                .iter()
                .zip(&base)
                .map(|(tip, base)| base - tip)
                .collect();
            let shape = [&tip, &between][place].clone();
            // Nothing starts inside a rigid stop.
            let gap_m = if matches!(law, Law::Rigid(_)) {
                gap_m.abs()
            } else {
                gap_m
            };
            Stop {
                name: format!("stop{index}"),
                shape,
                gap_m,
                law,
                bases: Vec::new(),
            }
        };
        parts.into_iter().enumerate().map(stop).collect()
    })
}

fn several_stops() -> impl Strategy<Value = System> {
    harvester().prop_flat_map(|system| {
        let modes = Modes {
            shape: BTreeMap::from([
                ("tip".into(), system.stops[0].shape.clone()),
                ("base".into(), system.drives[0].shape.clone()),
            ]),
            ..Modes::default()
        };
        stops(&modes).prop_map(move |stops| System {
            stops,
            ..system.clone()
        })
    })
}

/// Bound on the energy residual of a run with a tolerance of 1e-8. Each step may have an error of a
/// tenth of the tolerance; in an endless contact with a damped law these add up.
fn energy_residual_bound(work: &WorkCount) -> f64 {
    1e-9 * (work.contact_steps as f64).max(100.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn energy_is_balanced(system in harvester()) {
        let result = from_rest(&kernel(system), 1.0, 1e-8);
        let residual = result.energies.residual_relative();
        prop_assert!(residual.abs() < energy_residual_bound(&result.work), "residual {:e} after {} contacts", residual, result.contacts);
    }
}

/// Touching at rest, touching one another and sticking are decided within roundoff. A motion that
/// two rigid stops hold at once is refused. At most two of the others end with an error or with a
/// large energy residual.
#[test]
fn energy_is_balanced_with_several_stops() {
    let mut runner = TestRunner::new_with_rng(
        ProptestConfig::default(),
        TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]),
    );
    let failures: Vec<String> = (0..128)
        .filter_map(|_| {
            let system = several_stops().new_tree(&mut runner).unwrap().current();
            let kernel = kernel(system);
            let start = kernel
                .plant
                .from_physical(&vec![0.0; kernel.plant.len()], 0.0);
            let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-8).unwrap();
            match integrator.advance_to(0.2) {
                Err(IntegrationError::RestsTwice { .. }) => return None,
                Err(error) => return Some(error.to_string()),
                Ok(()) => {}
            }
            let residual = integrator.energies().residual_relative();
            (residual.abs() >= energy_residual_bound(&integrator.work()))
                .then(|| format!("energy residual {residual:e}"))
        })
        .collect();
    assert!(failures.len() <= 2, "{failures:#?}");
}
