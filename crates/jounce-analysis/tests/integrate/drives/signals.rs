//! Drives other than sinusoids: against closed forms, recurrences, statistics and RK4.

use crate::plants::{bench, integrate, kernel, physical, relative};
use jounce_dynamics::Integrator;
use jounce_model::contact::{Hertz, Law, Rigid};
use jounce_model::drive::{Chirp, NoiseBand, Wave, chirp, half_sine, noise};
use jounce_model::plant::{Signal, Stop, System};
use jounce_model::reference::{BouncingBall, Harmonic};
use jounce_spec::{FrequencySweep, Spec};
use std::f64::consts::{PI, TAU};

/// A mass of 1 kg, so modal and physical coordinates are equal.
fn oscillator(frequency_rad_s: f64, damping_ratio: f64) -> System {
    let mut system = Harmonic {
        mass_kg: 1.0,
        frequency_rad_s,
        damping_ratio,
        amplitude_n: 0.0,
        drive_hz: 1.0,
    }
    .system();
    system.drives.clear();
    system
}

fn with_signal(mut system: System, wave: Wave) -> System {
    let shape = vec![1.0; system.modes.len()];
    system.signals.push(Signal {
        name: "signal".into(),
        shape,
        wave,
        base: None,
    });
    system
}

fn with_stop(mut system: System, gap_m: f64, law: Law) -> System {
    system.stops.push(Stop {
        name: "stop".into(),
        shape: vec![1.0],
        gap_m,
        law,
        bases: Vec::new(),
    });
    system
}

fn pseudo_random(count: u32) -> Vec<f64> {
    (0..count)
        .map(|k| 3.0 * (1.7 * f64::from(k * k % 1009)).sin() + (0.37 * f64::from(k)).cos())
        .collect()
}

/// Measured: speeds after each of eight bounces and the time to rest to 3e-13, energy residual
/// 1e-15.
#[test]
fn a_ball_bounces_under_gravity_as_in_its_closed_form() {
    let ball = BouncingBall {
        height_m: 0.7,
        gravity_m_s2: 9.81,
        restitution: 0.8,
    };
    let system = with_signal(oscillator(0.0, 0.0), Wave::Constant(ball.gravity_m_s2));
    let kernel = kernel(with_stop(
        system,
        0.0,
        Law::Rigid(Rigid {
            restitution: ball.restitution,
        }),
    ));
    let start = kernel.plant.from_physical(&[-ball.height_m, 0.0], 0.0);
    let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-12).unwrap();
    let mut worst = 0.0_f64;
    for bounce in 0..8 {
        let top_s = 0.5 * (ball.bounce_s(bounce) + ball.bounce_s(bounce + 1));
        integrator.advance_to(top_s).unwrap();
        let state = physical(&integrator, &kernel);
        let height_m = 0.5 * ball.speed_after_m_s(bounce).powi(2) / ball.gravity_m_s2;
        worst = worst
            .max(relative(-state[0], height_m))
            .max(state[1].abs() / ball.speed_after_m_s(bounce));
        assert_eq!(integrator.statistics().contacts, u64::from(bounce) + 1);
    }
    let end_s = ball.time_to_rest_s() + 1.0;
    integrator.advance_to(end_s).unwrap();
    let rest = relative(
        end_s - integrator.statistics().sticking_s,
        ball.time_to_rest_s(),
    );
    let residual = integrator.energies().residual_relative();
    eprintln!("tops {worst:.1e}, time to rest {rest:.1e}, energy {residual:.1e}");
    assert!(
        worst < 1e-10 && rest < 1e-9 && residual.abs() < 1e-11,
        "{worst:e} {rest:e} {residual:e}"
    );
    assert_eq!(physical(&integrator, &kernel), [0.0, 0.0]);
}

/// The deepest point solves `m g (h + d) = k d^(5/2) / (5/2)`, and the ball returns to its initial
/// height.
#[test]
fn a_ball_falls_onto_a_hertz_stop_and_comes_back() {
    let (height_m, gravity, stiffness) = (0.2, 9.81, 1e6);
    let system = with_signal(oscillator(0.0, 0.0), Wave::Constant(gravity));
    let kernel = kernel(with_stop(
        system,
        0.0,
        Law::Hertz(Hertz {
            stiffness,
            exponent: 1.5,
        }),
    ));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let d = 0.5 * (low + high);
        if gravity * (height_m + d) > stiffness * d.powf(2.5) / 2.5 {
            low = d
        } else {
            high = d
        }
    }
    let start = kernel.plant.from_physical(&[-height_m, 0.0], 0.0);
    let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-11).unwrap();
    let fall_s = (2.0 * height_m / gravity).sqrt();
    // At 2.3 fall times after the start the ball moves up.
    integrator.advance_to(2.3 * fall_s).unwrap();
    let state = physical(&integrator, &kernel);
    let energy = relative(
        0.5 * state[1] * state[1] - gravity * state[0],
        gravity * height_m,
    );
    let depth = relative(integrator.statistics().max_penetration_m, low);
    let residual = integrator.energies().residual_relative();
    eprintln!("depth {depth:.1e}, height {energy:.1e}, energy {residual:.1e}");
    assert!(
        integrator.statistics().contacts == 1
            && depth < 1e-9
            && energy < 1e-9
            && residual.abs() < 1e-9,
        "{depth:e} {energy:e}"
    );
}

#[test]
fn gravity_lets_a_sprung_mass_sag() {
    let system = with_signal(oscillator(30.0, 0.1), Wave::Constant(-9.81));
    let kernel = kernel(system);
    let sag_m = -9.81 / 900.0;
    let plan = jounce_analysis::run::RunPlan {
        duration_s: 20.0,
        average_over_s: 1.0,
        tolerance: 1e-10,
        record_s: 0.0,
    };
    let rest = jounce_analysis::run::StartState::rest(&kernel.plant);
    let settled = jounce_analysis::run::simulate(&kernel, &rest, &plan).unwrap();
    let linear = jounce_analysis::run::StartState::linear(&kernel.plant);
    assert!(
        relative(settled.end.displacement[0], sag_m) < 1e-13
            && relative(linear.displacement[0], sag_m) < 1e-15
    );
    assert!(settled.energies.residual_relative().abs() < 1e-13 && settled.settlement.is_none());
}

/// Exact recurrence for piecewise linear forces (N. Nigam, P. Jennings, Bull. Seism. Soc. Am. 59
/// (1969) 909). The coefficients come from the power series of the flow of `(w x, x', u, h u')`,
/// because their closed form loses digits on short steps.
fn nigam_jennings(w: f64, zeta: f64, h: f64, force: &[f64]) -> [f64; 2] {
    let rate = |y: [f64; 4]| {
        [
            w * h * y[1],
            h * (y[2] - w * y[0] - 2.0 * zeta * w * y[1]),
            y[3],
            0.0,
        ]
    };
    force.windows(2).fold([0.0; 2], |[x, v], p| {
        let start = [w * x, v, p[0], p[1] - p[0]];
        let (mut term, mut sum) = (start, start);
        for n in 1..40 {
            term = rate(term).map(|t| t / f64::from(n));
            sum = std::array::from_fn(|i| sum[i] + term[i]);
        }
        [sum[0] / w, sum[1]]
    })
}

/// 3000 samples; measured 4e-14 of the largest displacement and velocity.
#[test]
fn a_recording_moves_an_oscillator_by_the_exact_recurrence() {
    for (w, zeta, step_s) in [
        (60.0, 0.02, 1.0 / 3000.0),
        (2000.0, 0.3, 1.0 / 3000.0),
        (6.0, 0.001, 0.01),
    ] {
        let force = pseudo_random(3001);
        let [x, v] = nigam_jennings(w, zeta, step_s, &force);
        let wave = Wave::Sampled {
            start_s: 0.0,
            step_s,
            sizes: force.into(),
        };
        let kernel = kernel(with_signal(oscillator(w, zeta), wave));
        let integrator = integrate(&kernel, &[0.0, 0.0], 0.0, 3000.0 * step_s, 1e-12);
        let state = physical(&integrator, &kernel);
        let size = x.abs().max(v.abs() / w);
        let errors = [
            (state[0] - x).abs() / size,
            (state[1] - v).abs() / (w * size),
        ];
        let residual = integrator.energies().residual_relative();
        eprintln!("w {w}: {errors:?}, energy {residual:.1e}");
        assert!(
            errors.iter().all(|e| *e < 1e-12) && residual.abs() < 1e-12,
            "w {w}: {errors:?} {residual:e}"
        );
    }
}

/// During the pulse `x = X (sin W t - r sin w t) / (1 - r^2)`, `r = W / w`, `X = A / w^2`; the
/// remaining oscillation has the amplitude `2 r cos(pi / (2 r)) X / (1 - r^2)`.
#[test]
fn a_half_sine_shock_leaves_the_residual_of_its_spectrum() {
    for (w, duration_s) in [(100.0, 0.011), (100.0, 0.07), (100.0, 0.003)] {
        let (amplitude, pulse) = (50.0, PI / duration_s);
        let kernel = kernel(with_signal(
            oscillator(w, 0.0),
            half_sine(amplitude, 0.2, duration_s),
        ));
        let mut integrator = integrate(&kernel, &[0.0, 0.0], 0.0, 0.2 + duration_s, 1e-12);
        let state = physical(&integrator, &kernel);
        let (r, x) = (pulse / w, amplitude / (w * w));
        let exact = [
            -r * (w * duration_s).sin() * x / (1.0 - r * r),
            (-pulse - r * w * (w * duration_s).cos()) * x / (1.0 - r * r),
        ];
        let residual_m = (2.0 * r * (PI / (2.0 * r)).cos() * x / (1.0 - r * r)).abs();
        integrator.advance_to(1.0).unwrap();
        let after = physical(&integrator, &kernel);
        let errors = [
            (state[0] - exact[0]).abs() / residual_m,
            (state[1] - exact[1]).abs() / (w * residual_m),
            relative(after[0].hypot(after[1] / w), residual_m),
        ];
        let residual = integrator.energies().residual_relative();
        eprintln!("pulse of {duration_s} s: {errors:?}, energy {residual:.1e}");
        assert!(
            errors.iter().all(|e| *e < 1e-11) && residual.abs() < 1e-11,
            "{duration_s}: {errors:?} {residual:e}"
        );
    }
}

/// The velocity jump is exact, and its work is the impulse times the mean speed.
#[test]
fn a_velocity_step_is_an_impulse() {
    let kernel = kernel(with_signal(
        oscillator(20.0, 0.05),
        Wave::Impulse {
            time_s: 0.0,
            size_s: 0.3,
        },
    ));
    let integrator = integrate(&kernel, &[0.0, 0.1], 0.0, 0.5, 1e-12);
    let wd = 20.0 * (1.0_f64 - 0.0025).sqrt();
    let exact = 0.4 / wd * (-0.5_f64).exp() * (wd * 0.5).sin();
    let energies = integrator.energies();
    assert!(relative(physical(&integrator, &kernel)[0], exact) < 1e-13);
    assert!(
        relative(energies.input_j, 0.3 * 0.25) < 1e-13
            && energies.residual_relative().abs() < 1e-14
    );
}

/// A chirp of constant frequency is a sinusoid: linear between 256 samples per cycle, measured 3e-9
/// of the steady amplitude.
#[test]
fn a_chirp_without_sweep_is_a_sinusoid() {
    let (w, zeta, drive_hz) = (60.0, 0.2, 7.0);
    let wave = chirp(&Chirp {
        amplitude: 2.0,
        from_hz: drive_hz,
        to_hz: drive_hz,
        sweep: FrequencySweep::Linear,
        phase_rad: 0.3,
        start_s: 0.0,
        duration_s: 3.0,
    });
    let kernel = kernel(with_signal(oscillator(w, zeta), wave));
    let state = physical(&integrate(&kernel, &[0.0, 0.0], 0.0, 2.9, 1e-12), &kernel);
    let drive = TAU * drive_hz;
    let (elastic, damping) = (w * w - drive * drive, 2.0 * zeta * w * drive);
    let amplitude = 2.0 / elastic.hypot(damping);
    let lag = damping.atan2(elastic);
    // The transient has decayed by e^-35.
    let exact = amplitude * (drive * 2.9 + 0.3 - lag).sin();
    let error = (state[0] - exact).abs() / amplitude;
    eprintln!("chirp without sweep: {error:.1e}");
    assert!(error < 1e-7, "{error:e}");
}

/// White noise: mean square displacement `G / (8 zeta w^3)` and loss `G / 4` per unit mass. 400 s
/// contain about 1260 correlation times, so one standard deviation is about 2.8 %.
#[test]
fn white_noise_gives_the_mean_square_of_its_closed_form() {
    let (w, zeta, density, high_hz) = (TAU * 10.0, 0.05, 0.4, 100.0);
    let band = NoiseBand {
        density,
        low_hz: 0.0,
        high_hz,
        sample_rate_hz: 1000.0,
    };
    let kernel = kernel(with_signal(
        oscillator(w, zeta),
        noise(&band, 410.0, 7, &|| false),
    ));
    let mut integrator = Integrator::new(&kernel, &[0.0, 0.0], 0.0, 1e-8).unwrap();
    integrator.advance_to(10.0).unwrap();
    let before_j = integrator.energies().damping_j;
    let (samples, mut square) = (16_000, 0.0);
    for sample in 1..=samples {
        integrator
            .advance_to(10.0 + 400.0 * f64::from(sample) / f64::from(samples))
            .unwrap();
        square += physical(&integrator, &kernel)[0].powi(2) / f64::from(samples);
    }
    let energies = integrator.energies();
    let loss_w = (energies.damping_j - before_j) / 400.0;
    // The band ends where the velocity still has a tail: G / (4 pi^2 f) of its mean square.
    let velocity = density / (8.0 * zeta * w) - density / (4.0 * PI * PI * high_hz);
    let ratios = [
        square / (density / (8.0 * zeta * w.powi(3))),
        loss_w / (2.0 * zeta * w * velocity),
    ];
    eprintln!(
        "mean square and loss over closed form: {ratios:?}, energy {:.1e}",
        energies.residual_relative()
    );
    assert!(
        ratios.iter().all(|ratio| (ratio - 1.0).abs() < 3.0 * 0.028),
        "{ratios:?}"
    );
    assert!(energies.residual_relative().abs() < 1e-11);
}

/// The harvester of the paper with its stop, under each kind of drive: input energy equals energy
/// used, lost and stored.
#[test]
fn energy_balances_under_every_kind_of_drive_through_contacts() {
    let shape = bench(1.0, 11.0).drives[0].shape.clone();
    let sampled = |step_s: f64| Wave::Sampled {
        start_s: 0.05,
        step_s,
        sizes: pseudo_random(3000).iter().map(|x| 40.0 * x).collect(),
    };
    let sweep = FrequencySweep::Logarithmic;
    let chirp_input = Chirp {
        amplitude: 60.0,
        from_hz: 6.0,
        to_hz: 15.0,
        sweep,
        phase_rad: 0.0,
        start_s: 0.1,
        duration_s: 1.5,
    };
    let band = NoiseBand {
        density: 60.0,
        low_hz: 2.0,
        high_hz: 60.0,
        sample_rate_hz: 600.0,
    };
    for (name, tone_n, wave) in [
        ("gravity", 50.0, Wave::Constant(30.0)),
        ("recording", 0.0, sampled(1.0 / 3000.0)),
        ("recording and tone", 50.0, sampled(1.0 / 1234.0)),
        ("noise", 0.0, noise(&band, 2.0, 3, &|| false)),
        ("half-sine", 0.0, half_sine(2000.0, 0.1, 0.011)),
        ("chirp", 0.0, chirp(&chirp_input)),
        (
            "velocity step",
            0.0,
            Wave::Impulse {
                time_s: 0.2,
                size_s: 8.0,
            },
        ),
    ] {
        let mut system = bench(tone_n, 11.0);
        if tone_n == 0.0 {
            system.drives.clear();
        }
        system.signals.push(Signal {
            name: name.into(),
            shape: shape.clone(),
            wave,
            base: None,
        });
        let kernel = kernel(system);
        let integrator = integrate(&kernel, &vec![0.0; kernel.plant.len()], 0.0, 2.0, 1e-10);
        let residual = integrator.energies().residual_relative();
        eprintln!(
            "{name}: {} contacts, energy {residual:.1e}, {:?}",
            integrator.statistics().contacts,
            integrator.work()
        );
        assert!(
            integrator.statistics().contacts > 0 && residual.abs() < 1e-9,
            "{name}: {residual:e}"
        );
    }
}

/// A recording drives an oscillator onto a Hertz stop: fourth-order Runge-Kutta with 5 us steps,
/// halved once for its error.
#[test]
fn a_recording_with_contacts_agrees_with_brute_force() {
    let (w, zeta, gap_m, stiffness, step_s) = (60.0, 0.02, 1e-3, 1e5, 1.0 / 500.0);
    let force: Vec<f64> = pseudo_random(501).iter().map(|x| 4.0 * x).collect();
    let brute = |lines: usize| {
        let h = step_s / lines as f64;
        let pull = |x: f64| stiffness * (x - gap_m).max(0.0).powf(1.5);
        let rate = |[x, v]: [f64; 2], f: f64| [v, f - 2.0 * zeta * w * v - w * w * x - pull(x)];
        let mut y = [0.0; 2];
        for pair in force.windows(2) {
            for k in 0..lines {
                let at = |x: f64| pair[0] + (pair[1] - pair[0]) * (k as f64 + x) / lines as f64;
                let ahead = |y: [f64; 2], d: [f64; 2], s: f64| [y[0] + s * d[0], y[1] + s * d[1]];
                let a = rate(y, at(0.0));
                let b = rate(ahead(y, a, 0.5 * h), at(0.5));
                let c = rate(ahead(y, b, 0.5 * h), at(0.5));
                let d = rate(ahead(y, c, h), at(1.0));
                y = std::array::from_fn(|i| {
                    y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i])
                });
            }
        }
        y
    };
    let (coarse, fine) = (brute(400), brute(800));
    let system = with_signal(
        oscillator(w, zeta),
        Wave::Sampled {
            start_s: 0.0,
            step_s,
            sizes: force.clone().into(),
        },
    );
    let kernel = kernel(with_stop(
        system,
        gap_m,
        Law::Hertz(Hertz {
            stiffness,
            exponent: 1.5,
        }),
    ));
    let integrator = integrate(&kernel, &[0.0, 0.0], 0.0, 1.0, 1e-11);
    let state = physical(&integrator, &kernel);
    let size = fine[0].hypot(fine[1] / w);
    let off = |a: &[f64], b: &[f64]| (a[0] - b[0]).hypot((a[1] - b[1]) / w) / size;
    let (reference_error, error) = (off(&coarse, &fine), off(&state, &fine));
    eprintln!(
        "{} contacts: {error:.1e}, brute force by itself {reference_error:.1e}",
        integrator.statistics().contacts
    );
    assert!(
        integrator.statistics().contacts > 5 && reference_error < 1e-7 && error < 1e-7,
        "{error:e} {reference_error:e}"
    );
}

fn spring_mass(drive: &str) -> System {
    let text = format!(
        "[mass.m]\nmass = \"2 kg\"\nstiffness = \"7.2 kN/m\"\ndamping_ratio = 0.04\n[reduction]\nmodes = 1\n{drive}"
    );
    let spec = Spec::from_toml(&text).unwrap();
    System::assemble(&spec, jounce_model::structure::modes(&spec).unwrap()).unwrap()
}

/// Relative displacement of a mass on a moving base:
/// `Z / X = W^2 / sqrt((w^2 - W^2)^2 + (2 zeta w W)^2)`; also with the equivalent force.
#[test]
fn a_moving_base_is_a_force_against_the_mass() {
    let (w, drive) = (60.0, TAU * 7.0);
    let (elastic, damping): (f64, f64) = (w * w - drive * drive, 2.0 * 0.04 * w * drive);
    for (kind, amplitude, acceleration, sign) in [
        ("kind = \"base-acceleration\"", "3 m/s^2", 3.0, -1.0),
        ("kind = \"base-acceleration\"", "0.5 g", 0.5 * 9.80665, -1.0),
        (
            "kind = \"base-displacement\"",
            "2 mm",
            2e-3 * drive * drive,
            1.0,
        ),
        ("at = \"m\"", "6 N", 3.0, 1.0),
    ] {
        let system = spring_mass(&format!(
            "[drive.floor]\n{kind}\namplitude = \"{amplitude}\"\nfrequency = \"7 Hz\""
        ));
        let plant = jounce_model::plant::Plant::new(system).unwrap();
        let displacement =
            plant.steady_output(&plant.displacement_row(&plant.system.modes.shape["m"]))[0];
        // Re(-i z e^{i w t}) is a sine.
        let exact = faer::c64::new(0.0, -sign * acceleration) / faer::c64::new(elastic, damping);
        assert!(
            (displacement - exact).norm() < 1e-14 * exact.norm(),
            "{kind} {amplitude}: {displacement} {exact}"
        );
    }
}

#[test]
fn gravity_of_a_spec_acts_on_its_masses() {
    let system = spring_mass("[gravity]\nacceleration = \"-9.81 m/s^2\"");
    let kernel = kernel(system);
    let linear = jounce_analysis::run::StartState::linear(&kernel.plant);
    let shape = kernel.plant.system.modes.shape["m"][0];
    assert!(relative(shape * linear.displacement[0], -9.81 / 3600.0) < 1e-14);
}
