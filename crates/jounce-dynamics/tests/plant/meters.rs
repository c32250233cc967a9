//! Energy meters against closed forms and quadrature.

use crate::systems::{bench, menagerie};
use jounce_dynamics::{Integrator, Kernel};
use jounce_model::contact::{Hertz, HuntCrossley, Law};
use jounce_model::drive::Wave;
use jounce_model::plant::{Drive, Meters, Plant, Signal, Stop, System};
use jounce_model::reference::Impulse;
use std::f64::consts::TAU;
use std::sync::Arc;

/// An efficiency from the meter only: the energy in the resistor after a blow, from the two ends of
/// the flow.
#[test]
fn meter_of_a_blow_is_the_closed_form() {
    let blow = Impulse {
        alpha: 0.8,
        coupling_squared: 0.1,
        damping_ratio: 0.01,
    };
    let mut system = blow.oscillator().system(0.0, 1.0);
    system.drives.clear();
    let plant = Plant::new(system).unwrap();
    let meters = Meters::new(&plant).unwrap();
    let y = plant.from_physical(&[0.0, 1.0, 0.0], 0.0);
    let delivered =
        meters.loads[0].boundary_j(&[0.0; 3], 0.0) - meters.loads[0].boundary_j(&y, 0.0);
    assert!(
        (delivered / 0.5 / blow.efficiency() - 1.0).abs() < 1e-13,
        "{delivered}"
    );
}

/// Seven Gauss points: exact to degree 13.
const GAUSS: [(f64, f64); 4] = [
    (0.0, 0.417_959_183_673_469_4),
    (0.405_845_151_377_397_2, 0.381_830_050_505_118_9),
    (0.741_531_185_599_394_4, 0.279_705_391_489_276_7),
    (0.949_107_912_342_758_5, 0.129_484_966_168_869_7),
];

/// Times and weights of composite Gauss quadrature over the pieces between `marks`, no panel longer
/// than `longest_s`.
fn quadrature(marks: &[f64], longest_s: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut times, mut weights) = (Vec::new(), Vec::new());
    for ends in marks.windows(2) {
        let panels = ((ends[1] - ends[0]) / longest_s).ceil().max(1.0);
        let half = 0.5 * (ends[1] - ends[0]) / panels;
        for panel in 0..panels as usize {
            let middle = ends[0] + half * (2 * panel + 1) as f64;
            let left = GAUSS.iter().skip(1).rev().map(|(x, w)| (-x, *w));
            for (x, w) in left.chain(GAUSS.iter().copied()) {
                times.push(middle + half * x);
                weights.push(half * w);
            }
        }
    }
    (times, weights)
}

/// Force of each drive and signal, and the velocity of its point.
fn driven(system: &System, velocities: &[f64], time_s: f64) -> Vec<(f64, f64)> {
    let velocity =
        |shape: &[f64]| -> f64 { shape.iter().zip(velocities).map(|(s, v)| s * v).sum() };
    let drives = system.drives.iter().map(|drive| {
        let force_n =
            drive.amplitude_n * (TAU * drive.frequency_hz * time_s + drive.phase_rad).sin();
        (force_n, velocity(&drive.shape))
    });
    let signals = system.signals.iter().map(|signal| {
        let piece = signal.wave.piece(signal.wave.index_at(time_s));
        (piece.size_at(time_s), velocity(&signal.shape))
    });
    drives.chain(signals).collect()
}

/// Loads, damping and input of a recorded run by quadrature of the physical powers, against the
/// exact integrals.
fn assert_meters(name: &str, system: System, start: &[f64], duration_s: f64, allowed: f64) {
    let kernel = Kernel::new(Plant::new(system).unwrap()).unwrap();
    let plant = &kernel.plant;
    let mut integrator =
        Integrator::new(&kernel, &plant.from_physical(start, 0.0), 0.0, 1e-11).unwrap();
    integrator.start_record();
    integrator.advance_to(duration_s).unwrap();
    let energies = integrator.energies();
    let contacts = integrator.statistics().contacts;
    let record = integrator.take_record();
    let marks: Vec<f64> = record
        .segments()
        .iter()
        .map(|segment| segment.start_s)
        .chain([duration_s])
        .collect();
    let (times, weights) = quadrature(&marks, (0.5 / plant.fastest_rad_s()).min(0.02));
    let (system, modes, n) = (&plant.system, &plant.system.modes, plant.system.modes.len());
    let (mut loads, mut damping, mut input) = (vec![0.0; system.loads.len()], 0.0, 0.0);
    for (at, weight) in record.at(&kernel, &times).iter().zip(&weights) {
        let x = plant.to_physical(&at.state, at.time_s);
        for (sum, load) in loads.iter_mut().zip(&system.loads) {
            let patch = modes
                .patch
                .keys()
                .position(|name| *name == load.connections[0].patch)
                .unwrap();
            *sum += weight * x[2 * n + patch].powi(2) / load.resistance_ohm;
        }
        damping += weight
            * (0..n)
                .map(|i| 2.0 * modes.damping_ratio[i] * modes.frequency_rad_s[i] * x[n + i].powi(2))
                .sum::<f64>();
        for (force_n, velocity) in driven(system, &x[n..], at.time_s) {
            input += weight * force_n * velocity;
        }
    }
    let meters: Vec<f64> = energies
        .loads_j
        .iter()
        .copied()
        .chain([energies.damping_j, energies.input_j])
        .collect();
    let exact: Vec<f64> = loads.into_iter().chain([damping, input]).collect();
    let errors: Vec<f64> = meters
        .iter()
        .zip(&exact)
        .map(|(a, b)| (a - b).abs() / b.abs().max(1e-6 * energies.scale_j))
        .collect();
    eprintln!("{name}: {contacts} contacts, loads, damping, input {errors:?}");
    assert!(
        errors.iter().all(|e| *e < allowed),
        "{name}: {meters:?} {exact:?} {errors:?}"
    );
    assert!(
        contacts > 0 || system.stops.is_empty(),
        "{name}: no contact"
    );
}

fn drive(shape: &[f64], amplitude_n: f64, frequency_hz: f64, phase_rad: f64) -> Drive {
    Drive {
        name: format!("drive-{frequency_hz}"),
        shape: shape.to_vec(),
        amplitude_n,
        frequency_hz,
        phase_rad,
        base: None,
    }
}

#[test]
fn meters_agree_with_quadrature_along_the_flow() {
    let mut system = menagerie();
    // A drive on a rigid-body mode makes it drift at constant speed, so its energies and their
    // roundoff grow.
    let shape = [0.0, 0.5, -0.7, 0.3, 1.1, 2.0];
    system.drives = vec![
        drive(&shape, 3.0, 1.3, 0.4),
        drive(&shape, 2.0, 7.0, 0.0),
        drive(&shape, 1.0, 1.3, -1.0),
    ];
    let start = [
        0.1, 0.2, -0.3, 0.1, 0.0, 0.01, 0.5, -1.0, 0.0, 2.0, 1.0, 0.0, 10.0, -5.0,
    ];
    assert_meters("menagerie", system, &start, 3.0, 1e-10);
    let mut free = bench();
    free.stops.clear();
    assert_meters("bench without stop", free, &[0.0; 17], 1.0, 1e-10);
}

#[test]
fn meters_agree_with_quadrature_through_contacts() {
    assert_meters("bench", bench(), &[0.0; 17], 1.0, 1e-9);
    let mut lossy = bench();
    let elastic = Hertz {
        stiffness: 1e5,
        exponent: 1.5,
    };
    lossy.stops[0].law = Law::HuntCrossley(HuntCrossley {
        elastic,
        damping_s_m: 0.3,
    });
    assert_meters("bench, lossy stop", lossy, &[0.0; 17], 1.0, 1e-9);
    let mut system = menagerie();
    let shape = [1.0, 0.5, -0.7, 0.3, 1.1, 2.0];
    system.stops = vec![Stop {
        name: "stop".into(),
        shape: shape.to_vec(),
        gap_m: 0.05,
        law: Law::Hertz(Hertz {
            stiffness: 1e3,
            exponent: 1.5,
        }),
        bases: Vec::new(),
    }];
    system.drives = vec![
        drive(&[0.0, 0.5, -0.7, 0.3, 1.1, 2.0], 3.0, 1.3, 0.4),
        drive(&shape, 5.0, 7.0, 0.0),
    ];
    let start = [
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    ];
    assert_meters("menagerie with stop", system, &start, 3.0, 1e-9);
}

/// Gravity, a rough recording that starts late and ends early with a jump, and two tones, on every
/// kind of mode.
fn signals(shape: &[f64], rough: f64) -> Vec<Signal> {
    let sizes: Vec<f64> = (0..40)
        .map(|k: i32| rough * (1.7 * f64::from(k * k)).sin() + 0.3)
        .collect();
    let wave = Wave::Sampled {
        start_s: 0.113,
        step_s: 0.0217,
        sizes: sizes.into(),
    };
    vec![
        Signal {
            name: "gravity".into(),
            shape: shape.iter().map(|s| 0.5 * s + 0.1).collect(),
            wave: Wave::Constant(-0.7),
            base: None,
            drawn_from: None,
        },
        Signal {
            name: "rough".into(),
            shape: shape.to_vec(),
            wave,
            base: None,
            drawn_from: None,
        },
    ]
}

#[test]
fn meters_agree_with_quadrature_under_signals_for_each_kind_of_mode() {
    for mode in 0..6 {
        let mut system = menagerie();
        system.loads.clear();
        let modes = Arc::make_mut(&mut system.modes);
        modes.patch.clear();
        modes.frequency_rad_s = vec![modes.frequency_rad_s[mode]];
        modes.damping_ratio = vec![modes.damping_ratio[mode]];
        modes.shape.clear();
        for count in [1, 2] {
            system.signals = signals(&[0.7], 2.0)[..count].to_vec();
            assert_meters(
                &format!("mode {mode}, {count} signals"),
                system.clone(),
                &[0.0, 0.5],
                1.5,
                1e-10,
            );
        }
        system.drives = vec![drive(&[0.7], 3.0, 1.3, 0.4)];
        assert_meters(
            &format!("mode {mode}, signals and a tone"),
            system,
            &[0.0, 0.5],
            1.5,
            1e-10,
        );
    }
}

#[test]
fn meters_agree_with_quadrature_under_signals_and_tones() {
    let shape = [0.4, 0.5, -0.7, 0.3, 1.1, 2.0];
    let start = [
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    ];
    for with_tones in [false, true] {
        let mut system = menagerie();
        system.signals = signals(&shape, 2.0);
        if with_tones {
            system.drives = vec![drive(&shape, 3.0, 1.3, 0.4), drive(&shape, 2.0, 7.0, 0.0)];
        }
        assert_meters("menagerie", system.clone(), &start, 1.5, 1e-10);
        let shape = vec![1.0, 0.5, -0.7, 0.3, 1.1, 2.0];
        system.stops = vec![Stop {
            name: "stop".into(),
            shape,
            gap_m: 0.05,
            law: Law::Hertz(Hertz {
                stiffness: 1e3,
                exponent: 1.5,
            }),
            bases: Vec::new(),
        }];
        assert_meters("menagerie with stop", system, &start, 1.5, 1e-9);
    }
    let mut rough = bench();
    let shape: Vec<f64> = rough.drives[0].shape.iter().map(|s| 30.0 * s).collect();
    rough.signals = signals(&shape, 2.0);
    assert_meters("bench", rough, &[0.0; 17], 1.0, 1e-9);
}
