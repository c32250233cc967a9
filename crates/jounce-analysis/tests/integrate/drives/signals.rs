//! Shocks, chirps, noise and moving bases, against closed forms and statistics; the energy balance
//! under every kind of drive.

use super::oscillator::{oscillator, pseudo_random, spring_mass, with_signal};
use crate::plants::{bench, integrate, kernel, physical, relative};
use jounce_dynamics::Integrator;
use jounce_model::drive::{Chirp, NoiseBand, Wave, chirp, half_sine, noise};
use jounce_model::plant::Signal;
use jounce_spec::FrequencySweep;
use std::f64::consts::{PI, TAU};

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

/// Name, amplitude of a sinusoid in N, signal.
fn drives() -> [(&'static str, f64, Wave); 7] {
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
    [
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
    ]
}

/// The harvester of the paper with its stop, under each kind of drive: input energy equals energy
/// used, lost and stored.
#[test]
fn energy_balances_under_every_kind_of_drive_through_contacts() {
    let shape = bench(1.0, 11.0).drives[0].shape.clone();
    for (name, tone_n, wave) in drives() {
        let mut system = bench(tone_n, 11.0);
        if tone_n == 0.0 {
            system.drives.clear();
        }
        system.signals.push(Signal {
            name: name.into(),
            shape: shape.clone(),
            wave,
            base: None,
            drawn_from: None,
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
        let exact = jounce_linalg::c64::new(0.0, -sign * acceleration)
            / jounce_linalg::c64::new(elastic, damping);
        assert!(
            (displacement - exact).norm() < 1e-14 * exact.norm(),
            "{kind} {amplitude}: {displacement} {exact}"
        );
    }
}
