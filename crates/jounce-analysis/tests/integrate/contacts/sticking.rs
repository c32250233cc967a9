//! Sticking on rigid stops while other ports strike and press.

use crate::plants::{bench, distance, from_rest, integrate, kernel, physical, springs};
use jounce_dynamics::{IntegrationError, Integrator};
use jounce_model::contact::{Hertz, Law, Rigid};
use jounce_model::plant::{Stop, System};
use jounce_model::structure::modes;
use jounce_spec::Spec;

const PRESSED_M: f64 = 5e-3;

fn stop(name: &str, shape: &[f64], gap_m: f64, law: Law) -> Stop {
    Stop {
        name: name.to_owned(),
        shape: shape.to_vec(),
        gap_m,
        law,
        bases: Vec::new(),
    }
}

/// A mass pressed onto a rigid stop by its own spring, and a second one that strikes it from
/// behind.
fn anvil(restitution: f64) -> System {
    let mut system = springs(&[5.0, 12.0], 0.01);
    system.stops.push(stop(
        "anvil",
        &[1.0, 0.0],
        -PRESSED_M,
        Law::Rigid(Rigid { restitution }),
    ));
    system.stops.push(stop(
        "hammer",
        &[-1.0, 1.0],
        6e-3,
        Law::Hertz(Hertz {
            stiffness: 1e5,
            exponent: 1.5,
        }),
    ));
    system
}

/// The second mass and an anvil that cannot move.
fn with_fixed_anvil() -> System {
    let mut system = springs(&[12.0], 0.01);
    system.stops.push(stop(
        "hammer",
        &[1.0],
        6e-3 - PRESSED_M,
        Law::Hertz(Hertz {
            stiffness: 1e5,
            exponent: 1.5,
        }),
    ));
    system
}

/// Measured: the error of the hammer is 1e-12 of its motion, that of the anvil roundoff.
#[test]
fn a_mass_at_rest_is_a_fixed_anvil() {
    let (two, one) = (kernel(anvil(0.0)), kernel(with_fixed_anvil()));
    let integrator = integrate(&two, &[-PRESSED_M, 0.0, 0.0, 1.0], 0.0, 1.0, 1e-12);
    let fixed_run = integrate(&one, &[0.0, 1.0], 0.0, 1.0, 1e-12);
    let state = physical(&integrator, &two);
    let error = distance(&one, &[state[1], state[3]], &physical(&fixed_run, &one));
    let statistics = integrator.statistics_by_stop();
    let residual = integrator.energies().residual_relative();
    eprintln!(
        "hammer {error:.1e}, anvil {:.1e} m, residual {residual:.1e}, {statistics:?}",
        state[0] + PRESSED_M
    );
    assert!(
        statistics[1].contacts > 5 && statistics[1].contacts == fixed_run.statistics().contacts
    );
    assert!((statistics[0].sticking_s - 1.0).abs() < 1e-9);
    assert!((state[0] + PRESSED_M).abs() < 1e-15 && state[2].abs() < 1e-13);
    assert!(
        error < 1e-9 && residual.abs() < 1e-9,
        "{error:e}, {residual:e}"
    );
}

/// The mass comes to rest by chatter and is then struck: losses and remaining energy sum to the
/// input.
#[test]
fn a_mass_that_chatters_to_rest_is_struck() {
    let kernel = kernel(anvil(0.5));
    let integrator = integrate(
        &kernel,
        &[-PRESSED_M - 1e-3, -0.02, 0.0, 0.6],
        0.0,
        1.0,
        1e-9,
    );
    let (statistics, energies) = (integrator.statistics_by_stop(), integrator.energies());
    eprintln!(
        "residual {:.1e}, {statistics:?}",
        energies.residual_relative()
    );
    assert!(
        statistics[0].contacts > 10 && statistics[0].sticking_s > 0.3 && statistics[1].contacts > 3
    );
    assert!(energies.residual_relative().abs() < 1e-8 && energies.contact_loss_j > 0.0);
}

/// The spring of the mass would take it off the anvil, and a second stop presses it on. After its
/// bounces, which end within a few of their first duration, the energy of its speed is lost.
#[test]
fn a_mass_pressed_by_a_second_stop_comes_to_rest() {
    let mut system = springs(&[5.0], 0.0);
    let (anvil, spring) = (
        Law::Rigid(Rigid { restitution: 0.866 }),
        Law::Hertz(Hertz {
            stiffness: 1e5,
            exponent: 1.0,
        }),
    );
    system.stops = vec![
        stop("anvil", &[-1.0], 2e-3, anvil),
        stop("spring", &[1.0], -3e-3, spring),
    ];
    let kernel = kernel(system);
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let integrator = integrate(&kernel, &[-2e-3, 0.1], 0.0, 0.5, tolerance);
        let (state, energies) = (physical(&integrator, &kernel), integrator.energies());
        let statistics = integrator.statistics_by_stop()[0];
        assert!((state[0] + 2e-3).abs() < 1e-15 && state[1].abs() < 1e-12);
        let loss_j = 0.5 * 0.1 * 0.1;
        assert!((energies.contact_loss_j / loss_j - 1.0).abs() < 10.0 * tolerance);
        assert!(statistics.sticking_s > 0.45 && statistics.contacts < 300);
    }
}

/// Two masses each stick to their own stop; two stops under one mass cannot share its force.
#[test]
fn rest_on_two_stops_is_simulated_or_refused() {
    let rigid = Law::Rigid(Rigid { restitution: 0.0 });
    let mut system = springs(&[5.0, 12.0], 0.01);
    system.stops = vec![
        stop("left", &[1.0, 0.2], -PRESSED_M, rigid),
        stop("right", &[0.1, 1.0], -PRESSED_M, rigid),
    ];
    // Both points on their stops: [1 0.2; 0.1 1] q = -pressed.
    let start = [-PRESSED_M * 0.8 / 0.98, -PRESSED_M * 0.9 / 0.98, 0.0, 0.0];
    let distinct = kernel(system.clone());
    let integrator = integrate(&distinct, &start, 0.0, 0.5, 1e-10);
    let state = physical(&integrator, &distinct);
    let error = (0..4)
        .map(|i| (state[i] - start[i]).abs())
        .fold(0.0, f64::max);
    // Roundoff starts them 1e-17 m above their stops, from where they fall for some nanoseconds.
    let falling_s = integrator
        .statistics_by_stop()
        .iter()
        .map(|statistics| 0.5 - statistics.sticking_s)
        .fold(0.0, f64::max);
    eprintln!("moved by {error:.1e}, off the stops for {falling_s:.1e} s");
    assert!(error < 1e-12 && falling_s < 1e-8);
    system.stops[1] = stop("right", &[1.0, 0.2], -PRESSED_M, rigid);
    let coinciding = kernel(system);
    let mut integrator = Integrator::new(
        &coinciding,
        &coinciding.plant.from_physical(&start, 0.0),
        0.0,
        1e-10,
    )
    .unwrap();
    let error = integrator.advance_to(0.5).unwrap_err();
    assert!(
        matches!(&error, IntegrationError::RestsTwice { stops, .. } if stops == &["left", "right"]),
        "{error}"
    );
}

/// A mass on a compressed spring pushes a free one of equal mass from rest, without impacts. They
/// move as one mass until the spring would pull; then the free one has constant speed. Without and
/// with a second stop, which uses another sticking rule. Measured at the tolerance 1e-10: 2.8e-14,
/// with the second stop 1.7e-15.
#[test]
fn a_mass_pushes_another_from_rest_and_releases_it() {
    let (zeta, frequency_hz, start_m) = (0.01, 3.0, 4e-3);
    for with_second_stop in [false, true] {
        let mut system = springs(&[frequency_hz, 0.0], zeta);
        system.stops.push(stop(
            "hand",
            &[1.0, -1.0],
            -start_m,
            Law::Rigid(Rigid { restitution: 0.5 }),
        ));
        if with_second_stop {
            system.stops.push(stop(
                "far",
                &[0.0, 1.0],
                1.0,
                Law::Rigid(Rigid { restitution: 0.5 }),
            ));
        }
        let kernel = kernel(system);
        let end_s = 0.4;
        let integrator = integrate(&kernel, &[-start_m, 0.0, 0.0, 0.0], 0.0, end_s, 1e-10);
        let state = physical(&integrator, &kernel);
        let natural = std::f64::consts::TAU * frequency_hz / 2f64.sqrt();
        let decay = zeta * std::f64::consts::TAU * frequency_hz / 2.0;
        let damped = (natural * natural - decay * decay).sqrt();
        let leaves_s = (damped / decay).atan() / damped;
        let (sin, cos) = (damped * leaves_s).sin_cos();
        let envelope = start_m * (-decay * leaves_s).exp();
        let speed = envelope * natural * natural / damped * sin;
        let exact_m =
            start_m - envelope * (cos + decay / damped * sin) + speed * (end_s - leaves_s);
        let errors = [state[1] / exact_m - 1.0, state[3] / speed - 1.0];
        let statistics = integrator.statistics_by_stop()[0];
        eprintln!(
            "beside {with_second_stop}: {errors:?}, {:.3e} s at rest, residual {:.1e}",
            statistics.sticking_s,
            integrator.energies().residual_relative()
        );
        assert!(
            errors.iter().all(|error| error.abs() < 1e-8)
                && (statistics.sticking_s / leaves_s - 1.0).abs() < 1e-4
        );
        assert!(integrator.energies().residual_relative().abs() < 1e-9);
    }
}

/// A ball released from rest while the beam under it has hardly begun to recede: the first rise of
/// the interpolant of a step is below its uncertainty, which could give endless impacts at one
/// instant. Runs complete and balance their energy at every restitution and tolerance.
#[test]
fn a_mass_released_from_rest_leaves() {
    for restitution in [0.0, 0.2, 0.3, 0.4, 0.5] {
        for tolerance in [1e-6, 1e-7, 1e-8] {
            let text = format!(
                "[beam.up]\nmaterial = \"steel\"\nlength = \"50 mm\"\nwidth = \"10 mm\"\nthickness = \"1 mm\"\n\
                 [mass.ball]\non = \"nothing\"\nmass = \"1 g\"\n\
                 [stop.lo]\nat = \"ball\"\nframe = \"up.end\"\nside = \"negative\"\ngap = \"0 mm\"\nlaw = \"rigid\"\nrestitution = {restitution:?}\n\
                 [gravity]\nacceleration = \"-9.81 m/s^2\"\n\
                 [drive.base]\nkind = \"base-displacement\"\namplitude = \"1 mm\"\nfrequency = \"23 Hz\"\n\
                 [damping]\nbeyond = 0.01\n[reduction]\nmodes = 5\n"
            );
            let spec = Spec::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
            let kernel = kernel(System::assemble(&spec, modes(&spec).unwrap()).unwrap());
            let result = from_rest(&kernel, 1.5, tolerance);
            let residual = result.energies.residual_relative();
            eprintln!(
                "{restitution}, {tolerance:e}: {} contacts, residual {residual:.1e}",
                result.contacts
            );
            assert!(
                result.contacts > 50 && residual.abs() < 2.0 * tolerance,
                "{restitution}, {tolerance:e}: {residual:e}"
            );
        }
    }
}

/// The predicted end of sticking and the mismatch of the last step choose the next one: with one
/// rigid stop and with two, few steps are rejected.
#[test]
fn few_steps_of_sticking_are_rejected() {
    let law = Law::Rigid(Rigid { restitution: 0.6 });
    let mut system = bench(50.0, 11.0);
    system.stops[0].law = law;
    let one = system.clone();
    let opposite: Vec<f64> = system.stops[0].shape.iter().map(|s| -s).collect();
    let gap_m = system.stops[0].gap_m;
    system.stops.push(stop("opposite", &opposite, gap_m, law));
    for system in [one, system] {
        let work = from_rest(&kernel(system), 3.0, 1e-7).work;
        assert!(
            work.contact_steps > 1000 && work.contact_rejections < work.contact_steps / 5,
            "{work:?}"
        );
    }
}
