//! Derivative of the flow against differences of the flow, its determinant and the closed form of
//! the impact oscillator.

use crate::contacts::ports::{between_stops, coupled};
use crate::plants::{bench, kernel};
use jounce_analysis::Model;
use jounce_dynamics::{FlowSensitivity, Integrator, Kernel, ParameterSensitivity};
use jounce_model::contact::{Cubic, Hertz, HuntCrossley, KelvinVoigt, Law, Rigid};
use jounce_model::drive::Wave;
use jounce_model::plant::{Signal, System};
use jounce_model::reference::ImpactOscillator;
use jounce_spec::Spec;

/// A state after some contacts, and one drive period from there.
pub fn state_after_contacts(kernel: &Kernel) -> (Vec<f64>, f64) {
    let period_s = 1.0 / kernel.plant.system.drives[0].frequency_hz;
    let y = kernel
        .plant
        .from_physical(&vec![0.0; kernel.plant.len()], 0.0);
    let mut integrator = Integrator::new(kernel, &y, 0.0, 1e-11).unwrap();
    integrator.advance_to(30.0 * period_s).unwrap();
    (integrator.state(), period_s)
}

/// Start time of every check: any integer number of periods is equivalent to time 0.
const START_S: f64 = 0.0;

fn end_state(kernel: &Kernel, y: &[f64], duration_s: f64) -> Vec<f64> {
    let mut integrator = Integrator::new(kernel, y, START_S, 1e-13).unwrap();
    integrator.advance_to(START_S + duration_s).unwrap();
    integrator.state()
}

fn with_law(mut system: System, law: Law) -> System {
    system.stops[0].law = law;
    system
}

/// Largest error of the Jacobian against central differences, relative to its largest entry, on an
/// interval with contacts.
fn jacobian_error(kernel: &Kernel, y: &[f64], duration_s: f64) -> f64 {
    let sensitivity = FlowSensitivity::integrate(
        kernel,
        y,
        START_S,
        duration_s,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap();
    assert!(
        sensitivity.statistics.contacts > 0 || sensitivity.statistics.time_s > 0.0,
        "the check needs a contact"
    );
    against_differences(kernel, y, duration_s, &sensitivity)
}

/// Error of the Jacobian on any interval.
pub fn against_differences(
    kernel: &Kernel,
    y: &[f64],
    duration_s: f64,
    sensitivity: &FlowSensitivity,
) -> f64 {
    let size = y.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for j in 0..y.len() {
        let step = 1e-5 * size;
        let perturbed = |sign: f64| {
            let mut y = y.to_vec();
            y[j] += sign * step;
            end_state(kernel, &y, duration_s)
        };
        let (plus, minus) = (perturbed(1.0), perturbed(-1.0));
        for i in 0..y.len() {
            let difference = (plus[i] - minus[i]) / (2.0 * step);
            worst = worst.max((difference - sensitivity.jacobian[(i, j)]).abs());
            largest = largest.max(difference.abs());
        }
    }
    worst / largest
}

#[test]
fn jacobian_is_the_difference_of_flows_for_every_law() {
    let hertz = Hertz {
        stiffness: 1000.0,
        exponent: 1.5,
    };
    for (name, law) in [
        ("hertz", Law::Hertz(hertz)),
        (
            "spring",
            Law::Hertz(Hertz {
                stiffness: 100.0,
                exponent: 1.0,
            }),
        ),
        (
            "kelvin-voigt",
            Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m: 100.0,
                damping_n_s_m: 0.1,
            }),
        ),
        (
            "hunt-crossley",
            Law::HuntCrossley(HuntCrossley {
                elastic: hertz,
                damping_s_m: 0.3,
            }),
        ),
        (
            "cubic",
            Law::Cubic(Cubic {
                stiffness_n_m: 10.0,
                cubic_stiffness_n_m3: 1e5,
            }),
        ),
    ] {
        let kernel = kernel(with_law(bench(50.0, 11.0), law));
        let (y, period_s) = state_after_contacts(&kernel);
        let largest_error = jacobian_error(&kernel, &y, period_s);
        eprintln!("{name}: {largest_error:.1e}");
        assert!(largest_error < 1e-5, "{name}: {largest_error:e}");
    }
}

#[test]
fn jacobian_is_the_difference_of_flows_for_two_stops() {
    let mut mixed = coupled();
    mixed.stops[0].law = Law::KelvinVoigt(KelvinVoigt {
        stiffness_n_m: 2e4,
        damping_n_s_m: 3.0,
    });
    mixed.stops[1].law = Law::HuntCrossley(HuntCrossley {
        elastic: Hertz {
            stiffness: 2e5,
            exponent: 1.5,
        },
        damping_s_m: 0.4,
    });
    let mut rigid = coupled();
    rigid.stops[1].law = Law::Rigid(Rigid { restitution: 0.8 });
    for (name, system, allowed) in [
        ("both sides", between_stops(100.0, 11.0), 1e-5),
        ("overlapping", coupled(), 1e-5),
        ("mixed", mixed, 1e-4),
        ("rigid", rigid, 1e-4),
    ] {
        let kernel = kernel(system);
        let (y, period_s) = state_after_contacts(&kernel);
        let largest_error = jacobian_error(&kernel, &y, period_s);
        eprintln!("{name}: {largest_error:.1e}");
        assert!(largest_error < allowed, "{name}: {largest_error:e}");
    }
}

/// With one mode the rebounds from a rigid stop are clean; many modes chatter.
#[test]
fn jacobian_is_the_difference_of_flows_for_a_rigid_stop() {
    let oscillator = ImpactOscillator {
        frequency_ratio: 0.8,
        damping_ratio: 0.05,
        restitution: 0.8,
        gap: 0.5,
    };
    let kernel = kernel(oscillator.system(0.0));
    let (y, period_s) = state_after_contacts(&kernel);
    let largest_error = jacobian_error(&kernel, &y, period_s);
    eprintln!("rigid: {largest_error:.1e}");
    assert!(largest_error < 1e-6, "{largest_error:e}");
}

/// A ball that falls under gravity on a shaken table, compliant or rigid.
fn ball(stop: &str) -> Kernel {
    let text = format!(
        "[mass.ball]\non = \"nothing\"\nmass = \"0.5 kg\"\n[stop.t]\nat = \"ball\"\nside = \"negative\"\ngap = \"0 mm\"\n{stop}\n\
         [gravity]\nacceleration = \"-9.81 m/s^2\"\n[drive.b]\nkind = \"base-acceleration\"\namplitude = \"13 m/s^2\"\nfrequency = \"5 Hz\"\nphase = \"0.4 rad\"\n"
    );
    Model::new(Spec::from_toml(&text).unwrap()).unwrap().kernel
}

/// Constant forces on modes with restoring forces and on a free body, which has none. Includes the
/// derivative by the duration. Measured: 5e-10 to 3e-6, the largest for the ball and Kelvin and
/// Voigt; by the duration 2e-9.
#[test]
fn jacobian_is_the_difference_of_flows_under_gravity() {
    let hertz = Hertz {
        stiffness: 1000.0,
        exponent: 1.5,
    };
    let bench = |law: Law| {
        let mut system = with_law(bench(50.0, 11.0), law);
        let shape = system.modes.participation_sqrt_kg.clone();
        let shape = if shape.iter().all(|p| *p == 0.0) {
            system.stops[0].shape.clone()
        } else {
            shape
        };
        system.signals.push(Signal {
            name: "gravity".to_owned(),
            shape,
            wave: Wave::Constant(0.1),
            base: None,
        });
        kernel(system)
    };
    for (name, kernel) in [
        ("hertz", bench(Law::Hertz(hertz))),
        (
            "kelvin-voigt",
            bench(Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m: 100.0,
                damping_n_s_m: 0.1,
            })),
        ),
        (
            "hunt-crossley",
            bench(Law::HuntCrossley(HuntCrossley {
                elastic: hertz,
                damping_s_m: 0.3,
            })),
        ),
        (
            "ball, hunt-crossley",
            ball("law = \"hunt-crossley\"\nstiffness = \"1e5 N/m^1.5\"\ndamping = \"0.3 s/m\""),
        ),
        (
            "ball, kelvin-voigt",
            ball("law = \"kelvin-voigt\"\nstiffness = \"1e4 N/m\"\ndamping = \"9 N s/m\""),
        ),
        ("ball, rigid", ball("law = \"rigid\"\nrestitution = 0.8")),
    ] {
        let (y, period_s) = state_after_contacts(&kernel);
        let largest_error = jacobian_error(&kernel, &y, period_s);
        let rate = FlowSensitivity::integrate(
            &kernel,
            &y,
            START_S,
            period_s,
            1e-12,
            &ParameterSensitivity::default(),
        )
        .unwrap()
        .rate;
        let h = 1e-6 * period_s;
        let (later, earlier) = (
            end_state(&kernel, &y, period_s + h),
            end_state(&kernel, &y, period_s - h),
        );
        let size = rate.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
        let duration_error = (0..y.len())
            .map(|i| ((later[i] - earlier[i]) / (2.0 * h) - rate[i]).abs() / size)
            .fold(0.0, f64::max);
        eprintln!(
            "under gravity, {name}: {largest_error:.1e}, by the duration {duration_error:.1e}"
        );
        assert!(
            largest_error < 1e-5 && duration_error < 1e-5,
            "{name}: {largest_error:e} {duration_error:e}"
        );
    }
}

/// An elastic contact preserves volume: the determinant over a period is that of the linear plant,
/// `exp(T trace A)`.
#[test]
fn determinant_is_that_of_the_plant() {
    let kernel = kernel(bench(50.0, 11.0));
    let (y, period_s) = state_after_contacts(&kernel);
    let sensitivity = FlowSensitivity::integrate(
        &kernel,
        &y,
        START_S,
        period_s,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap();
    let trace: f64 = kernel
        .plant
        .diagonal
        .block
        .eigenvalues()
        .iter()
        .map(|value| value.re)
        .sum();
    let jacobian_error = sensitivity.jacobian.determinant() / (trace * period_s).exp() - 1.0;
    eprintln!("determinant: {jacobian_error:.1e}");
    assert!(jacobian_error.abs() < 1e-6, "{jacobian_error:e}");
}

/// Trace and determinant of the period map of the impact oscillator.
#[test]
fn rigid_impact_has_the_multipliers_of_the_closed_form() {
    for (frequency_ratio, damping_ratio, gap) in [(0.8, 0.05, 0.5), (2.0, 1e-6, 0.0)] {
        let oscillator = ImpactOscillator {
            frequency_ratio,
            damping_ratio,
            restitution: 0.8,
            gap,
        };
        let orbit = oscillator.orbits(1)[0];
        let kernel = kernel(oscillator.system(orbit.angle_rad));
        let period_s = std::f64::consts::TAU / frequency_ratio;
        let mut integrator = Integrator::new(
            &kernel,
            &kernel.plant.from_physical(&oscillator.start(&orbit), 0.0),
            0.0,
            1e-13,
        )
        .unwrap();
        integrator.advance_to(0.4 * period_s).unwrap();
        let sensitivity = FlowSensitivity::integrate(
            &kernel,
            &integrator.state(),
            0.4 * period_s,
            period_s,
            1e-13,
            &ParameterSensitivity::default(),
        )
        .unwrap();
        let [trace, determinant] = orbit.trace_determinant;
        let errors = [
            sensitivity.jacobian[(0, 0)] + sensitivity.jacobian[(1, 1)] - trace,
            sensitivity.jacobian.determinant() - determinant,
        ];
        eprintln!("w = {frequency_ratio}: errors {errors:?}");
        assert!(
            errors[0].abs() < 1e-9 && errors[1].abs() < 1e-9,
            "{errors:?}"
        );
    }
}

/// Derivatives by gap, stiffness and drive, against differences of flows of modified systems.
#[test]
fn drift_is_the_difference_of_flows_of_changed_systems() {
    let base = bench(50.0, 11.0);
    let at = kernel(base.clone());
    let (y, period_s) = state_after_contacts(&at);
    let changed = |change: &dyn Fn(&mut System, f64), step: f64| -> Vec<f64> {
        let perturbed = |sign: f64| {
            let mut system = base.clone();
            change(&mut system, sign * step);
            end_state(&kernel(system), &y, period_s)
        };
        perturbed(1.0)
            .iter()
            .zip(perturbed(-1.0))
            .map(|(plus, minus)| (plus - minus) / (2.0 * step))
            .collect()
    };
    let w = at.plant.tones[0].angular_frequency_rad_s;
    let steady = at.plant.ports[0].steady_m[0];
    let with_drive = |step: f64| {
        let mut drives = base.drives.clone();
        drives[0].frequency_hz += step;
        at.plant.with_drives(drives).unwrap().ports[0].steady_m[0]
    };
    let by_frequency = (with_drive(1e-6) - with_drive(-1e-6)) / 2e-6;
    type Change = Box<dyn Fn(&mut System, f64)>;
    let cases: [(&str, Change, f64, ParameterSensitivity); 4] = [
        (
            "gap",
            Box::new(|system, d| system.stops[0].gap_m += d),
            1e-8,
            ParameterSensitivity {
                gap_m: vec![1.0],
                ..ParameterSensitivity::default()
            },
        ),
        (
            "stiffness",
            Box::new(|system, d| {
                system.stops[0].law = Law::Hertz(Hertz {
                    stiffness: 1000.0 + d,
                    exponent: 1.5,
                })
            }),
            1e-2,
            ParameterSensitivity {
                force_relative: vec![1e-3],
                ..ParameterSensitivity::default()
            },
        ),
        (
            "amplitude",
            Box::new(|system, d| system.drives[0].amplitude_n += d),
            1e-3,
            ParameterSensitivity {
                tones: vec![(vec![steady / 50.0], 0.0)],
                ..ParameterSensitivity::default()
            },
        ),
        (
            "frequency",
            Box::new(|system, d| system.drives[0].frequency_hz += d),
            1e-6,
            ParameterSensitivity {
                tones: vec![(vec![by_frequency], w / 11.0)],
                ..ParameterSensitivity::default()
            },
        ),
    ];
    for (name, change, step, drift) in cases {
        let expected = changed(&change, step);
        let sensitivity = FlowSensitivity::integrate(&at, &y, START_S, period_s, 1e-12, &drift)
            .unwrap()
            .drift;
        let size = expected.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
        let jacobian_error = expected
            .iter()
            .zip(&sensitivity)
            .fold(0.0_f64, |max, (a, b)| max.max((a - b).abs()))
            / size;
        eprintln!("{name}: {jacobian_error:.1e}");
        assert!(jacobian_error < 1e-5, "{name}: {jacobian_error:e}");
    }
}
