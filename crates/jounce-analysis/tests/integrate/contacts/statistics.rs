//! Contact statistics: number, approach speed and duration of contacts against closed forms.

use crate::plants::{integrate, kernel, physical, relative, springs};
use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_dynamics::Integrator;
use jounce_model::contact::{Cubic, Hertz, HuntCrossley, KelvinVoigt, Law, Rigid};
use jounce_model::drive::Wave;
use jounce_model::plant::{Signal, Stop, System};
use jounce_model::reference::BouncingBall;
use std::f64::consts::{PI, TAU};

fn stop(shape: &[f64], gap_m: f64, law: Law) -> Stop {
    Stop {
        name: "stop".to_owned(),
        shape: shape.to_vec(),
        gap_m,
        law,
        bases: Vec::new(),
    }
}

/// A free mass of 1 kg strikes one on a spring without bounce. Both move together at `w / sqrt(2)`
/// for half a period and part with opposite speeds. One contact, without and with a second stop
/// that is never reached. Measured: contact duration 5e-8 at a tolerance of 1e-10 (the force that
/// ends it goes to zero with time), speeds 1e-14.
#[test]
fn a_merge_is_one_contact() {
    let w = TAU * 20.0;
    for with_second_stop in [false, true] {
        let mut system = springs(&[0.0, 20.0], 0.0);
        system.stops.push(stop(
            &[1.0, -1.0],
            1e-3,
            Law::Rigid(Rigid { restitution: 0.0 }),
        ));
        if with_second_stop {
            system.stops.push(stop(
                &[0.0, 1.0],
                1.0,
                Law::Rigid(Rigid { restitution: 0.0 }),
            ));
        }
        let kernel = kernel(system);
        let together_s = PI * 2.0_f64.sqrt() / w;
        let integrator = integrate(
            &kernel,
            &[0.0, 0.0, 1.0, 0.0],
            0.0,
            1e-3 + 1.1 * together_s,
            1e-10,
        );
        let (statistics, state) = (integrator.statistics(), physical(&integrator, &kernel));
        let errors = [
            relative(statistics.time_s, together_s),
            relative(statistics.max_contact_duration_s, together_s),
            relative(statistics.sticking_s, together_s),
            relative(statistics.max_impact_velocity_m_s, 1.0),
            relative(state[2], -0.5),
            integrator.energies().residual_relative().abs(),
        ];
        eprintln!("beside {with_second_stop}: {errors:?}, {statistics:?}");
        assert_eq!(statistics.contacts, 1);
        assert!(
            errors[..3].iter().all(|error| *error < 1e-6)
                && errors[3..].iter().all(|error| *error < 1e-9),
            "{errors:?}"
        );
    }
}

/// A mass on a spring against a linear spring without gap: alternate half periods, `pi / w` and
/// `pi / sqrt(w^2 + k)`. Rate, speed, duration, duty and force in a window of ten periods.
/// Measured: 4e-14.
#[test]
fn a_bilinear_oscillator_has_its_dwell_rate_and_duty() {
    let (w, k, speed) = (TAU * 2.0, 4000.0, 0.7);
    let mut system = springs(&[2.0], 0.0);
    system.stops.push(stop(
        &[1.0],
        0.0,
        Law::Hertz(Hertz {
            stiffness: k,
            exponent: 1.0,
        }),
    ));
    let kernel = kernel(system);
    let hard = (w * w + k).sqrt();
    let (contact_duration_s, period_s) = (PI / hard, PI / hard + PI / w);
    // From the middle of a flight to the middle of the tenth flight after it.
    let start = StartState {
        displacement: vec![-speed / w],
        velocity: vec![0.0],
        ..StartState::rest(&kernel.plant)
    };
    let plan = RunPlan {
        duration_s: 10.0 * period_s,
        average_over_s: 10.0 * period_s,
        tolerance: 1e-11,
        record_s: 0.0,
    };
    let result = simulate(&kernel, &start, &plan).unwrap();
    let statistics = &result.stops[0];
    let errors = [
        relative(statistics.contact_rate_hz, 1.0 / period_s),
        relative(statistics.mean_impact_velocity_m_s, speed),
        relative(statistics.max_impact_velocity_m_s, speed),
        relative(statistics.mean_contact_duration_s, contact_duration_s),
        relative(statistics.max_contact_duration_s, contact_duration_s),
        relative(statistics.contact_duty, contact_duration_s / period_s),
        relative(statistics.max_contact_force_n, k * speed / hard),
    ];
    eprintln!("{errors:?}");
    assert!(
        statistics.contacts == 10 && errors.iter().all(|error| *error < 1e-7),
        "{errors:?}"
    );
}

fn ball(height_m: f64, restitution: f64) -> System {
    let mut system = springs(&[0.0], 0.0);
    system
        .stops
        .push(stop(&[1.0], height_m, Law::Rigid(Rigid { restitution })));
    system.signals.push(Signal {
        name: "gravity".into(),
        shape: vec![1.0],
        wave: Wave::Constant(9.81),
        base: None,
        drawn_from: None,
    });
    system
}

/// Bounces of a ball: number up to a time between two of them, mean and largest speed.
#[test]
fn the_impacts_of_a_bouncing_ball_are_a_geometric_series() {
    let reference = BouncingBall {
        height_m: 0.5,
        gravity_m_s2: 9.81,
        restitution: 0.8,
    };
    let kernel = kernel(ball(0.5, 0.8));
    let integrator = integrate(
        &kernel,
        &[0.0, 0.0],
        0.0,
        0.5 * (reference.bounce_s(9) + reference.bounce_s(10)),
        1e-10,
    );
    let (statistics, fastest) = (integrator.statistics(), (2.0 * 9.81 * 0.5_f64).sqrt());
    let mean = fastest * (1.0 - 0.8_f64.powi(10)) / (10.0 * 0.2);
    eprintln!(
        "{:e} {:e}",
        relative(statistics.mean_impact_velocity_m_s(), mean),
        relative(statistics.max_impact_velocity_m_s, fastest)
    );
    assert!(statistics.contacts == 10 && statistics.mean_contact_duration_s() == 0.0);
    assert!(
        relative(statistics.mean_impact_velocity_m_s(), mean) < 1e-10
            && relative(statistics.max_impact_velocity_m_s, fastest) < 1e-12
    );
}

/// A ball at rest on the ground gives a trivial result; a falling ball does not.
#[test]
fn a_ball_at_rest_stays_at_rest() {
    let kernel = kernel(ball(0.01, 0.5));
    let integrator = integrate(&kernel, &[0.01, 0.0], 0.0, 1.0, 1e-7);
    let energies = integrator.energies();
    eprintln!("{:e}, {energies:?}", energies.residual_relative());
    assert!(
        energies.are_still()
            && energies.residual_relative().abs() < 1e-12
            && integrator.statistics().contacts == 0
    );
    let falls = integrate(&kernel, &[0.0, 0.0], 0.0, 0.04, 1e-7).energies();
    assert!(!falls.are_still() && falls.residual_relative().abs() < 1e-12);
}

/// An elastic collision changes no energy, but the run is not trivial, whether it falls before the
/// averaging window or in it.
#[test]
fn an_elastic_collision_is_not_trivial() {
    let mut system = springs(&[0.0], 0.0);
    system
        .stops
        .push(stop(&[1.0], 0.1, Law::Rigid(Rigid { restitution: 1.0 })));
    let kernel = kernel(system);
    let rest = StartState::rest(&kernel.plant);
    for (average_over_s, contacts) in [(1.0, 1), (0.5, 0)] {
        let start = StartState {
            velocity: vec![1.0],
            ..rest.clone()
        };
        let plan = RunPlan {
            duration_s: 1.0,
            average_over_s,
            tolerance: 1e-9,
            record_s: 0.0,
        };
        let result = simulate(&kernel, &start, &plan).unwrap();
        assert!(
            result.energies.are_still() && result.contacts == contacts && !result.is_trivial(),
            "{result:?}"
        );
    }
    let plan = RunPlan {
        duration_s: 1.0,
        average_over_s: 1.0,
        tolerance: 1e-9,
        record_s: 0.0,
    };
    let idle = simulate(&kernel, &rest, &plan).unwrap();
    assert!(idle.contacts == 0 && idle.is_trivial());
}

/// A window that opens at the deepest point of a contact: the force there is its largest. Closed
/// form `k d^1.5` for a mass that rebounds from a stop 2 mm deep, a damped law, and a spring on
/// both sides. Measured: exact to roundoff.
#[test]
fn a_window_that_opens_at_the_deepest_point_has_its_force() {
    let hertz = Hertz {
        stiffness: 1e6,
        exponent: 1.5,
    };
    let laws = [
        (Law::Hertz(hertz), 1e6 * 2e-3_f64.powf(1.5)),
        (
            Law::HuntCrossley(HuntCrossley {
                elastic: hertz,
                damping_s_m: 0.3,
            }),
            1e6 * 2e-3_f64.powf(1.5),
        ),
        (
            Law::Cubic(Cubic {
                stiffness_n_m: 1e3,
                cubic_stiffness_n_m3: 1e8,
            }),
            1e3 * 2e-3 + 1e8 * 2e-3_f64.powi(3),
        ),
    ];
    for (law, force_n) in laws {
        let mut system = springs(&[0.0], 0.0);
        system.stops.push(stop(&[1.0], 0.0, law));
        let kernel = kernel(system);
        let mut integrator = Integrator::new(
            &kernel,
            &kernel.plant.from_physical(&[2e-3, 0.0], 0.0),
            0.0,
            1e-9,
        )
        .unwrap();
        integrator.reset_statistics();
        integrator.advance_to(1e-3).unwrap();
        let statistics = integrator.statistics();
        eprintln!(
            "{law:?}: {:e} N, {:e} m",
            statistics.max_force_n, statistics.max_penetration_m
        );
        assert!(
            relative(statistics.max_force_n, force_n) < 1e-14
                && relative(statistics.max_penetration_m, 2e-3) < 1e-14
        );
        // Past the deepest point, the largest force is that at the start of the window.
        let [depth_m, rate_m_s] = [
            physical(&integrator, &kernel)[0],
            physical(&integrator, &kernel)[1],
        ];
        integrator.reset_statistics();
        let late_window = integrator.statistics();
        assert!(
            depth_m <= 0.0
                || (late_window.max_force_n - law.force_n(depth_m, rate_m_s)).abs()
                    < 1e-10 * force_n
        );
    }
}

/// A mass of 1 kg strikes a spring with a dashpot at 1 m/s: its displacement is
/// `Im e^{s t} / w`, `s = -z w0 + i w`, and the force `-Im s^2 e^{s t} / w` is largest where
/// `Im s^3 e^{s t} = 0`, or at the start. Measured: 2e-9.
#[test]
fn the_largest_force_of_a_dashpot_is_that_of_the_closed_form() {
    let w0: f64 = 1000.0;
    for damping_ratio in [0.01, 0.2, 0.45, 0.7] {
        let law = Law::KelvinVoigt(KelvinVoigt {
            stiffness_n_m: w0 * w0,
            damping_n_s_m: 2.0 * damping_ratio * w0,
        });
        let decay = damping_ratio * w0;
        let w = w0 * (1.0 - damping_ratio * damping_ratio).sqrt();
        let angle = w.atan2(-decay);
        let force_n = |time_s: f64| {
            let phase = w * time_s + 2.0 * angle;
            -w0 * w0 * (-decay * time_s).exp() * phase.sin() / w
        };
        let peak_s = (-3.0 * angle).rem_euclid(PI) / w;
        let exact_n = force_n(0.0).max(force_n(peak_s));
        let mut system = springs(&[0.0], 0.0);
        system.stops.push(stop(&[1.0], 0.0, law));
        let kernel = kernel(system);
        let start = kernel.plant.from_physical(&[-1e-4, 1.0], 0.0);
        let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-9).unwrap();
        integrator.advance_to(0.01).unwrap();
        let error = relative(integrator.statistics().max_force_n, exact_n);
        eprintln!("damping ratio {damping_ratio}: {exact_n} N, {error:e}");
        assert!(error < 1e-8, "{damping_ratio}: {error:e}");
    }
}

/// A spring pushes a point onto a stop with a strong dashpot, where Newton's method solves the steps:
/// the point is at rest, and the largest force is the static one.
#[test]
fn the_largest_force_of_a_point_at_rest_is_its_static_force() {
    let law = KelvinVoigt {
        stiffness_n_m: 2e4,
        damping_n_s_m: 1e3,
    };
    let mut system = springs(&[5.0], 0.0);
    system
        .stops
        .push(stop(&[1.0], -1e-2, Law::KelvinVoigt(law)));
    let kernel = kernel(system);
    let spring_n_m = (TAU * 5.0).powi(2);
    let rest_m = -1e-2 * law.stiffness_n_m / (spring_n_m + law.stiffness_n_m);
    let start = kernel.plant.from_physical(&[rest_m, 0.0], 0.0);
    let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-7).unwrap();
    integrator.advance_to(2.0).unwrap();
    let statistics = integrator.statistics();
    let error = relative(statistics.max_force_n, -spring_n_m * rest_m);
    eprintln!("{:e} N, {error:e}", statistics.max_force_n);
    assert!(error < 1e-6, "{error:e}");
}
